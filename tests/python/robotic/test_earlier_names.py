"""Every public name of robotic 0.1.10, 0.2.3 and 0.2.9 works, or says what to call instead; also those that 0.4.2 has
no more, and those with other arguments there."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import kinegraph
import robotic as ry
from conftest import recorded
from robotic.earlier_words import WORDS
from test_reference_api import SAYS_WHAT_INSTEAD, fits, own_signatures, resolved

VERSIONS = recorded("reference_api_earlier")["names"]
ENTRIES = [(version, name) for version, names in VERSIONS.items() for name in names]

IN_ANOTHER_WAY = {
    "CameraView.computeImageAndDepth": "0.4.2 has another second argument; visualsOnly works by name",
    "KOMO.view_play": "a number in second place is the delay, see below",
    "Simulation.addSensor": "a number in second place is the width, see below",
    "KOMO.addStableFrame": "a text is the name of a frame wherever it stands, see below",
    "Frame.setDensity": "grids are refused, see below",
    "SY.break": "break is a word of Python, so that no script can have it",
    "break": "break is a word of Python, so that no script can have it",
}


def words_of(name: str) -> dict[str, str]:
    owner, _, call = name.replace("PathFinder", "RRT_PathFinder").rpartition(".")
    return WORDS.get((getattr(ry, owner), call), {}) if owner in vars(ry) else {}


@pytest.mark.parametrize(("version", "name"), ENTRIES)
def test_a_name_of_an_earlier_version_works_or_says_what_to_call(version: str, name: str) -> None:
    recording = VERSIONS[version][name]
    if name in IN_ANOTHER_WAY:
        return
    if isinstance(recording, str):  # exported by an enum
        assert resolved(name) is getattr(getattr(ry, recording), name)
        return
    try:
        value = resolved(name)
    except AttributeError as error:
        assert SAYS_WHAT_INSTEAD.search(str(error)), f"{name}: {error}"
        return
    for theirs in recording or []:
        named = [words_of(name).get(one.rstrip("="), one.rstrip("=")) + "=" * one.endswith("=") for one in theirs]
        assert any(fits(named, ours) for ours in own_signatures(value)), f"{named}, and ours: {own_signatures(value)}"


def test_recorded_versions_are_whole() -> None:
    counts = recorded("reference_api_earlier")["counts"]
    assert counts == {"0.1.10": 620, "0.2.3": 523, "0.2.9": 648}
    assert all(0 < len(VERSIONS[version]) < count for version, count in counts.items())


def arm() -> ry.Config:
    C = ry.Config()
    C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
    return C


def test_arguments_have_their_earlier_names() -> None:
    C = arm()
    assert C.frame(frameName="table", warnIfNotExist=False).name == "table"
    assert C.frame(frameName="no", warnIfNotExist=False) is None
    C.addFrame("extra")
    C.delFrame(frameName="extra")
    assert "extra" not in C.getFrameNames()
    bot = ry.BotOp(C, False)
    bot.gripperMove(leftRight=ry.ArgWord._left, width=0.05)
    bot.wait(C, forKeyPressed=False, forTimeToEnd=False, forGripper=True)
    assert bot.gripperDone(leftRight=ry._left)
    assert bot.getGripperPos(leftRight=ry._left) == pytest.approx(0.05, abs=2e-3)
    with pytest.raises(TypeError):
        bot.gripperMove(side=0)


def test_a_path_finder_takes_starts_goals_and_a_tolerance() -> None:
    C = ry.Config()
    C.addFrame("world")
    C.addFrame("ball", "world").setShape(ry.ST.sphere, [0.1]).setJoint(ry.JT.transXY, limits=[-1, -1, 1, 1]).setContact(
        1
    )
    finder = ry.PathFinder()
    assert finder.setProblem(C, starts=[0, 0], goals=[[0.5, 0.5]], collisionTolerance=1e-3) is finder
    result = finder.solve(0)
    assert result.feasible
    np.testing.assert_allclose(result.x[[0, -1]], [[0, 0], [0.5, 0.5]])
    with pytest.raises(ry.ArgumentError, match="collisionTolerance"):
        finder.setProblem(C, [0, 0], [0.5, 0.5], -1.0)


def test_objects_are_attached_and_detached_alone() -> None:
    C = arm()
    C.addFrame("cube").setShape(ry.ST.ssBox, [0.05, 0.05, 0.05, 0.005]).setPosition([0.3, 0.3, 2.0]).setMass(0.1)
    S = ry.Simulation(C, ry.SimulationEngine.physx, verbose=0)
    S.attach(gripper=C.getFrame("l_gripper"), obj=C.getFrame("cube"))
    height = C.getFrame("cube").getPosition()[2]
    S.step([], 0.05, ry.ControlMode.none)
    S.detach(C.getFrame("cube"))
    with pytest.raises(ry.ArgumentError, match="'cube' is not attached"):
        S.detach(obj="cube")
    for _ in range(20):
        S.step([], 0.01, ry.ControlMode.none)
    assert C.getFrame("cube").getPosition()[2] < height - 0.05


@pytest.mark.parametrize("arguments", [("cam", "", 64, 48), ("cam", 64, 48)])
def test_a_sensor_has_its_size(arguments: tuple[Any, ...]) -> None:
    C = arm()
    C.addFrame("cam").setPosition([0, 0, 2]).setAttributes({"focalLength": 0.9, "width": 640, "height": 360})
    S = ry.Simulation(C, ry.SimulationEngine.physx, verbose=0)
    S.addSensor(*arguments)
    rgb, depth = S.getImageAndDepth()
    assert rgb.shape == (48, 64, 3) and depth.shape == (48, 64)


def test_frames_of_motions_are_added_by_name_or_frame() -> None:
    C = arm()
    komo = ry.KOMO(C, 1.0, 1, 0, False)
    frames: list[Callable[[], Any]] = [
        lambda: komo.addStableFrame("a", "table", ry.JT.free, True, "l_gripper"),
        lambda: komo.addStableFrame("b", "table", ry.JT.free, True, initFrame="l_gripper"),
        lambda: komo.addStableFrame("c", "table", ry.JT.free, True, initFrame=C.getFrame("l_gripper")),
    ]
    for add in frames:
        np.testing.assert_allclose(add().getPosition(), C.getFrame("l_gripper").getPosition(), atol=1e-9)


def test_the_rest_says_what_to_call_instead() -> None:
    C = arm()
    frame = C.getFrame("table")
    with pytest.raises(ry.ArgumentError, match="instead: frame.setImplicitSurface"):
        frame.setDensity(np.zeros((2, 2, 2)), [1, 1, 1])
    with pytest.raises(ry.ArgumentError, match="instead: call it on a copy"):
        frame.computeCompoundInertia(False)
    options = ry.NLP_SolverOptions()
    assert options.set_maxStep(0.3).stepMax == 0.3 and options.set_maxLambda(7.0).lambdaMax == 7.0


def test_values_of_enums_are_no_names_of_kinegraph() -> None:
    assert ry.hingeX is ry.JT.hingeX and ry.none is ry.OT.none and ry.position is ry.ControlMode.position
    assert not hasattr(kinegraph, "hingeX")
    with pytest.raises(AttributeError, match="robotic has no 'hingeW'"):
        _ = ry.hingeW
