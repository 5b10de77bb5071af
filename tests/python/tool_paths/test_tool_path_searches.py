"""Searches along tool paths: tolerances of rows, time limits, orders, warnings, and what ends a motion."""

import time

import numpy as np
import pytest

import kinegraph as ry
from tool_motion import X, Y, Z


def test_noisy_rows_are_smoothed_within_the_tolerance(scene):
    start = scene.getFrame("tool").getPosition()
    s = np.linspace(0.0, 0.2, 201)
    rows = start + s[:, None] * X + 1e-4 * np.random.default_rng(0).normal(size=(201, 3))
    plan = ry.planToolPath(scene, ry.ToolPath.along(rows).free(), speed=0.1, tolerance=3e-3, time_limit=20)
    assert plan, plan.message
    assert plan.deviation[0] <= 3e-3
    assert plan.duration < 3.0  # the noise itself would allow .4 mm/s


def test_the_time_limit_ends_a_search_along_one_path(scene):
    start = scene.getFrame("tool").getPosition()
    noise = 1e-4 * np.random.default_rng(0).normal(size=(801, 3))  # larger than the tolerance: many knots
    rows = start + np.linspace(0.0, 0.2, 801)[:, None] * X + noise
    begin = time.monotonic()
    plan = ry.planToolPath(scene, ry.ToolPath.along(rows).free(), time_limit=0.01)
    assert plan.status == ry.ToolPathStatus.out_of_time, plan.message
    assert time.monotonic() - begin < 5
    for limit in (0.0, -1.0, float("nan")):
        with pytest.raises(ry.ArgumentError, match="time_limit is .*; expected a number > 0"):
            ry.planToolPath(scene, ry.ToolPath.along(rows), time_limit=limit)


def test_a_free_order_takes_no_longer_than_the_given_one(scene):
    start = scene.getFrame("tool").getPosition() - 0.1 * Z
    paths = [
        ry.ToolPath("tool").free().start(start + 0.05 * k * X).line(start + 0.05 * k * X + 0.1 * Y)
        for k in range(-3, 4)
    ]
    given, free = (ry.planToolPath(scene, paths, order=o, approach=0.03, retract=0.03) for o in ("given", "free"))
    assert free.duration <= given.duration + 1e-9


def test_a_start_elsewhere_is_a_warning(scene):
    q = scene.getJointState()
    path = ry.ToolPath("tool").line(scene.getFrame("tool").getPosition() + 0.1 * Y)
    assert not ry.planToolPath(scene, path, start=q).warnings
    q[1] += 0.1
    (warning,) = ry.planToolPath(scene, path, start=q).warnings
    assert "m from the beginning of the path" in warning


def test_many_corners_are_a_warning(scene):
    start = scene.getFrame("tool").getPosition()
    path = ry.ToolPath("tool").free()
    for angle in np.linspace(0.1, np.pi, 40):
        path.line(start + 0.04 * (np.sin(angle) * X + (1 - np.cos(angle)) * Y))
    plan = ry.planToolPath(scene, path)
    assert plan.warnings == ["path 0: the tool stops at 39 corners; `blend` rounds them"]


def test_contact_of_a_whole_motion_names_the_pair(scene):
    """A sphere that touches a part: free at samples, and not provably free."""
    C = scene
    C.addFrame("grinder").setPosition([0.4, 0.3, 0.9]).setShape(ry.ST.sphere, [0.03]).setContact(1)
    part = C.addFrame("part", "tool").setShape(ry.ST.ssBox, [0.1, 0.1, 0.02, 0.005])
    part.setRelativePosition([0, 0, -0.02]).setContact(-2)
    s = np.linspace(-0.04, 0.04, 81)
    points = np.stack([s, 0 * s, 0 * s - 0.04], axis=1)
    plan = ry.planToolPath(C, ry.ToolPath.along(points, frame="grinder", relativeTo="part").free(), speed=0.05)
    assert plan.status == ry.ToolPathStatus.in_collision, plan.message
    assert sorted(plan.frames) == ["grinder", "part"]
    assert len(plan.reached) > 0


def test_a_robot_that_follows_a_failure_says_what_failed(scene):
    plan = ry.planToolPath(scene, ry.ToolPath("tool").line(scene.getFrame("tool").getPosition() + 3 * Y))
    with pytest.raises(ry.ArgumentError, match="there is no motion: path 0, .*no configuration reaches the path"):
        ry.BotOp(scene, False).follow(plan)
