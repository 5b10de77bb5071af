"""Transfers that flow into approaches and paths: velocities by differences, limits by an independent sampling."""

import numpy as np
import pytest

import kinegraph as ry
from tool_motion import LIMITS, X, Y, Z, poses, samples


def strokes(C):
    start = C.getFrame("tool").getPose()
    return [
        ry.ToolPath("tool").start(start + np.r_[d, np.zeros(4)]).line(start[:3] + d + 0.15 * Y).free()
        for d in (0.1 * X - 0.1 * Z, -0.1 * X - 0.1 * Z, -0.15 * Z)
    ]


def planned(C, flow, **options):
    plan = ry.planToolPath(
        C,
        strokes(C),
        speed=0.3,
        flow=flow,
        transfer_from=C.getJointState() + 0.2,
        tool_acceleration=0.8,
        **(LIMITS | options),
    )
    assert plan, plan.message
    return plan


def arrivals(plan):
    """Times at which transfers end."""
    return [end for kind, *_, end in plan.segments if kind == "transfer"]


def worst_shares(C, plan, jerk):
    h = 5e-4
    q = plan.eval(np.arange(0.0, plan.duration, h))[0]
    v, a, j = (np.abs(np.diff(q, k, axis=0)) / h**k for k in (1, 2, 3))
    shares = [np.max(v / C.getVelocityLimits()), a.max() / LIMITS["acceleration"]]
    return shares + ([j.max() / jerk] if jerk else [])


@pytest.mark.parametrize("jerk", [None, 120.0])
def test_transfers_flow_into_approaches_within_all_limits(scene, jerk):
    C = scene
    resting, plan = (planned(C, flow, approach=0.06, retract=0.06, jerk=jerk) for flow in ("none", "approach"))
    assert plan.duration < resting.duration - 0.05
    assert max(worst_shares(C, plan, jerk)) <= 1.001
    assert plan.firstContact(C) is None
    assert C.isValid(samples(plan)[1]).all()
    moving = 0
    for t in arrivals(plan):
        before, after = plan.eval(t - 1e-9), plan.eval(t + 1e-9)
        np.testing.assert_allclose(before[0], after[0], atol=1e-7)
        np.testing.assert_allclose(before[1], after[1], atol=1e-6)
        if jerk:
            np.testing.assert_allclose(before[2], after[2], atol=1e-4)
        moving += np.abs(after[1]).max() > 0.05
    assert moving >= 2
    for t in arrivals(resting):
        assert np.abs(resting.eval(t)[1]).max() < 1e-9


def test_the_tool_keeps_to_paths_that_it_enters_at_speed(scene):
    C = scene
    plan = planned(C, "path", jerk=None)
    assert plan.duration < planned(C, "approach", jerk=None).duration - 0.05
    for kind, path, _, begin, end in plan.segments:
        if kind != "path":
            continue
        x = poses(C, plan.eval(np.arange(begin, end, 1e-3))[0])[:, :3]
        a = C.getFrame("tool").getPosition() + (0.1 * X - 0.1 * Z, -0.1 * X - 0.1 * Z, -0.15 * Z)[path]
        assert np.abs((x - a)[:, [0, 2]]).max() <= plan.deviation[0]
        assert (x - a)[:, 1].min() >= -1e-6 and (x - a)[:, 1].max() <= 0.15 + 1e-6
    assert max(plan.speed(t + 1e-6) for t in arrivals(plan)) > 0.1


def test_paths_without_an_approach_start_at_rest_unless_asked(scene):
    C = scene
    plan = planned(C, "approach")
    for t in arrivals(plan):
        assert np.abs(plan.eval(t)[1]).max() < 1e-9
        assert plan.speed(t) < 1e-9


def test_the_path_behind_an_approach_starts_at_rest(scene):
    plan = planned(scene, "approach", approach=0.06, retract=0.06)
    for kind, *_, begin, _ in plan.segments:
        if kind == "path":
            assert plan.speed(begin) < 1e-3


def test_another_name_of_a_flow_is_an_error(scene):
    with pytest.raises(ry.ArgumentError, match="flow is 'aproach'; expected one of none, approach, path"):
        ry.planToolPath(scene, strokes(scene), flow="aproach")
