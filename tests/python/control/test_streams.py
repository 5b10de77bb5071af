"""Targets from files, gamepads, functions and the browser."""

import struct
import time

import numpy as np
import pytest

import kinegraph as ry
from interrupts import interrupt_after


@pytest.fixture
def scene():
    C = ry.Config()
    C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
    C.addFrame("target").setPose(C.getFrame("l_gripper").getPose())
    ik = ry.DiffIk(C, velocity=2.0)
    ik.addTask(ry.FS.positionDiff, ["l_gripper", "target"])
    return C, ik


def written(tmp_path, text):
    path = tmp_path / "targets.csv"
    path.write_text(text)
    return path


def test_between_rows_positions_go_straight_and_rotations_turn_evenly(tmp_path):
    stream = ry.TargetFile(
        written(
            tmp_path,
            "t, x, y, z, qw, qx, qy, qz\n# a turn about z\n1, 0, 0, 1, 1, 0, 0, 0\n\n3, 2, 0, 1, 0, 0, 0, -2\n",
        )
    )
    assert stream.duration == 3
    third = np.pi / 2 / 4  # half the angle of a quarter of the turn
    assert np.allclose(stream(1.5), [0.5, 0, 1, np.cos(third), 0, 0, -np.sin(third)], atol=1e-15)
    assert np.allclose(stream(0), [0, 0, 1, 1, 0, 0, 0])
    assert np.allclose(stream(9), [2, 0, 1, 0, 0, 0, -1])
    assert np.allclose(ry.TargetFile(written(tmp_path, "0, 1, 2, 3\n"))(5), [1, 2, 3])


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("0, 1, 2\n", r"csv:1:1: 3 numbers; expected t, x, y, z"),
        ("0, 1, 2, 3\n1, 1, 2, 3, 1, 0, 0, 0\n", r"csv:2:1: 8 numbers; the lines before have 4"),
        ("0, 1, 2, 3\n0, 1, 2, 3\n", r"csv:2:1: time 0 does not come after 0"),
        ("0, 1, 2, 3\n1, 1, 2, inf\n", r"csv:2:10: 'inf' is not finite"),
        ("0, 1, two, 3\n", r"csv:1:7: 'two' is not a number; expected t, x"),
        ("0, 1, 2, 3, 0, 0, 0, 0\n", r"csv:1:1: the quaternion is zero"),
        ("t, x, y, z\n", r"the text has no poses"),
    ],
)
def test_a_file_that_is_not_as_expected_is_an_error_with_its_place(tmp_path, text, said):
    with pytest.raises(ry.errors.ParseError, match=said):
        ry.TargetFile(written(tmp_path, text))
    with pytest.raises(ry.errors.FileError, match="nowhere"):
        ry.TargetFile(tmp_path / "nowhere.csv")


def test_a_target_from_a_file_is_followed(tmp_path, scene):
    C, ik = scene
    start = np.array(C.getFrame("target").getPosition())
    end = start + np.array([0.1, 0.1, -0.05])
    rows = [np.append(0, start), np.append(1, end)]
    path = written(tmp_path, "\n".join(",".join(map(repr, map(float, row))) for row in rows))
    ry.servo(ik, C, "target", ry.TargetFile(path), seconds=1.2, realtime=False)
    assert np.linalg.norm(C.getFrame("l_gripper").getPosition() - end) < 1e-4


def test_a_gamepad_pushes_the_target(tmp_path, scene):
    C, ik = scene
    device = tmp_path / "js0"
    events = [(1, 32767, 0x82, 0), (2, 16384, 2, 4), (3, 1000, 2, 1), (4, 1, 1, 0)]  # x, z, a dead y, a button
    device.write_bytes(b"".join(struct.pack("<IhBB", *event) for event in events))
    pad = ry.Gamepad(str(device), speed=0.1)
    assert np.allclose(pad.velocity(), [0.1, 0, -0.05], atol=1e-5)
    start = np.array(C.getFrame("target").getPosition())
    ry.servo(ik, C, "target", pad, seconds=0.5, realtime=False)
    pad.close()
    assert np.allclose(C.getFrame("target").getPosition(), start + np.array([0.05, 0, -0.025]), atol=1e-5)
    assert np.linalg.norm(C.getFrame("l_gripper").getPosition() - start - [0.05, 0, -0.025]) < 1e-3
    with pytest.raises(ry.errors.FileError, match="is a gamepad connected"):
        ry.Gamepad(str(tmp_path / "js7"))


def test_a_function_of_time_moves_the_target_and_mistakes_are_named(scene):
    C, ik = scene
    start = np.array(C.getFrame("target").getPosition())
    ry.servo(ik, C, "target", lambda t: start + np.array([0, 0, 0.1 * t]), seconds=0.5, realtime=False)
    assert np.linalg.norm(C.getFrame("l_gripper").getPosition() - start - [0, 0, 0.05]) < 1e-3
    with pytest.raises(ry.errors.FrameNotFound, match="target"):
        ry.servo(ik, C, "traget", lambda t: start, seconds=1)
    with pytest.raises(ry.errors.ArgumentError, match="seconds is 0"):
        ry.servo(ik, C, "target", lambda t: start, seconds=0)
    with pytest.raises(ry.errors.ArgumentError, match="2 numbers; expected x y z"):
        ry.servo(ik, C, "target", lambda t: start[:2], seconds=1, realtime=False)
    with pytest.raises(TypeError, match="expected a TargetFile, a Gamepad"):
        ry.servo(ik, C, "target", start, seconds=1)


def test_ctrl_c_ends_a_drive_and_other_threads_go_on_meanwhile(scene):
    C, ik = scene
    start = np.array(C.getFrame("target").getPosition())
    with pytest.raises(KeyboardInterrupt), interrupt_after(0.2):  # by a thread
        ry.servo(ik, C, "target", lambda t: start, seconds=60)


def test_the_handle_in_the_browser_moves_the_target(scene):
    connect = pytest.importorskip("websockets.sync.client").connect
    C, ik = scene
    C.view()
    pose = [*(C.getFrame("target").getPosition() + np.array([0.05, 0, 0.02])), 1, 0, 0, 0]
    with connect(C.viewer().url.replace("http", "ws"), max_size=None) as page:
        page.recv(20)
        for structure in range(200):  # a command that is for another one than that of the scene is dropped
            page.send(struct.pack("<4i7d", 5, structure, C.getFrame("target").ID, 7, *pose))
        until = time.monotonic() + 20
        while not C.viewer().hasEdits() and time.monotonic() < until:
            time.sleep(0.01)
        ry.servo(ik, C, "target", seconds=0.5, realtime=False)
    assert np.allclose(C.getFrame("target").getPosition(), pose[:3], atol=1e-6)
    assert np.linalg.norm(C.getFrame("l_gripper").getPosition() - pose[:3]) < 1e-3
