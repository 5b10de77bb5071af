"""Methods by the names that scripts of earlier years use."""

from __future__ import annotations

import importlib
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import kinegraph as ry
from kinegraph.compatibility.methods import METHODS

SCENE = """world: {} a(world): {joint: hingeX, mass: 1, arm} hand(a): {joint: transX, pre: [0 0 1], shape: sphere, size: [.1]}
table: {X: [0 0 .5]} cup(table): {Q: [0 0 .1], shape: sphere, size: [.05], mass: 1}"""


@pytest.fixture
def C(tmp_path: Path) -> ry.Config:
    (tmp_path / "scene.g").write_text(SCENE)
    config = ry.Config()
    config.addFile(tmp_path / "scene.g")
    return config


def assertSame(ours: Any, theirs: Any) -> None:
    """Dicts and lists of the same numbers, arrays and texts, in the same order."""
    assert type(ours) is type(theirs)
    if isinstance(ours, dict):
        assert list(ours) == list(theirs)
        for key in ours:
            assertSame(ours[key], theirs[key])
    elif isinstance(ours, (list, tuple)):
        assert len(ours) == len(theirs)
        for one, other in zip(ours, theirs, strict=True):
            assertSame(one, other)
    elif isinstance(ours, np.ndarray):
        assert ours.dtype == theirs.dtype
        np.testing.assert_array_equal(ours, theirs)
    else:
        assert ours == theirs


def test_dynamics(C: ry.Config) -> None:
    velocity = np.array([0.1, 0.2])
    for ours, theirs in zip(C.equationOfMotion(velocity), C.dyn_MF(velocity), strict=True):
        np.testing.assert_array_equal(ours, theirs)
    np.testing.assert_allclose(C.equationOfMotion(velocity, gravity=False)[1], C.dyn_MF(velocity)[1] - C.dyn_F0())
    q = C.getJointState()
    C.selectJoints(["a"])
    after = C.stepDynamics([0.5], [0.0], 0.1, gravity=False)
    np.testing.assert_allclose(C.getJointState(), [q[0] + 0.05], atol=1e-9)
    np.testing.assert_allclose(after, [0.5], atol=1e-9)


def test_selection_and_free_objects(C: ry.Config) -> None:
    C.selectJointsByTag(["arm"])
    assert C.getJointNames() == ["a"]
    where = C["cup"].getPose()
    C.makeObjectsFree(["cup"])
    assert C["table"].getJointType() == ry.JT.free
    np.testing.assert_allclose(C["cup"].getPose(), where)
    C.sortFrames()
    assert next(iter(C.getFrames())).name == "world"


def test_attributes(C: ry.Config) -> None:
    assert C["cup"].addAttribute("full", True).setAttribute("volume", 0.2).getAttributes()["volume"] == 0.2
    assert C["cup"].addAttributes({"handle": "left"}).getAttributes()["handle"] == "left"
    assert C["cup"].info() == C["cup"].asDict()


def test_frames_and_features(C: ry.Config) -> None:
    assert C.frame("cup") == C.frame(C["cup"].ID) == C["cup"] and C.frames() == C.getFrames()
    assert C.getDofIDs() == C.getJointIDs() == [C["a"].ID, C["hand"].ID]
    for ours, theirs in zip(C.eval(ry.FS.position, ["hand"]), C.evalFeature(ry.FS.position, ["hand"]), strict=True):
        np.testing.assert_array_equal(ours, theirs)
    with pytest.raises(ry.FrameNotFound, match="similar names: cup"):
        C.frame("cupp")


def test_a_scene_has_no_slices_and_no_forces(C: ry.Config) -> None:
    with pytest.raises(ry.ArgumentError, match="KOMO.initWithPath"):
        C.setJointStateSlice(C.getJointState(), 0)
    pairs, forces = C.getForceArrays()
    assert pairs.shape == (0, 2) and forces.shape == (0, 3, 3)


def test_the_view(C: ry.Config) -> None:
    assert C.get_viewer() is C.viewer()
    C.view_recopyMeshes()
    C.view_raise()


def test_pictures(C: ry.Config, tmp_path: Path) -> None:
    assert C.view_fxycxy().shape == (4,) and C.view_pose().shape == (7,) and C.view_focalLength() > 0
    before = C.view_pose()
    C.view_focus("cup", 0.5)
    assert not np.allclose(before, C.view_pose())
    try:
        rgb, depth = C.view_getRgb(), C.view_getDepth()
    except ry.FileError as error:
        pytest.skip(str(error))
    assert rgb.shape == (*depth.shape, 3)
    assert Path(C.view_savePng(f"{tmp_path}/pictures/")).exists()


def test_what_collides(C: ry.Config) -> None:
    assert C.getCollisionFree() and C.getTotalPenetration() == 0.0
    C["cup"].setContact(1)
    C.addObject(
        "block", "hand", ry.ST.ssBox, [0.1, 0.1, 0.1], radius=0.01, pos=[0.0, 0.0, -0.4], color=[1, 0, 0]
    ).setContact(1)
    assert C["block"].getType() == ry.ST.ssBox and list(C["block"].getSize()) == [0.1, 0.1, 0.1, 0.01]
    assert not C.getCollisionFree() and C.getTotalPenetration() == pytest.approx(C.coll_totalViolation())
    assert C.getTotalPenetration() == C.getCollisionsTotalPenetration() > 0.0
    C.computeCollisions()


def test_the_camera_of_the_view_takes_a_frame_a_pose_or_two_points(C: ry.Config) -> None:
    C.view_setCamera([3.0, 0.0, 1.0], [0.0, 0.0, 1.0])
    pose = C.view_pose()
    np.testing.assert_allclose(pose[:3], [3.0, 0.0, 1.0], atol=1e-6)
    C.view_setCamera("cup")
    assert not np.allclose(C.view_pose(), pose)
    C.view_setCamera(pose)
    np.testing.assert_allclose(C.view_pose(), pose, atol=1e-6)
    with pytest.raises(ry.ArgumentError, match="expected a frame or its name, a pose of 7 numbers"):
        C.view_setCamera([1.0, 2.0])


def test_frames_of_a_motion_and_what_it_consists_of(C: ry.Config, capsys: pytest.CaptureFixture[str]) -> None:
    komo = ry.KOMO(C, 1, 2, 1, False)
    by_name = komo.addStableFrame("grasp", "hand", ry.JT.free, True, "cup")
    by_frame = komo.addStableFrame("other", "hand", ry.JT.free, True, C["cup"])
    for frame in (by_name, by_frame):
        np.testing.assert_allclose(frame.getPosition(), C["cup"].getPosition(), atol=1e-9)
    komo.addControlObjective([], 1)
    komo.reportProblem()
    assert komo.info_objectiveNames()[0] in capsys.readouterr().out
    skeleton = ry.Skeleton()
    skeleton.enableAccumulatedCollisions(True)


@pytest.mark.parametrize(("order", "make"), [(1, ry.Config.komo_IK), (2, lambda C: C.komo_path(2.0, 5, 1.0))])
def test_motions_from_a_scene(C: ry.Config, order: int, make) -> None:
    komo = make(C)
    slices = komo.getT()
    assert slices == (1 if order == 1 else 10)
    again = ry.KOMO()
    again.setModel(C, False)
    again.setTiming(*((1, 1, 1.0) if order == 1 else (2, 5, 1.0)), order)
    again.add_qControlObjective(order=order, scale=0.1)
    again.addQuaternionNorms()
    x = np.random.default_rng(0).normal(size=komo.nlp().getDimension())
    for ours, theirs in zip(komo.nlp().evaluate(x), again.nlp().evaluate(x), strict=True):
        np.testing.assert_array_equal(ours, theirs)
    np.testing.assert_array_equal(komo.getPath_qOrg(), komo.getPath())
    told, report = komo.getReport(), komo.report()
    assert len(report) > 1 and told is not report
    assertSame(told, report)
    assert komo.nlp().getFeatureTypes() == komo.nlp().getTypes()


def test_a_problem_by_its_earlier_names() -> None:
    problem = ry.NLP_Factory()
    problem.setDimension(2)
    problem.setFeatureTypes([ry.OT.sos, ry.OT.sos])
    problem.setEvalCallback(lambda x: (x - 1.0, np.eye(2)))
    assert problem.getFeatureTypes() == [ry.OT.sos, ry.OT.sos]
    assert ry.OptMethod.AugmentedLag == ry.OptMethod.augmentedLag
    assert ry.NLP_SolverID is ry.OptMethod and ry.PathFinder is ry.RRT_PathFinder


def test_traces_by_their_earlier_names(C: ry.Config) -> None:
    komo = ry.KOMO(C, 1, 1, 0, False)
    komo.addObjective([], ry.FS.jointState, [], ry.OT.sos, target=[0.1, 0.2])
    solver = ry.NLP_Solver(komo.nlp(), verbose=0).setTracing()
    solver.solve()
    np.testing.assert_array_equal(solver.getLog_x(), solver.getTrace_x())
    np.testing.assert_array_equal(solver.getLog_costs(), solver.getTrace_errs())
    np.testing.assert_array_equal(solver.getTrace_costs(), solver.getTrace_errs())
    assert len(solver.getLog_x()) > 0


LAUNCHES: dict[str, Callable[[ry.BotOp], None]] = {
    "launch_simulation": lambda bot: bot.launch_simulation(),
    "launch_robots": lambda bot: bot.launch_robots("left", True),
    "launch_franka": lambda bot: bot.launch_franka("left"),
    "launch_trossen": lambda bot: bot.launch_trossen("left"),
    "launch_baslers": lambda bot: bot.launch_baslers(["camera"]),
    "launch_arucos": lambda bot: bot.launch_arucos(["camera"]),
    "launch_arucoObjTracker": lambda bot: bot.launch_arucoObjTracker(["camera"]),
}


@pytest.mark.parametrize("name", LAUNCHES)
def test_drivers_of_hardware_are_given_and_not_launched(panda: ry.Config, name: str) -> None:
    with pytest.raises(ry.NotFound) as refused:
        LAUNCHES[name](ry.BotOp(panda))
    said = "pass a driver of the hardware to BotOp(C, True, driver=...); see kinegraph.robots"
    assert str(refused.value) == f"BotOp.{name}: {said}"
    robots = importlib.import_module("kinegraph.robots")
    assert robots.__doc__ and "driver=" in robots.__doc__  # what is said to be there is there


def test_cameras_of_a_robot(panda: ry.Config) -> None:
    bot = ry.BotOp(panda)
    bot.launch_camera("cameraTop")
    np.testing.assert_array_equal(bot.getCameraFxypxy("cameraTop"), bot.getCameraFxycxy("cameraTop"))
    with pytest.raises(ry.FrameNotFound, match="'cameraTpo'.*similar names: .*cameraTop"):
        bot.launch_camera("cameraTpo")
    view = ry.CameraView(panda)
    view.setCamera("cameraTop")
    np.testing.assert_array_equal(view.getFxyCxy(), view.getFxycxy())
    assert view.getFxyCxy().shape == (4,) and (view.getFxyCxy() > 0).all()


def test_a_row_per_period(panda: ry.Config, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    bot = ry.BotOp(panda)
    bot.setControllerWriteData(1)
    bot.sync(panda, 0.1)
    bot.setControllerWriteData(0)
    rows = len(Path("z.control.dat").read_text().splitlines())
    bot.sync(panda, 0.1)
    assert rows > 10 and len(Path("z.control.dat").read_text().splitlines()) == rows


def test_every_earlier_method_is_called_by_a_test() -> None:
    """Those of BotOp in test_bot_op.py and test_bot_notebooks.py, of cameras in test_cameras.py, all others here."""
    texts = "".join(file.read_text() for file in Path(__file__).parent.parent.rglob("test_*.py"))
    methods = {method.__name__ for owner in METHODS for method in METHODS[owner]}
    assert {name for name in methods if not re.search(rf"\.{name}\(", texts)} == set()
