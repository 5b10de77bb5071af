"""The reference of the scene formats names what the readers know, and the example of each row has the said effect."""

import re
import shutil
import struct
import sys
import warnings
import zlib
from pathlib import Path

import numpy as np
import pytest

import kinegraph as ry

ROOT = Path(__file__).parents[3]
sys.path.insert(0, str(ROOT / "site"))

from language import mjcf, scene, urdf  # noqa: E402

PARSERS = ROOT / "src" / "kinegraph"


def write_files(folder):
    """Writes the files to which the examples refer."""
    shutil.copy(ROOT / "tests" / "data" / "tetrahedron.h5", folder / "part.h5")
    (folder / "tetra.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n")
    (folder / "part.xml").write_text("<mujoco><worldbody><body name='p'><geom size='.1'/></body></worldbody></mujoco>")
    (folder / "ball.g").write_text("lo: [-1 -1 -1]\nup: [1 1 1]\nfield: <2 2 2> [1 1 1 1 -1 -1 -1 -1]\n")
    chunks = [
        (b"IHDR", struct.pack(">IIBBBBB", 1, 1, 8, 2, 0, 0, 0)),
        (b"IDAT", zlib.compress(b"\0\xff\0\0")),
        (b"IEND", b""),
    ]
    body = b"".join(struct.pack(">I", len(d)) + k + d + struct.pack(">I", zlib.crc32(k + d)) for k, d in chunks)
    (folder / "dot.png").write_bytes(b"\x89PNG\r\n\x1a\n" + body)


def after(C, seconds, target=None):
    scene = C.copy()
    S = ry.Simulation(scene)
    for _ in range(round(seconds / 0.01)):
        S.step(
            [] if target is None else target, 0.01, ry.ControlMode.none if target is None else ry.ControlMode.position
        )
    return scene


def warned(C, seconds):
    with warnings.catch_warnings(record=True) as found:
        warnings.simplefilter("always")
        after(C, seconds)
    return [str(warning.message) for warning in found]


def names_of(C, name="a"):
    return {
        "C": C,
        "a": C.getFrame(name) if name in C.getFrameNames() else None,
        "np": np,
        "ry": ry,
        "equal": lambda x, y: np.allclose(x, y, atol=1e-6),
        "after": lambda seconds, target=None: after(C, seconds, target),
        "warned": lambda seconds: warned(C, seconds),
        "position": lambda scene, frame: scene.getFrame(frame).getPosition(),
        "camera": lambda frame: ry.CameraView(C).setCamera(frame),
    }


SCENE_ENTRIES = [entry for _, entries in scene.SECTIONS.values() for entry in entries]


@pytest.mark.filterwarnings("ignore::kinegraph.KinegraphWarning")
@pytest.mark.parametrize("entry", SCENE_ENTRIES, ids=lambda entry: entry.names)
def test_the_example_of_an_attribute_has_its_effect(entry, tmp_path):
    write_files(tmp_path)
    (tmp_path / "scene.g").write_text(entry.example)
    C = ry.Config()
    C.addFile(str(tmp_path / "scene.g"))
    assert any(re.search(rf"\b{name}\b", entry.example) for name in entry.names.split())
    assert eval(entry.effect, names_of(C)), entry.effect


def test_the_reference_names_the_attributes_that_the_reader_knows():
    text = (PARSERS / "scene" / "loading" / "attributes.cpp").read_text()
    known = set(re.findall(r'"(\w+)"', text[text.index("kKnownAttributes[]") : text.index("};")]))
    read_later = {"least_opening", "lever", "motorLimit", "opening"}
    named = [name for entry in SCENE_ENTRIES for name in entry.names.split()]
    assert len(named) == len(set(named))
    assert set(named) == known | read_later


def test_the_reference_names_the_attributes_that_any_room_reads():
    calls = re.compile(
        r'(?:attributes\(?\)?(?:->|\.)find|attributeNumber|attributeFlag|numberOf|numbersOf)\([^"()]*"(\w+)"'
    )
    read = {
        word
        for room in ("simulation", "scene", "rendering", "task_planning", "exporters")
        for file in (PARSERS / room).rglob("*.cpp")
        for word in calls.findall(file.read_text())
    }
    assert len(read) > 30
    assert read <= {name for entry in SCENE_ENTRIES for name in entry.names.split()}


FILES = [
    (template, entry, suffix)
    for module, suffix in ((urdf, "urdf"), (mjcf, "xml"))
    for _, template, entries in module.SECTIONS.values()
    for entry in entries
]


@pytest.mark.filterwarnings("ignore::kinegraph.KinegraphWarning")
@pytest.mark.parametrize("template, entry, suffix", FILES, ids=[f"{s}: {e.names}" for _, e, s in FILES])
def test_the_example_of_an_element_has_its_effect(template, entry, suffix, tmp_path):
    write_files(tmp_path)
    file = tmp_path / f"scene.{suffix}"
    file.write_text(template.format(entry.example))
    C = ry.Config()
    C.addFile(str(file))
    assert any(re.search(rf"\b{name}\b", entry.example) for name in entry.names.split())
    assert eval(entry.effect, names_of(C)), entry.effect


def named_in(module):
    return {name for *_, entries in module.SECTIONS.values() for entry in entries for name in entry.names.split()}


def test_the_reference_of_urdf_names_the_words_that_the_reader_reads():
    text = (PARSERS / "parsers" / "urdf" / "urdf_model.cpp").read_text()
    calls = r'(?:text|number|vector|limitOf)\(\*?\w+, "(\w+)"|ofMotor\("(\w+)"\)|(?:attribute|child|all)\("(\w+)"\)|\.name == "(\w+)"'
    read = {word for words in re.findall(calls, text) for word in words if word}
    assert len(read) > 40
    assert named_in(urdf) == read | {"quat_xyzw", "parent", "child"} - {"robot"}


def test_the_reference_of_mjcf_names_the_attributes_that_the_reader_reads():
    text = (PARSERS / "parsers" / "mjcf" / "mjcf_check.cpp").read_text()
    tables = text[text.index("Names> known = {") : text.index("const auto names = known.find")]
    elements = {"body", "joint", "geom", "site", "camera", "inertial"}
    read = set(re.findall(r'"(\w+)"', tables)) - elements
    calls = re.compile(
        r'(?:attribute|own)\("(\w+)"\)|attribute\.name == "(\w+)"|name == "(\w+mass|\w+inertia)"'
        r'|(?:number|numbers|vector|upTo|keyword|triple|first|reachOf)\(\*?\w+(?:\(\*?\w+, \{\}\))?, "(\w+)"(?:, "(\w+)")?'
    )
    for file in (PARSERS / "parsers" / "mjcf").glob("mjcf_*.cpp"):
        read |= {word for words in calls.findall(file.read_text()) for word in words if word}
    read -= {"objname", "refname", "objtype", "reftype", "role", "condim"}  # names in sections that are not read
    missing = read - named_in(mjcf)
    assert len(read) > 70
    assert not missing
