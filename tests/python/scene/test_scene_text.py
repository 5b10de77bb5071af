"""Scenes as dict, YAML and `.g` text: a written scene reads back unchanged."""

import shutil
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import kinegraph as ry

DATA = Path(__file__).parent.parent.parent / "data"
NUMBER = st.floats(-1e6, 1e6, allow_subnormal=False)
UNIT = st.floats(-1, 1, allow_subnormal=False)
TEXT = st.text(st.characters(min_codepoint=32, max_codepoint=0x24F, exclude_characters="'\"\\<>\x7f"), max_size=8)
JOINTS = {
    "hingeX": 1,
    "transZ": 1,
    "hinge": 1,
    "transXY": 2,
    "transXYPhi": 3,
    "universal": 2,
    "free": 7,
    "_xzA": 3,
    "rigid": 0,
}
SHAPES = {"box": 3, "sphere": 1, "capsule": 2, "cylinder": 2, "marker": 1, "quad": 2}


def numbers(count: int, element: st.SearchStrategy[float] = NUMBER) -> st.SearchStrategy[list[float]]:
    return st.lists(element, min_size=count, max_size=count)


@st.composite
def frames(draw: st.DrawFn, has_parent: bool) -> dict:
    """The attributes of a frame."""
    frame = {}
    joint = draw(st.sampled_from([None, *JOINTS])) if has_parent else None
    if joint is None or joint == "rigid":
        frame["pose"] = [*draw(numbers(3)), 1, *draw(numbers(3, UNIT))]
    if joint is not None:
        dofs = JOINTS[joint]
        frame["joint"] = joint
        if dofs:
            frame["q"] = draw(numbers(dofs)) if joint != "free" else [*draw(numbers(3)), 1, *draw(numbers(3, UNIT))]
        if dofs and draw(st.booleans()):
            frame["limits"] = sorted(draw(numbers(2 * dofs)))
        if joint == "hinge":
            frame["axis"] = [1, *draw(numbers(2, UNIT))]
        if draw(st.booleans()):
            frame["joint_active"] = False
    shape = draw(st.sampled_from([None, *SHAPES]))
    if shape is not None:
        frame["shape"] = shape
        frame["size"] = draw(numbers(SHAPES[shape], st.floats(0.01, 10)))
        frame["color"] = draw(numbers(draw(st.sampled_from([1, 3, 4])), st.floats(0, 1)))
        frame["contact"] = draw(st.integers(-3, 1))
    if draw(st.booleans()):
        frame["mass"] = draw(st.floats(0.01, 100))
        moment = draw(st.floats(0.01, 10))  # of a ball: others may be impossible, which is warned of
        rows = {3: [1, 1, 1], 6: [1, 0, 0, 1, 0, 1], 9: [1, 0, 0, 0, 1, 0, 0, 0, 1]}
        frame["inertia"] = [moment * entry for entry in rows[draw(st.sampled_from([3, 6, 9]))]]
        frame["com"] = draw(numbers(3))
    if draw(st.booleans()):
        frame["note"] = draw(st.one_of(NUMBER, TEXT, st.booleans(), numbers(3), st.lists(TEXT, min_size=1, max_size=3)))
    return frame


@st.composite
def scenes(draw: st.DrawFn) -> ry.Config:
    scene = {}
    for i in range(draw(st.integers(1, 6))):
        parent = draw(st.integers(-1, i - 1))
        scene[f"f{i}" + (f" (f{parent})" if parent >= 0 else "")] = draw(frames(parent >= 0))
    config = ry.Config()
    config.addDict(scene)
    return config


def assertSame(one: ry.Config, other: ry.Config) -> None:
    """Everything that asDict tells, exactly but for the last digits of rotations, and all poses and joints."""
    a, b = one.asDict(), other.asDict()
    assert list(a) == list(b)
    for name in a:
        assert list(a[name]) == list(b[name])
        for key, value in a[name].items():
            if key in ("pose", "axis", "q"):
                np.testing.assert_allclose(b[name][key], value, rtol=1e-14, atol=1e-14)
            else:
                assert b[name][key] == value
    np.testing.assert_allclose(other.getJointState(), one.getJointState(), rtol=1e-14, atol=1e-14)
    np.testing.assert_array_equal(other.getJointLimits(), one.getJointLimits())
    np.testing.assert_allclose(other.getFrameState(), one.getFrameState(), rtol=1e-12, atol=1e-7)


@pytest.mark.filterwarnings("ignore:.*did you mean")
@settings(max_examples=150, deadline=None, derandomize=True)
@given(scenes())
def test_dict_yaml_and_text_read_back_as_the_same_scene(config: ry.Config) -> None:
    from_dict, from_yaml, from_line, from_text = (ry.Config() for _ in range(4))
    from_dict.addDict(config.asDict())
    from_yaml.addText(config.asYaml())
    from_line.addText(config.asYaml(True))
    from_text.addText(config.write())
    for other in (from_dict, from_yaml, from_line, from_text):
        assertSame(config, other)


@pytest.fixture
def config() -> ry.Config:
    C = ry.Config()
    C.addText(
        "a: { shape: ssBox, size: [1 1 1 .1], color: [1 0 0], note: 'x y' }  b(a): { joint: hingeX, limits: [-1 1], q: .3 }"
    )
    return C


def test_a_dict_has_frames_in_order_with_their_parents(config: ry.Config) -> None:
    assert config.asDict() == {
        "a": {"shape": "ssBox", "size": [1, 1, 1, 0.1], "color": [1, 0, 0], "note": "x y"},
        "b(a)": {"joint": "hingeX", "limits": [-1, 1], "q": [0.3]},
    }


def test_a_frame_describes_its_current_state(config: ry.Config) -> None:
    config.setJointState([0.5])
    config.getFrame("a").setPosition([1, 2, 3]).setColor([0, 1, 0, 0.5])
    assert config.getFrame("b").asDict()["q"] == [0.5]
    assert config.getFrame("a").asDict()["pose"] == [1, 2, 3]
    assert config.getFrame("a").asDict()["color"] == [0, 1, 0, 0.5]


def test_the_constant_pose_of_a_rigid_joint_is_kept() -> None:
    C, D = ry.Config(), ry.Config()
    C.addText("a: {} b(a): { joint: rigid, pose: [1 2 3] }")
    D.addText(C.write())
    np.testing.assert_array_equal(D.getFrame("b").getPosition(), [1, 2, 3])


def test_frames_of_a_dict_may_come_before_their_parents() -> None:
    C = ry.Config()
    assert C.addDict({"b(a)": {"joint": "rigid"}, "a": {"pose": (1, 2, 3)}}).name == "b"
    np.testing.assert_array_equal(C.getFrame("b").getPosition(), [1, 2, 3])


def test_repeated_names_are_distinct_in_a_dict(config: ry.Config) -> None:
    config.addConfigurationCopy(config.__copy__())
    with pytest.warns(ry.KinegraphWarning, match="'a' .frame 2. as 'a_2'"):
        assert list(config.asDict()) == ["a", "b(a)", "a_2", "b_2(a_2)"]


@pytest.mark.parametrize("name", ["s.g", "s.yml", "s.yaml", "s.urdf"])
def test_write_takes_the_format_from_the_file_name(config: ry.Config, tmp_path, name: str) -> None:
    config.getFrame("a").setShape(ry.ST.box, [1, 1, 1])  # URDF has no rounded boxes, and no joint state
    config.setJointState([0.0])
    text = config.write(tmp_path / name)
    assert (tmp_path / name).read_text() == text
    again = ry.Config()
    again.addFile(tmp_path / name)
    assert again.getJointNames() == ["b"]


def test_a_file_that_cannot_be_written_is_an_error(config: ry.Config, tmp_path) -> None:
    with pytest.raises(ry.FileError, match="cannot be written"):
        config.write(tmp_path / "missing" / "s.g")


def test_files_that_attributes_name_are_found_after_saving_elsewhere(tmp_path) -> None:
    shutil.copy(DATA / "images" / "colors.png", tmp_path / "picture.png")
    (tmp_path / "a.g").write_text("a: { shape: box, size: [1 1 1], texture: <picture.png>, note: <nothing.png> }")
    C = ry.Config()
    C.addFile(tmp_path / "a.g")
    assert f"texture: <{tmp_path / 'picture.png'}>, note: <{tmp_path / 'nothing.png'}>" in C.write()
