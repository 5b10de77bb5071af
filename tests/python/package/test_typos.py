"""Typical typing errors and their messages, which were read with the eyes of a beginner."""

from __future__ import annotations

import warnings
from pathlib import Path

import pytest

import kinegraph as ry

ERRORS = {
    "box(wrold): {}": "2:1: parent of 'box': 'wrold' is not a frame of this scene; similar names: world",
    "box(world): {shape: bx, size: [.1 .1 .1]}": "2:21: frame 'box', shape: unknown shape type 'bx'; expected one of box, sphere",
    "box(world): {shape: cube, size: [.1 .1 .1]}": "the shape cube of other formats is box",
    "box(world): {shape: box, size: [.1 .1 .1}": "2:39: '.1}' is not a number; is a ']' missing?",
    "box(world): {shape: box, size: .1 .1 .1}": "size of a box has 3 numbers [x y z], not 1; write several numbers in brackets: [1 2 3]",
    "box(world): {shape: box, size: [10cm 1 1]}": "'10cm' is not a number; numbers have no units: lengths are in m, masses in kg, times in s, angles in rad",
    "box(world): {shape: box, size: [1 1 1], color: red}": "color: expected numbers [r g b] in 0..1, got the text 'red'",
    "arm(world): {joint: revolute}": "use hingeX, hingeY or hingeZ, or hinge with axis: [x y z] for revolute",
    "arm(world): {type: hingeX}": "'hingeX' is a joint type; write joint: hingeX",
    "arm(world): {pose: 0 0 1}": "expected a pose, got a single number; write several numbers in brackets: [1 2 3]",
    'arm(world): {Q: "t(0 0 1) d(90 0 0)"}': "'d' takes 4 numbers (degrees x y z), not 3",
    "box: {Q: [0 0 1]}": "a frame without a parent has no relative pose; write 'name (parent): { ... }', or Q as X",
    "include: <other.g>": "similar names: Include",
    "box(world)": "2:1: 'box (world)' has no attributes; write 'box (world): { ... }', the { on the same line",
    "box(world): {shape: sphere, size: [1]}}": "this '}' closes nothing; is an earlier '}' superfluous?",
}
WARNINGS = {
    "box(world): {shpae: box}": "unknown attribute 'shpae'; did you mean 'shape'?",
    "box(world): {shape: box, size: [1 1 1], pos: [0 0 1]}": "unknown attribute 'pos'; did you mean 'pose'?",
    "box(world): {shape: box, size: [1 1 1], color: [255 0 0]}": "color has numbers above 1; expected 0..1",
    "box(world): {shape: box, size: [1 1 1], size: [2 2 2]}": "'size' is given twice; the first counts",
    "arm(world): {joint: hingeX, pose: [0 0 1]}": "its hingeX joint cannot reach the pose given by pose and takes the nearest",
    "box world {shape: sphere, size: [1]}": "names contain no blanks: this is frame 'world' with the tag 'box'; parents are in parentheses, as in box (world)",
    "arm(world): {\nbox(arm): {}": "'box (arm)' is inside of this frame, and no frame; is a '}' missing before it?",
}


@pytest.mark.parametrize("line", ERRORS)
def test_an_error_says_where_and_how_to_mend_it(line: str, tmp_path: Path) -> None:
    (tmp_path / "scene.g").write_text(f"world: {{}}\n{line}\n")
    with pytest.raises(ry.ParseError) as raised:
        ry.Config().addFile(tmp_path / "scene.g")
    message = str(raised.value)
    assert ERRORS[line] in message
    assert f"{tmp_path}/scene.g:2:" in message and "^" in message
    assert message.count("scene.g:") == 1  # one mistake, one message


@pytest.mark.parametrize("line", WARNINGS)
def test_suspicious_input_is_a_warning(line: str, tmp_path: Path) -> None:
    (tmp_path / "scene.g").write_text(f"world: {{}}\n{line}\n")
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        ry.Config().addFile(tmp_path / "scene.g")
    assert any(WARNINGS[line] in str(warning.message) for warning in caught)


def test_an_option_that_is_similar_to_none_is_answered_with_all() -> None:
    C = ry.Config()
    C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
    with pytest.raises(ry.ArgumentError, match="there is no option 'timeout'; expected one of .*margin, "):
        ry.planMotion(C, goal=C.getJointState(), timeout=3.0)
    with pytest.raises(ry.ArgumentError, match="there is no option 'margn'; similar names: margin"):
        ry.planMotion(C, goal=C.getJointState(), margn=3.0)


def test_xml_is_no_scene(tmp_path: Path) -> None:
    (tmp_path / "robot.g").write_text('<?xml version="1.0"?>\n<robot name="r"/>')
    with pytest.raises(ry.ParseError, match="the text is XML, not a .g scene; URDF files end in .urdf"):
        ry.Config().addFile(tmp_path / "robot.g")


def test_file_values_come_back_as_they_are_written(tmp_path: Path) -> None:
    (tmp_path / "scene.g").write_text("a: { x: <there/it.txt>, m: [[1 2], [3]], n: 1, n: 2 }")
    C = ry.Config()
    C.addFile(tmp_path / "scene.g")
    attributes = C["a"].getAttributes()
    assert attributes == {"x": f"<{tmp_path}/there/it.txt>", "m": [[1, 2], [3]], "n": 2}
    again = ry.Config()
    again.addDict(C.asDict())
    assert again.asDict() == C.asDict() and again.write() == C.write().replace("n: 1, ", "")
