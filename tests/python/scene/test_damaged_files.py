"""Files that are damaged or malicious: each gives a scene or an error of the library, soon and with little memory."""

import resource
import struct
import warnings
from collections.abc import Callable
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

import kinegraph as ry
from test_mjcf import ARM as MJCF
from test_urdf import ARM as URDF

SCENE = """
base: { shape: ssBox, size: [1 .5 .1 .02], color: [.3 .4 .5], contact: 1, logical: { is_table } }
arm (base): { joint: hinge, axis: [1 2 3], limits: [-1 2], pre: "t(1 2 3) d(90 1 0 0)", mass: 2 }
tool (arm): { shape: mesh, vertices: [0 0 0 1 0 0 0 1 0], triangles: [0 1 2], Q: [1 0 0 1 .2 .3 0] }
grip (arm) { joint: transX, mimic: arm, joint_scale: .5 }
Edit base: { mass: 3 }
"""
YAML = """
base:
  shape: box
  size: [1, .5, .1]
arm (base):
  joint: hingeX
  limits: [-1, 2]
  pose: [1, 0, 0]
"""
OBJ = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 3 4\nusemtl a\nf 1//1 2//1 4//1\n"
STL = b"\0" * 80 + struct.pack("<I", 2) + 2 * struct.pack("<12fH", *range(12), 0)
MSH = struct.pack("<4i", 3, 0, 0, 1) + struct.pack("<9f", *range(9)) + struct.pack("<3i", 0, 1, 2)
PLY = (
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
    "element face 1\nproperty list uchar int vertex_index\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"
)
FILES = {
    "a.g": SCENE.encode(),
    "a.yml": YAML.encode(),
    "a.urdf": URDF.encode(),
    "a.xml": MJCF.encode(),
    "a.obj": OBJ.encode(),
    "a.stl": STL,
    "a.msh": MSH,
    "a.ply": PLY.encode(),
}
# Pieces that break readers: numbers that are none, huge or negative, brackets without partner, and ends of things.
TOKENS = [
    *(b"{", b"}", b"[", b"]", b"(", b")", b"<", b">", b'"', b"'", b"/>", b"<!--", b"&", b"\0", b"\xff", b"\n"),
    *(b"1e400", b"-1e308", b"nan", b"inf", b"-1", b"999999999999", b"0", b"Include: <a.g>", b"<include file='a.xml'/>"),
]

Mutation = Callable[[bytes], bytes]


@st.composite
def mutations(draw: st.DrawFn) -> Mutation:
    """Cuts, doubles, or replaces a piece; the place is a fraction of the length."""
    start, length = draw(st.floats(0, 1)), draw(st.integers(0, 30))
    kind, token = draw(st.sampled_from(["cut", "double", "replace", "end"])), draw(st.sampled_from(TOKENS))

    def mutate(text: bytes) -> bytes:
        i = int(start * len(text))
        piece, rest = text[i : i + length], text[i + length :]
        middle = {"cut": b"", "double": piece + piece, "replace": token, "end": b""}[kind]
        return text[:i] + middle + (b"" if kind == "end" else rest)

    return mutate


def load(file: Path) -> ry.Config | None:
    """The scene of a file, or that of a mesh; None after an error of the library."""
    config = ry.Config()
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ry.KinegraphWarning)
        try:
            if file.suffix in (".g", ".yml", ".urdf", ".xml"):
                config.addFile(file)
            else:
                config.addFrame("a", "", f"mesh: <{file}>")
        except ry.Error as error:
            assert str(error)
            return None
    assert config.getFrameState().shape == (config.getFrameDimension(), 7)
    return config


@pytest.mark.parametrize("name", FILES)
@settings(max_examples=60, derandomize=True, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(changes=st.lists(mutations(), min_size=1, max_size=4))
def test_a_damaged_file_is_a_scene_or_an_error(name: str, changes: list[Mutation], tmp_path: Path) -> None:
    text = FILES[name]
    for change in changes:
        text = change(text)
    (tmp_path / name).write_bytes(text)
    load(tmp_path / name)


def test_the_files_are_good_before_they_are_damaged(tmp_path: Path) -> None:
    for name, text in FILES.items():
        (tmp_path / name).write_bytes(text)
        assert load(tmp_path / name) is not None, name


LAUGHS = "".join(f'<!ENTITY l{i} "{f"&l{i - 1};" * 10}">' for i in range(1, 10))
BOMBS = {
    "braces.g": "a: {b: " * 140,
    "brackets.g": "a: { b: " + "[" * 900,
    "rope.g": "a: { mesh_rope: [1 0 0 1e9] }",
    "numbers.g": "a: { shape: sphere, size: [1e308] }\nb: { shape: ssBox, size: [1e400 1 1 1e-300] }",
    "dofs.g": "a: {}\nb (a): { joint: _" + "x" * 900 + " }",
    "itself.g": "Include: <itself.g>\nInclude: <itself.g>",
    "laughs.xml": f'<!DOCTYPE mujoco [<!ENTITY l0 "ha">{LAUGHS}]><mujoco model="&l9;"><worldbody/></mujoco>',
    "laughs.urdf": f'<!DOCTYPE robot [<!ENTITY l0 "ha">{LAUGHS}]><robot name="&l9;"><link name="&l9;"/></robot>',
    "deep.xml": "<mujoco><worldbody>" + "<body>" * 160,
    "closed.xml": "<mujoco><worldbody>" + "<body>" * 70 + "</body>" * 70 + "</worldbody></mujoco>",
    "itself.xml": "<mujoco><include file='itself.xml'/><include file='itself.xml'/></mujoco>",
    "limits.xml": "<mujoco><worldbody><body><joint range='-1e400 1e400'/></body></worldbody></mujoco>",
}


@pytest.mark.parametrize("name", BOMBS)
def test_a_small_file_cannot_ask_for_much_memory(name: str, tmp_path: Path) -> None:
    file = tmp_path / name
    file.write_text(BOMBS[name])
    assert file.stat().st_size < 1100
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    load(file)
    assert resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before < 200_000  # kB


def test_a_mesh_file_that_promises_more_than_it_holds_is_an_error(tmp_path: Path) -> None:
    many = 2**31 - 1
    buffer = (
        '{"asset": {"version": "2.0"}, "accessors": [{"componentType": 5126, "count": 100000000, "type": "VEC3"}], '
    )
    promises = {
        "vertices.ply": PLY.replace("vertex 3", f"vertex {many}").encode(),
        "faces.ply": PLY.replace("face 1", f"face {many}").encode(),
        "a.gltf": (
            buffer + '"meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}], "nodes": [{"mesh": 0}]}'
        ).encode(),
        "a.dae": b'<COLLADA version="1.4.1"><float_array id="a" count="4000000000">1 2 3</float_array></COLLADA>',
        "a.msh": struct.pack("<4i", many, 0, 0, many),
        "a.stl": b"\0" * 80 + struct.pack("<I", many),
        "a.obj": b"v 0 0 0\nf 1 2 999999999\n",
    }
    for name, text in promises.items():
        (tmp_path / name).write_bytes(text)
        before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
        assert load(tmp_path / name) is None, name
        assert resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before < 200_000, name  # kB


# Findings of the fuzzers in tests/fuzz.
FOUND = sorted((Path(__file__).parent.parent.parent / "data" / "damaged").iterdir())


@pytest.mark.parametrize("file", FOUND, ids=lambda file: file.name)
def test_inputs_found_by_fuzzers_stay_fixed(file: Path) -> None:
    load(file)
