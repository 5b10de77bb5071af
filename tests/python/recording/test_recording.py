"""Recordings in MCAP files, read back by this package and by two independent readers."""

import gc
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from mcap.reader import make_reader
from mcap_ros2.decoder import DecoderFactory
from rosbags.highlevel import AnyReader

import kinegraph as ry
from recorded_runs import ARM, recorded, scene, wave


def messages(path: Path) -> dict[str, list[Any]]:
    """The messages per topic, read by mcap-ros2-support."""
    found: dict[str, list[Any]] = {}
    with open(path, "rb") as file:
        for _, channel, _, message in make_reader(file, decoder_factories=[DecoderFactory()]).iter_decoded_messages():
            found.setdefault(channel.topic, []).append(message)
    return found


def pose_matrix(transform: Any) -> np.ndarray:
    t, r = transform.translation, transform.rotation
    matrix = np.eye(4)
    matrix[:3, :3] = ry.Quaternion([r.w, r.x, r.y, r.z]).getMatrix()
    matrix[:3, 3] = t.x, t.y, t.z
    return matrix


def test_recorded_states_are_those_of_the_robot_at_the_rate(tmp_path: Path) -> None:
    C = scene()
    bot = ry.BotOp(C)
    bot.recordTo(tmp_path / "run.mcap", rate=50)
    seen: list[tuple[float, np.ndarray, np.ndarray]] = []
    bot.watch(0.02, lambda time: seen.append((time, bot.get_q(), bot.get_qDot())))
    wave(bot, C)
    bot.recordTo("")
    states = messages(tmp_path / "run.mcap")["/joint_states"]
    assert len(states) == len(seen)
    assert states[0].name[:7] == C.getJointNames()
    assert states[0].name[7:] == ["l_panda_finger_joint1", "l_panda_finger_joint2"]
    for state, (time, q, velocity) in zip(states, seen, strict=True):
        assert state.header.stamp.sec + state.header.stamp.nanosec * 1e-9 == pytest.approx(time, abs=1e-9)
        np.testing.assert_array_equal(state.position[:7], q)
        np.testing.assert_array_equal(state.velocity[:7], velocity)
    assert 2 * states[-1].position[7] == pytest.approx(bot.getGripperPos(0), abs=1e-6)
    assert min(state.velocity[7] for state in states) < -0.01  # the fingers close


def test_a_recorded_motion_is_the_same_to_the_bit(tmp_path: Path) -> None:
    _, with_file = recorded(tmp_path / "run.mcap")
    C = scene()
    without = ry.BotOp(C)
    wave(without, C)
    np.testing.assert_array_equal(with_file.get_q(), without.get_q())
    assert with_file.get_t() == without.get_t()


def test_transforms_give_the_poses_of_all_links(tmp_path: Path) -> None:
    C, bot = recorded(tmp_path / "run.mcap")
    found = messages(tmp_path / "run.mcap")
    parents: dict[str, tuple[str, np.ndarray]] = {}
    for topic in ("/tf_static", "/tf"):
        for message in found[topic]:
            for transform in message.transforms:
                parents[transform.child_frame_id] = transform.header.frame_id, pose_matrix(transform.transform)
    last = found["/joint_states"][-1].position[:7]
    C.setJointState(last)
    for link, frame in [("l_gripper", "l_gripper"), ("l_panda_joint4_link", "l_panda_joint4"), ("box", "box")]:
        pose, at = np.eye(4), link
        while at != "world":
            at, step = parents[at]
            pose = step @ pose
        np.testing.assert_allclose(pose, bot.getWorld().getFrame(frame).getTransform(), atol=1e-6)
    moving = {transform.child_frame_id for transform in found["/tf"][-1].transforms}
    assert {"l_panda_joint7_link", "box"} <= moving and "table" not in moving
    assert "<robot" in found["/robot_description"][0].data
    stamps = [message.clock.sec + message.clock.nanosec * 1e-9 for message in found["/clock"]]
    np.testing.assert_allclose(np.diff(stamps), 0.01, atol=1e-9)


def test_rosbags_reads_all_messages_with_their_definitions(tmp_path: Path) -> None:
    recorded(tmp_path / "run.mcap", cameras=["cameraTop"], camera_rate=5)
    with AnyReader([tmp_path / "run.mcap"]) as reader:
        counts = {connection.topic: connection.msgcount for connection in reader.connections}
        for connection, _, data in reader.messages():
            reader.deserialize(data, connection.msgtype)
        latched = {
            connection.topic
            for connection in reader.connections
            if connection.ext.offered_qos_profiles  # type: ignore[union-attr]
        }
    assert counts["/joint_states"] == counts["/tf"] == counts["/clock"] > 50
    assert latched == {"/tf_static", "/robot_description"}


def test_images_are_those_of_the_camera(tmp_path: Path) -> None:
    _, bot = recorded(tmp_path / "run.mcap", cameras=["cameraTop"], camera_rate=5)
    recording = ry.readRecording(tmp_path / "run.mcap")
    times, images = recording.images("cameraTop")
    np.testing.assert_allclose(np.diff(times), 0.2, atol=1e-9)
    assert np.abs(images[-1].astype(float) - bot.getImage("cameraTop")).mean() < 6
    info = messages(tmp_path / "run.mcap")["/cameraTop/camera_info"][0]
    fx, fy, cx, cy = bot.getCameraFxycxy("cameraTop")
    assert (info.height, info.width) == images[0].shape[:2]
    np.testing.assert_allclose(np.array(info.k), [fx, 0, cx, 0, fy, cy, 0, 0, 1])
    with pytest.raises(ry.NotFound, match="images: /cameraTop/image/compressed"):
        recording.images("cameraWrist")


def test_the_stamps_begin_at_start(tmp_path: Path) -> None:
    recorded(tmp_path / "run.mcap", start=1.7e9)
    recording = ry.readRecording(tmp_path / "run.mcap")
    assert recording.start == pytest.approx(1.7e9, abs=0.1) and recording.times[0] == 0


def test_each_recording_ends_with_the_next_one_with_close_and_with_the_robot(tmp_path: Path) -> None:
    C = scene()
    bot = ry.BotOp(C)
    for name in ("a.mcap", "b.mcap"):
        bot.recordTo(tmp_path / name)
        bot.sync(C, 0.1)
    bot.recordTo(tmp_path / "c.dat")
    bot.sync(C, 0.1)
    bot.recordTo(tmp_path / "d.mcap")
    bot.sync(C, 0.1)
    bot.close()
    other = ry.BotOp(C)
    other.recordTo(tmp_path / "e.mcap")
    other.sync(C, 0.1)
    del other
    gc.collect()
    for name in "abde":
        recording = ry.readRecording(tmp_path / f"{name}.mcap")
        assert recording.complete and len(recording.times) in (10, 11)
    assert len((tmp_path / "c.dat").read_text().splitlines()) >= 10


def run(code: str, folder: Path) -> subprocess.CompletedProcess[str]:
    start = (
        "import os, signal, resource, kinegraph as ry\n"
        f"C = ry.Config(); C.addFile(ry.raiPath('{ARM}')); bot = ry.BotOp(C)\n"
    )
    return subprocess.run([sys.executable, "-c", start + code], cwd=folder, capture_output=True, text=True, timeout=300)


def test_a_killed_process_loses_only_the_last_chunk(tmp_path: Path) -> None:
    done = run(
        "bot.recordTo('run.mcap')\nbot.moveTo(bot.get_q() + .3)\n"
        "bot.watch(.01, lambda t: os.kill(os.getpid(), signal.SIGKILL) if t > 1.5 else None)\nbot.wait(C)",
        tmp_path,
    )
    assert done.returncode == -9
    with pytest.warns(ry.KinegraphWarning, match="was not closed, as after a crash; it is read up to 1"):
        recording = ry.readRecording(tmp_path / "run.mcap")
    assert not recording.complete and recording.times[-1] > 1.2
    np.testing.assert_allclose(np.diff(recording.times), 0.01, atol=1e-9)


def test_a_full_disk_holds_the_robot_and_keeps_the_recording(tmp_path: Path) -> None:
    done = run(
        "signal.signal(signal.SIGXFSZ, signal.SIG_IGN)\n"
        "resource.setrlimit(resource.RLIMIT_FSIZE, (60000, 60000))\n"
        "bot.recordTo('run.mcap')\nbot.moveTo(bot.get_q() + .5)\n"
        "try:\n    bot.wait(C)\nexcept ry.FileError as error:\n    print(error)\n"
        "bot.sync(C, .5)\nprint(bot.getMode(), abs(bot.stepObservation().qvel_ref).max())\nbot.close()\n",
        tmp_path,
    )
    message, mode = done.stdout.splitlines()
    assert message.startswith(
        "BotOp.recordTo: cannot write 'run.mcap': File too large; the recording ends shortly before"
    )
    assert mode == "LoopMode.hold 0.0" and done.stderr == ""
    with pytest.warns(ry.KinegraphWarning, match="was not closed"):
        assert len(ry.readRecording(tmp_path / "run.mcap").times) > 20


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="needs /dev/full")
def test_a_disk_without_space_is_refused_at_once(tmp_path: Path) -> None:
    (tmp_path / "run.mcap").symlink_to("/dev/full")
    with pytest.raises(ry.FileError, match="cannot write .*: No space left on device"):
        ry.BotOp(scene()).recordTo(tmp_path / "run.mcap")
    with pytest.raises(ry.FileError, match="cannot write .*: No such file or directory"):
        ry.BotOp(scene()).recordTo(tmp_path / "none/run.mcap")


def test_wrong_settings_are_refused_and_no_file_is_made(tmp_path: Path) -> None:
    bot = ry.BotOp(scene())
    file = tmp_path / "run.mcap"
    with pytest.raises(ry.ArgumentError, match="rate is 0"):
        bot.recordTo(file, rate=0)
    with pytest.raises(ry.ArgumentError, match="camera_rate is inf"):
        bot.recordTo(file, camera_rate=float("inf"))
    with pytest.raises(ry.ArgumentError, match="start is -1"):
        bot.recordTo(file, start=-1)
    with pytest.raises(ry.ArgumentError, match=r"expected a list of names, \['cameraTop'\]"):
        bot.recordTo(file, cameras="cameraTop")
    with pytest.raises(ry.FrameNotFound, match="cameraTob"):
        bot.recordTo(file, cameras=["cameraTob"])
    assert not file.exists()


# --- replay -----------------------------------------------------------------------------------------------------------


def test_a_robot_repeats_the_recorded_references_to_the_bit(tmp_path: Path) -> None:
    C, _ = recorded(tmp_path / "run.mcap")
    recording = ry.readRecording(tmp_path / "run.mcap", topic="/joint_commands")
    again = ry.BotOp(scene(), driver=ry.KinematicDriver(scene()))
    again.follow(recording.trajectory(C))
    seen: list[np.ndarray] = []
    again.watch(0.0, lambda time: seen.append(again.get_q()))
    again.wait(C)
    np.testing.assert_allclose(seen[-1], recording.q[-1], atol=1e-12)
    inner = np.array(seen)[:, 0]
    assert np.abs(np.interp(0.5, np.linspace(0, 1, len(inner)), inner) - recording.q[len(recording.q) // 2, 0]) < 0.02


def test_a_replay_beyond_the_limits_is_refused(tmp_path: Path) -> None:
    C, _ = recorded(tmp_path / "run.mcap")
    recording = ry.readRecording(tmp_path / "run.mcap", topic="/joint_commands")
    again = ry.BotOp(scene(), driver=ry.KinematicDriver(scene()))
    with pytest.raises(ry.ArgumentError, match="velocity"):
        again.follow(recording.trajectory(C, speed=20))
    assert again.getTimeToEnd() <= 0


def test_recordings_of_other_robots_and_broken_states_are_refused(tmp_path: Path) -> None:
    C, _ = recorded(tmp_path / "run.mcap")
    recording = ry.readRecording(tmp_path / "run.mcap")
    other = ry.Config()
    other.addFrame("base")
    other.addFrame("shoulder", "base", "joint: hingeZ")
    with pytest.raises(ry.NotFound, match=r"has no joint 'shoulder' \(1 of 1 are missing\); it has l_panda_joint1, "):
        recording.trajectory(other)
    with pytest.raises(ry.NotFound, match="'elbow', which is no joint of the scene: shoulder"):
        recording.trajectory(other, names={"elbow": "l_panda_joint1"})
    assert recording.trajectory(other, names={"shoulder": "l_panda_joint1"}).eval(0.0)[0] == recording.q[0, 0]
    with pytest.raises(ry.ArgumentError, match="0 recorded states lie between 100 s and inf s"):
        recording.trajectory(C, begin=100)
    with pytest.raises(ry.ArgumentError, match="speed is 0"):
        recording.trajectory(C, speed=0)
    recording.q[7, 2] = np.nan
    with pytest.raises(ry.ArgumentError, match=r"joint 'l_panda_joint3' at 0.070 s is not finite"):
        recording.trajectory(C)
    stopped = ry.BotOp(C, driver=recording.driver(C))
    with pytest.raises(ry.RobotFault, match="finite"):
        stopped.sync(C, 0.5)


def test_a_recorded_driver_repeats_arm_and_hand(tmp_path: Path) -> None:
    C, bot = recorded(tmp_path / "run.mcap")
    recording = ry.readRecording(tmp_path / "run.mcap")
    replay = ry.BotOp(C, driver=recording.driver(C))
    replay.sync(C, recording.times[-1] + 0.1)
    np.testing.assert_allclose(replay.get_q(), recording.q[-1, :7])
    assert replay.getGripperPos(0) == pytest.approx(bot.getGripperPos(0), abs=1e-3)


# --- simulations and plans --------------------------------------------------------------------------------------------


def test_a_simulation_records_its_steps(tmp_path: Path) -> None:
    C = scene()
    C.getFrame("box").setRelativePosition([0.2, 0.25, 0.3])  # it falls
    simulation = ry.Simulation(C)
    q = simulation.get_q()
    simulation.recordTo(tmp_path / "fall.mcap")
    for _ in range(30):
        simulation.step(q, 0.01, ry.ControlMode.position)
    simulation.multi_step(0.2)
    simulation.recordTo("")
    simulation.step(q, 0.01, ry.ControlMode.position)
    found = messages(tmp_path / "fall.mcap")
    assert len(found["/joint_states"]) == 51 and len(found["/joint_states"][0].effort) == 9
    heights = [
        next(t.transform.translation.z for t in message.transforms if t.child_frame_id == "box")
        for message in found["/tf"]
    ]
    assert heights[0] - heights[-1] > 0.15
    with pytest.raises(ry.ArgumentError, match="ends in .mcap"):
        simulation.recordTo(tmp_path / "fall.txt")


def test_a_recorded_simulation_converts(tmp_path: Path) -> None:
    C = scene()
    C.getFrame("box").setRelativePosition([0.2, 0.25, 0.3])
    simulation = ry.Simulation(C)
    simulation.startRecording()
    for _ in range(30):
        simulation.step([], 0.01)
    run = simulation.stopRecording()
    ry.saveRecording(tmp_path / "fall.mcap", run)
    recording = ry.readRecording(tmp_path / "fall.mcap")
    np.testing.assert_allclose(recording.q[:, :7], run.q, atol=1e-12)
    last = messages(tmp_path / "fall.mcap")["/tf"][-1]
    box = next(t.transform.translation.z for t in last.transforms if t.child_frame_id == "box")
    free = [frame.name for frame in simulation.getFreeFrames()].index("box")
    assert box == pytest.approx(run.freePos[-1, free, 2] - C.getFrame("table").getPosition()[2], abs=1e-9)


def test_plans_of_motions_and_tasks_are_saved(tmp_path: Path) -> None:
    C = scene()
    plan = ry.planMotion(C, np.add(C.getJointState(), [0.4, 0, 0, 0, 0, 0, 0]))
    ry.saveRecording(tmp_path / "plan.mcap", plan, C)
    recording = ry.readRecording(tmp_path / "plan.mcap")
    assert recording.times[-1] == pytest.approx(plan.duration, abs=0.01)
    np.testing.assert_allclose(recording.trajectory(C).eval(0.3)[0], plan.eval(0.3)[0], atol=1e-3)
    tray = C.addFrame("tray", "table").setRelativePosition([-0.25, 0.25, 0.055])
    tray.setShape(ry.ST.ssBox, [0.14, 0.14, 0.01, 0.004]).setContact(1)
    task = ry.planTask(C, "(on tray box)")
    before = C.getFrameState()
    ry.saveRecording(tmp_path / "task.mcap", task, C)
    np.testing.assert_array_equal(C.getFrameState(), before)
    assert len(ry.readRecording(tmp_path / "task.mcap").times) > 50
    with pytest.raises(ry.ArgumentError, match="config is None"):
        ry.saveRecording(tmp_path / "plan.mcap", plan)
    with pytest.raises(ry.ArgumentError, match="the motion has 7 joint values; the scene has 0"):
        ry.saveRecording(tmp_path / "plan.mcap", plan, ry.Config())
