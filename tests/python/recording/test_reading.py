"""readRecording reads files of others, and what is right in damaged ones."""

import os
import warnings
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import kinegraph as ry
from kinegraph.recording import messages
from kinegraph.recording.files import McapFile
from recorded_runs import recorded, scene, wave

State = tuple[str, int, list[str], list[float], list[float]]


def write_bag(folder: Path, storage: Any, states: list[State], compression: str = "") -> None:
    """Writes joint states as rosbag2 does; rosbags is the writer."""
    from rosbags.rosbag2 import CompressionFormat, CompressionMode, Writer
    from rosbags.typesys import Stores, get_typestore

    store = get_typestore(Stores.ROS2_JAZZY)
    types = store.types
    writer = Writer(folder, version=9, storage_plugin=storage)
    if compression:
        writer.set_compression(CompressionMode[compression], CompressionFormat.ZSTD)
    with writer:
        topics: dict[str, Any] = {}
        for topic, time, names, q, velocity in states:
            if topic not in topics:
                topics[topic] = writer.add_connection(topic, "sensor_msgs/msg/JointState", typestore=store)
            stamp = types["builtin_interfaces/msg/Time"](time // 10**9, time % 10**9)
            message = types["sensor_msgs/msg/JointState"](
                types["std_msgs/msg/Header"](stamp, ""), names, np.array(q), np.array(velocity), np.zeros(0)
            )
            writer.write(topics[topic], time + 500, store.serialize_cdr(message, "sensor_msgs/msg/JointState"))


@pytest.mark.parametrize("storage", ["MCAP", "SQLITE3"])
def test_bags_with_other_orders_and_several_publishers_are_merged_by_name(tmp_path: Path, storage: str) -> None:
    from rosbags.rosbag2 import StoragePlugin

    second = 10**9
    states = []
    for k in range(5):
        at = 1_700_000_000 * second + k * second // 10
        states.append(("/joint_states", at, ["b", "a"], [10.0 + k, float(k)], []))
        states.append(("/joint_states", at + 1000, ["gripper"], [0.5], [0.0]))
    write_bag(tmp_path / "bag", StoragePlugin[storage], states)
    recording = ry.readRecording(tmp_path / "bag")
    assert recording.joints == ["b", "a", "gripper"] and recording.complete
    assert recording.start == pytest.approx(1.7e9, abs=1e-3)
    np.testing.assert_array_equal(recording.q[-1], [14.0, 4.0, 0.5])
    np.testing.assert_allclose(recording.q[0], [10.0, 0.0, 0.5])
    arm = ry.Config()
    arm.addFrame("base")
    arm.addFrame("a", "base", "joint: hingeZ")
    arm.addFrame("b", "a", "joint: hingeZ")
    motion = recording.trajectory(arm)
    np.testing.assert_allclose(motion.eval(motion.duration)[0], [4.0, 14.0])


@pytest.mark.parametrize("storage", ["MCAP", "SQLITE3"])
@pytest.mark.parametrize("mode", ["FILE", "MESSAGE"])
def test_compressed_bags_are_read(tmp_path: Path, storage: str, mode: str) -> None:
    from rosbags.rosbag2 import StoragePlugin

    states = [("/joint_states", k * 10**7, ["a"], [float(k)], [1.0]) for k in range(5)]
    write_bag(tmp_path / "bag", StoragePlugin[storage], states, mode)
    np.testing.assert_array_equal(ry.readRecording(tmp_path / "bag").q[:, 0], range(5))
    (next((tmp_path / "bag").glob("bag.*"))).write_bytes(b"x")
    with pytest.raises(ry.FileError, match="is not a readable bag"):
        ry.readRecording(tmp_path / "bag")


def test_a_topic_without_joint_states_is_named_with_the_others(tmp_path: Path) -> None:
    from rosbags.rosbag2 import StoragePlugin

    write_bag(tmp_path / "bag", StoragePlugin.MCAP, [("/arm/joint_states", 5, ["a"], [1.0], [])])
    with pytest.raises(ry.NotFound, match="no joint states on '/joint_states'; it has them on /arm/joint_states"):
        ry.readRecording(tmp_path / "bag")
    assert ry.readRecording(tmp_path / "bag", "/arm/joint_states").q[0, 0] == 1.0


def test_a_file_that_is_cut_or_damaged_anywhere_is_read_as_far_as_it_is_right(tmp_path: Path) -> None:
    recorded(tmp_path / "run.mcap")
    data = (tmp_path / "run.mcap").read_bytes()
    whole = ry.readRecording(tmp_path / "run.mcap")
    rng = np.random.default_rng(0)
    damaged = tmp_path / "damaged.mcap"
    for at in rng.integers(0, len(data), 60):
        for changed in (data[:at], data[:at] + rng.bytes(8) + data[at + 8 :], data[:at] + data[at + 100 :]):
            damaged.write_bytes(changed)
            with warnings.catch_warnings():
                warnings.simplefilter("ignore", ry.KinegraphWarning)
                try:
                    recording = ry.readRecording(damaged)
                except ry.FileError:
                    assert at < 100
                    continue
            if len(recording.times):
                rows = np.round((recording.times + recording.start - whole.start) * 100).astype(int)
                np.testing.assert_array_equal(recording.q, whole.q[rows])  # fewer states, but no wrong ones
    damaged.write_bytes(data[: len(data) // 2] + bytes(8) + data[len(data) // 2 + 8 :])
    with pytest.warns(ry.KinegraphWarning, match="has 1 damaged parts, which are left out"):
        assert not ry.readRecording(damaged).complete


def test_other_files_are_refused(tmp_path: Path) -> None:
    (tmp_path / "noise.mcap").write_bytes(os.urandom(100))
    (tmp_path / "noise.db3").write_bytes(b"x" * 100)
    (tmp_path / "empty").mkdir()
    for name, message in [
        ("noise.mcap", "is not an MCAP file"),
        ("noise.db3", "is not a bag of rosbag2"),
        ("empty", "has no files .mcap or .db3"),
        ("none.mcap", "there is no file"),
    ]:
        with pytest.raises(ry.FileError, match=message):
            ry.readRecording(tmp_path / name)


def test_a_recording_has_the_poses_of_frames_also_of_fingers_and_of_objects_that_were_moved(tmp_path: Path) -> None:
    C = scene()
    bot = ry.BotOp(C)
    bot.recordTo(tmp_path / "run.mcap")
    wave(bot, C)
    bot.setFramePose("box", [-0.3, 0.2, 0.8, 0.6, 0.0, 0.0, 0.8])
    bot.gripperMove(0, 0.02)
    bot.wait(C, forGripper=True)
    bot.recordTo("")
    recording = ry.readRecording(tmp_path / "run.mcap")
    start = scene()
    frames = recording.frames(start, rate=100)
    assert frames.shape == (round(recording.times[-1] * 100) + 1, len(C.getFrameNames()), 7)
    np.testing.assert_array_equal(start.getFrameState(), scene().getFrameState())
    index = C.getFrameNames().index
    np.testing.assert_allclose(frames[0, index("box")], start.getFrame("box").getPose(), atol=1e-3)
    end = start.copy()
    end.setFrameState(frames[-1])
    for name in ("box", "l_gripper", "l_finger1", "l_finger2"):
        np.testing.assert_allclose(end.getFrame(name).getPosition(), C.getFrame(name).getPosition(), atol=1e-4)
    np.testing.assert_allclose(
        end.getFrame("box").getRotationMatrix(), C.getFrame("box").getRotationMatrix(), atol=1e-3
    )
    with pytest.raises(ry.ArgumentError, match=r"Recording\.frames: rate is 0; expected a number > 0"):
        recording.frames(start, rate=0)
    with pytest.raises(ry.NotFound, match=r"Recording\.frames: .* has no joint"):
        recording.frames(other_arm())


def test_a_pose_in_an_unknown_frame_moves_nothing_and_a_warning_names_it(tmp_path: Path) -> None:
    file = McapFile(str(tmp_path / "run.mcap"), "test")
    pose, angle = np.array([0.1, 0.2, 0.3, 1.0, 0.0, 0.0, 0.0]), np.array([0.1])
    for k in range(3):
        at = k * 10**8
        file.send("/joint_states", messages.JOINT_STATE, messages.encodeJoints(at, ["other"], angle, angle), at)
        file.send("/tf", messages.TRANSFORMS, messages.encodeTransforms(at, [("map", "cup", pose)]), at)
    file.close()
    recording = ry.readRecording(tmp_path / "run.mcap")
    C = other_arm()
    C.addFrame("cup").setPosition([1.0, 0.0, 0.0])
    with pytest.warns(ry.KinegraphWarning, match=r"pose of 'cup' was recorded in 'map'.*Add a frame 'map'") as warned:
        frames = recording.frames(C, rate=10)
    assert len(warned) == 1
    np.testing.assert_array_equal(frames[-1, -1, :3], [1.0, 0.0, 0.0])
    C.addFrame("map").setPosition([0.0, 0.0, 1.0])
    cup = C.getFrameNames().index("cup")
    np.testing.assert_allclose(recording.frames(C, rate=10)[-1, cup, :3], [0.1, 0.2, 1.3])
    recording.q[1, 0] = np.nan
    with pytest.raises(
        ry.ArgumentError, match=r"Recording\.frames: the state of joint 'other' at 0.100 s is not finite"
    ):
        recording.frames(C)


def other_arm() -> ry.Config:
    C = ry.Config()
    C.addFrame("base")
    C.addFrame("other", "base", "joint: hingeZ")
    return C


def test_a_film_shows_a_recording_in_its_time(tmp_path: Path) -> None:
    import av

    C, _ = recorded(tmp_path / "run.mcap")
    recording = ry.readRecording(tmp_path / "run.mcap")
    with av.open(str(ry.saveFilm(tmp_path / "run.mp4", C, recording, rate=10, size=(64, 48)))) as film:
        count = sum(1 for _ in film.decode(video=0))
    assert count == round(recording.times[-1] * 10)
