"""BotOp's straight and circular motions of a tool: distances from the curve, appended and overwritten motions."""

import numpy as np
import pytest

import kinegraph as ry

TOOL = "l_gripper"


@pytest.fixture
def cell():
    C = ry.Config()
    C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
    return C, ry.BotOp(C, driver=ry.KinematicDriver(C))


def track(C, bot):
    """Poses of the tool at all control periods until the end of the motion, shape (K, 7)."""
    poses = []
    while bot.getTimeToEnd() > 0:
        bot.sync(C, 0.01)
        poses.append(C.getFrame(TOOL).getPose())
    return np.array(poses)


def test_a_linear_move_is_straight_and_keeps_the_rotation(cell):
    C, bot = cell
    start = C.getFrame(TOOL).getPose()
    way = np.array([0.1, 0.1, -0.1])
    plan = bot.moveLinear(TOOL, start[:3] + way, 0.2)
    assert plan and plan.deviation[0] <= 2e-5
    poses = track(C, bot)
    moved = poses[:, :3] - start[:3]
    assert np.linalg.norm(np.cross(moved, way / np.linalg.norm(way)), axis=1).max() < 2.1e-5
    assert np.abs(np.abs(poses[:, 3:] @ start[3:]) - 1).max() < 1e-8
    assert np.allclose(poses[-1, :3], start[:3] + way, atol=2e-5)


def test_moves_in_a_row_make_a_program(cell):
    C, bot = cell
    start = C.getFrame(TOOL).getPose()
    first, top, end = (
        start[:3] + np.array([0, 0, 0.1]),
        start[:3] + np.array([0.05, 0.05, 0.1]),
        start[:3] + np.array([0.1, 0, 0.1]),
    )
    assert bot.moveLinear(TOOL, first, speed=0.2)
    assert bot.moveCircular(TOOL, top, end, speed=0.2)
    p = track(C, bot)[:, :3]
    on_line = p[:, 2] < first[2] - 1e-4
    assert on_line.any() and np.abs(p[on_line, :2] - start[:2]).max() < 2.1e-5
    center = start[:3] + np.array([0.05, 0, 0.1])
    assert np.abs(np.linalg.norm(p[~on_line] - center, axis=1) - 0.05).max() < 1.2e-4
    assert np.allclose(p[-1], end, atol=2e-5)


def test_sequences_blend_their_corners_and_paths_may_have_a_start(cell):
    C, bot = cell
    start = C.getFrame(TOOL).getPose()
    corner, end = start[:3] + np.array([0.1, 0, 0]), start[:3] + np.array([0.1, 0.1, 0])
    plan = bot.moveSequence(TOOL, [corner, np.r_[end, start[3:]]], blend=0.03, speed=0.1)
    assert plan and bot.getTimeToEnd() == pytest.approx(plan.duration, abs=0.02)
    p = track(C, bot)[:, :3]
    assert 1e-3 < np.linalg.norm(p - corner, axis=1).min() < 0.03
    path = ry.ToolPath(TOOL).start(start).line(corner)
    plan = bot.moveSequence(path, speed=0.2)
    assert [kind for kind, *_ in plan.segments] == ["transfer", "path"]
    assert np.allclose(track(C, bot)[-1, :3], corner, atol=2e-5)


def test_transfers_to_paths_flow_into_them_if_asked(cell):
    C, bot = cell
    start = C.getFrame(TOOL).getPose()
    path = (
        ry.ToolPath(TOOL).start(start + np.r_[0.1, 0, -0.1, 0, 0, 0, 0]).line(start[:3] + np.array([0.1, 0.15, -0.1]))
    )
    home, entered = bot.get_q(), []
    for flow in ("none", "path"):
        plan = bot.moveSequence(path.free(), speed=0.3, flow=flow, tool_acceleration=0.8)
        assert [kind for kind, *_ in plan.segments] == ["transfer", "path"]
        entered.append(plan.speed(plan.segments[1][3] + 1e-6))
        bot.wait(C)
        bot.moveTo(home, 1.0)
        bot.wait(C)
    assert entered[0] < 1e-3 and entered[1] > 0.05
    plan = bot.moveSequence(path, speed=0.3, approach=0.05, retract=0.05)
    assert [kind for kind, *_ in plan.segments] == ["transfer", "approach", "path", "retract"]
    with pytest.raises(ry.ArgumentError, match="flow is 'paths'; expected one of none, approach, path"):
        bot.moveSequence(path, flow="paths")


def test_overwrite_brakes_first(cell):
    C, bot = cell
    target = C.getFrame(TOOL).getPosition() + np.array([0.1, 0.1, -0.1])
    bot.moveTo(bot.get_q() + 0.3, 2.0)
    bot.sync(C, 0.4)
    assert np.abs(bot.get_qDot()).max() > 0.05
    assert bot.moveLinear(TOOL, target, speed=0.2, overwrite=True)
    velocity = [bot.get_qDot()]
    while bot.getTimeToEnd() > 0:
        bot.sync(C, 0.01)
        velocity.append(bot.get_qDot())
    assert np.abs(np.diff(velocity, axis=0)).max() < 0.3
    assert np.allclose(C.getFrame(TOOL).getPosition(), target, atol=2e-5)


def test_without_a_motion_the_robot_stays_and_a_warning_says_why(cell):
    bot = cell[1]
    q = bot.get_q()
    with pytest.warns(ry.KinegraphWarning, match=r"moveLinear: there is no motion: path 0, 0\.\d+ m"):
        plan = bot.moveLinear(TOOL, [2.0, 0, 1], speed=0.2)
    assert not plan and plan.where[1] > 0.01
    assert np.array_equal(bot.get_q(), q)
    with pytest.raises(ry.FrameNotFound, match="l_griper"):
        bot.moveLinear("l_griper", [0.4, 0, 1])
    with pytest.raises(ry.ArgumentError, match="moveCircular: the pose has 4 numbers"):
        bot.moveCircular(TOOL, [0.4, 0, 1, 0], [0.4, 0, 1])
