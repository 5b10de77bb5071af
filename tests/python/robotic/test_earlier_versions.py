"""Scripts written for robotic 0.0.27 to 0.2.9, and for libry: what they call works as there."""

from __future__ import annotations

import copy
import json
import logging
import sys
from pathlib import Path

import numpy as np
import pytest

import kinegraph
import robotic as ry


def arm() -> ry.Config:
    C = ry.Config()
    C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
    return C


def simulation(C: ry.Config) -> ry.Simulation:
    return ry.Simulation(C, ry.SimulationEngine.physx, verbose=0)


def test_limits_in_pairs_are_read_with_a_warning(tmp_path: Path) -> None:
    C = ry.Config()
    C.addFrame("w")
    with pytest.warns(ry.KinegraphWarning, match=r"each dof in turn; .*: \[-1 -1 -3 1 1 3\]"):
        C.addFrame("e", "w").setJoint(ry.JT.transXYPhi, [-1.0, 1.0, -1.0, 1.0, -3.0, 3.0])
    assert np.array_equal(C.getJointLimits(), [[-1, -1, -3], [1, 1, 3]])
    file = tmp_path / "a.g"
    file.write_text("world: {}\nb (world): { joint: transXYPhi, limits: [-4, 4, -5, 5, -3, 3] }\n")
    C = ry.Config()
    with pytest.warns(ry.KinegraphWarning, match=r"a.g:2:\d+: .*each dof in turn"):
        C.addFile(file)
    assert np.array_equal(C.getJointLimits(), [[-4, -5, -3], [4, 5, 3]])
    with pytest.raises(ry.ArgumentError, match="a lower limit is above its upper limit"):
        C.getFrame("b").setJoint(ry.JT.transXYPhi, [1.0, -1.0, -1.0, 1.0, -3.0, 3.0])


def test_a_simulated_robot_keeps_the_time_it_is_told() -> None:
    C = arm()
    bot = ry.BotOp(C, False)
    q = bot.get_qHome()
    q[0] += 1.5
    with pytest.warns(ry.KinegraphWarning, match="its limits are not kept from now on"):
        bot.move([q], [0.3])
    assert bot.getTimeToEnd() == pytest.approx(0.3)
    with pytest.raises(kinegraph.ArgumentError, match="velocity"):
        kinegraph.BotOp(arm(), False).move([q], [0.3])


def test_an_obstacle_does_not_stop_a_simulated_robot() -> None:
    C = arm()
    bot = ry.BotOp(C, False)
    q = bot.get_qHome()
    q[1] += 1.2  # into the table
    bot.moveTo(q)
    with pytest.warns(ry.KinegraphWarning, match="is .* from its command; does an obstacle block it"):
        while bot.getTimeToEnd() > 0:
            bot.sync(C, 0.1)
    bot.home(C)
    assert bot.getFault() == "" and np.allclose(bot.get_q(), bot.get_qHome(), atol=0.02)


def test_a_negative_time_does_not_wait() -> None:
    C = arm()
    bot = ry.BotOp(C, False)
    time = bot.get_t()
    bot.sync(C, -1.0)
    assert bot.get_t() <= time + 0.011  # a query at the same time is one period


def test_a_frame_of_an_unknown_parent_has_none(tmp_path: Path) -> None:
    C = ry.Config()
    with pytest.warns(ry.KinegraphWarning, match="'pcl' has no parent"):
        assert C.addFrame("pcl", "cameraBase").getParent() is None
    file = tmp_path / "a.g"
    file.write_text("cam (world): { pose: [0, 0, 2, 0, -1, 0, 0] }\n")
    with pytest.warns(ry.KinegraphWarning, match="a.g:1:1: parent of 'cam': 'world' is not a frame"):
        C.addFile(file)
    assert C.getFrameNames() == ["pcl", "cam"] and C.getFrame("cam").getPosition()[2] == 2.0
    with pytest.raises(kinegraph.ParseError, match="'world' is not a frame of this scene"):
        kinegraph.Config().addFile(file)


def test_the_state_of_a_simulation_unpacks_and_is_set_again() -> None:
    C = arm()
    C.addFrame("box").setPosition([1.0, 0.0, 2.0]).setShape(ry.ST.ssBox, [0.1, 0.1, 0.1, 0.01]).setMass(0.2)
    S = simulation(C)
    for _ in range(10):
        S.step([], 0.01, ry.ControlMode.none)
    state = S.getState()
    X, q, V, qDot = state
    assert X.shape == (C.getFrameDimension(), 7) and V.shape == (len(X), 2, 3) and q.shape == qDot.shape == (7,)
    assert np.array_equal(state[0], X) and len(state) == 4
    box = C.getFrame("box").ID
    assert V[box, 0, 2] < -0.5  # it falls
    for _ in range(10):
        S.step([], 0.01, ry.ControlMode.none)
    fallen = C.getFrameState()[box]
    S.setState(*state)
    assert np.allclose(C.getFrameState(), X, atol=1e-9) and S.getState()[2][box, 0, 2] == pytest.approx(V[box, 0, 2])
    S.setState(state)
    for _ in range(10):
        S.step([], 0.01, ry.ControlMode.none)
    assert np.array_equal(C.getFrameState()[box], fallen)  # the whole state, to the bit


def test_grippers_and_cameras_of_a_simulation() -> None:
    S = simulation(arm())
    S.openGripper("l_gripper")
    for _ in range(50):
        S.step([], 0.01, ry.ControlMode.none)
    assert S.getGripperWidth("l_gripper") == pytest.approx(0.075, abs=1e-3)
    assert not S.getGripperIsGrasping("l_gripper")
    S.closeGripper("l_gripper")
    for _ in range(100):
        S.step([], 0.01, ry.ControlMode.none)
    assert not S.getGripperIsGrasping("l_gripper")  # on nothing
    S.selectSensor("cameraWrist")
    assert S.getImageAndDepth()[0].shape == (360, 640, 3)
    with pytest.raises(ry.NotFound):
        S.selectSensor("nowhere")
    S.pushConfigurationToSimulator()


class ByMethods(ry.nlp.NLP):
    """A problem of earlier years: methods instead of attributes."""

    def getDimension(self) -> int:
        return 2

    def getFeatureTypes(self) -> list[ry.OT]:
        return [ry.OT.sos] * 2

    def getBounds(self) -> np.ndarray:
        return np.array([[-2.0, -2.0], [2.0, 2.0]])

    def evaluate(self, x: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        return x - [1.0, 0.5], np.eye(2)


def test_problems_of_methods_are_solved_and_traced() -> None:
    solver = ry.NLP_Solver()
    solver.setPyProblem(ByMethods())
    solver.setOptions(verbose=0)
    result = solver.solve()
    assert np.allclose(result.x, [1.0, 0.5], atol=1e-3)
    assert len(solver.getTrace_x()) == len(solver.getTrace_costs()) == result.evals > 0


def test_reports_are_json_and_objectives_need_no_frames() -> None:
    komo = ry.KOMO(arm(), 1, 2, 2, False)
    komo.addObjective(times=[1.0], feature=ry.FS.qItself, type=ry.OT.eq, scale=[1e1], order=1)
    assert json.loads(json.dumps(komo.report()))["o0"]["scale"] == [10.0]
    assert komo.addStableFrame(ry.JT.hingeZ, "table", "pivot", "l_gripper").name == "pivot"


def test_names_of_earlier_versions(tmp_path: Path) -> None:
    C = arm()
    frames = C.getFrameDimension()
    C.simplify(False, True, True)
    assert C.getFrameDimension() < frames and C.getJointDimension() == 7
    C.view_setCamera(None)
    box = C.addObject("item", "table", ry.ST.ssBox, [0.1, 0.1, 0.25, 0.02], [1.0, 1.0, 0.0], [0.1, 0.1, 0.52])
    assert np.allclose(box.getRelativePosition(), [0.1, 0.1, 0.52])
    solid = C.addFrame("solid").setShape(ry.ST.box, [0.1, 0.2, 0.3]).setDensity(500.0)
    assert (
        solid.getMass() == pytest.approx(3.0)
        if hasattr(solid, "getMass")
        else solid.getInertia()[0] == pytest.approx(3.0)
    )
    assert np.array_equal(ry.Quaternion().getArr(), [1, 0, 0, 0])
    mesh = tmp_path / "t.tri"
    mesh.write_text("TRI\n4\n4\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n0 2 1\n0 1 3\n0 3 2\n1 2 3\n")
    assert C.addFrame("mesh").setMeshFile(mesh).getMeshPoints().shape == (4, 3)
    mesh.write_text("TRI\n4\n1\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n0 2 7\n")
    with pytest.raises(ry.FileError, match="triangle 0 refers to vertex 7 of 4"):
        C.addFrame("other").setMeshFile(mesh)


def test_a_manipulation_helper_of_2024_knows_its_scene() -> None:
    C = arm()
    box = C.addFrame("box", "table").setJoint(ry.JT.rigid).setShape(ry.ST.ssBox, [0.06, 0.06, 0.06, 0.005])
    box.setRelativePosition([-0.25, 0.1, 0.1]).setContact(1)
    M = ry.ManipulationModelling(C, "carry", ["l_gripper"])
    M.setup_pick_and_place_waypoints("l_gripper", "box", homing_scale=1e-1, joint_limits=False)
    M.grasp_top_box(1.0, "l_gripper", "box", "xz")
    M.place_box(2.0, "box", "table", "l_palm", "z", on_table=True)
    M.solve(verbose=0)
    assert M.feasible and M.info == "carry"
    with pytest.raises(ry.ArgumentError, match="on_table is False; expected True"):
        M.place_box(2.0, "box", "table", "l_palm", on_table=False)
    move = ry.ManipulationModelling(C, info="move")
    move.setup_point_to_point_motion(M.path[0])
    before = len(move.komo.getFeatureNames())
    move.no_collision([0.3, 0.7], ["l_palm", "box"])
    move.keep_distance([0.3, 0.7], ["l_palm", "table"], 0.02)
    assert len(move.komo.getFeatureNames()) > before
    by_pairs = move.komo.getFeatureNames()[before:]
    move.no_collision([0.3, 0.7], "l_palm", "box")
    move.keep_distance([0.3, 0.7], "l_palm", "table", margin=0.02)
    assert move.komo.getFeatureNames()[before:] == 2 * by_pairs
    move.keep_distances([0.3, 0.7], ["l_palm", "table", "box"], 0.0)
    assert len(move.komo.getFeatureNames()) == before + 2 * len(by_pairs) + 3 * len(by_pairs) // 2
    move.no_collision([], pairs=["l_palm", "box"])
    for wrong in (
        lambda: move.no_collision([], ["l_palm", "box"], 0.01, 0.02),
        lambda: move.no_collision([], "l_palm", "box", 0.01, margin=0.5),
        lambda: move.no_collision([], "l_palm"),
    ):
        with pytest.raises(ry.ArgumentError, match="a list of names in pairs or two names, and optionally one margin"):
            wrong()
    with pytest.raises(ry.ArgumentError, match="expected a list of at least two names"):
        move.keep_distances([], ["box"])
    move.solve(verbose=0)
    move.play(0.0)
    assert np.allclose(C.getJointState(), M.path[0], atol=1e-2)


def test_poses_of_some_frames() -> None:
    C = arm()
    assert np.array_equal(C.getFrameState("table"), C.getFrame("table").getPose())
    assert np.array_equal(C.getFrameState(["table", "l_gripper"])[1], C.getFrame("l_gripper").getPose())
    with pytest.raises(ry.FrameNotFound, match="similar names: table"):
        C.getFrameState("tabel")


def test_helper_modules_cover_what_kinegraph_has(tmp_path: Path) -> None:
    from robotic.src.h5_helper import H5Reader, H5Writer

    from robotic.src import mesh_tool, mujoco_io, urdf_io, yaml_helper
    from robotic.tools import h5_helper

    assert {H5Reader.__name__, H5Writer.__name__} <= set(dir(h5_helper))
    file = tmp_path / "a.urdf"
    file.write_text('<robot name="a"><link name="base"/></robot>')
    assert "base" in urdf_io.URDFLoader(str(file)).C.getFrameNames()
    C = ry.Config()
    C.addFrame("ball").setShape(ry.ST.sphere, [0.1]).setMass(1.0)
    xml = tmp_path / "b.xml"
    xml.write_text(mujoco_io.MujocoWriter(C).str())
    assert "ball" in mujoco_io.MujocoLoader(str(xml), basePos=[0.0, 0.0, 1.0]).C.getFrameNames()
    M = ry.MujocoLoader(str(xml), visualsOnly=True, processMeshes=True)
    M.base.setPosition([1.0, 0.0, 0.0])
    assert M.C.getFrame("ball").getPosition()[0] == pytest.approx(1.0)
    mesh = tmp_path / "t.tri"
    mesh.write_text("TRI\n3\n1\n0 0 0\n1 0 0\n0 1 0\n0 1 2\n")
    assert mesh_tool.MeshTool(str(mesh)).points.shape == (3, 3)
    assert yaml_helper.dict_as_yaml({"a": [1, 2]}) == '"a": [1, 2]\n'
    assert yaml_helper.dict_as_yaml({"a": np.arange(2), "b": np.float64(0.5)}) == '"a": [0, 1]\n"b": 0.5\n'
    with pytest.raises(ry.NotFound, match="trimesh"):
        mesh_tool.MeshTool(str(mesh)).repair()


def test_libry_is_robotic() -> None:
    import libry

    assert libry is sys.modules["robotic"]


def test_a_viewer_is_made_before_the_scene_it_shows_and_a_scene_makes_its_simulation() -> None:
    V = ry.ConfigurationViewer()
    empty = V.getRgb()
    C = arm()
    assert V.setConfiguration(C) == 0 and C.viewer() is V
    assert not np.array_equal(V.getRgb(), empty)
    V.recopyMeshes(C)
    assert V.updateConfiguration(C) == 0
    S = C.simulation(ry.SimulatorEngine.physx, 0)
    assert isinstance(S, ry.Simulation)
    q = S.get_q()
    S.step(q, 0.01, ry.ControlMode.position)
    assert np.allclose(S.get_q(), q, atol=1e-3)


def test_scenes_of_slices_are_poses_of_a_scene() -> None:
    C = arm()
    C.addFrame("box", "table").setJoint(ry.JT.rigid).setShape(ry.ST.ssBox, [0.1, 0.1, 0.1, 0.01])
    C.getFrame("box").setRelativePosition([0.3, 0.3, 0.1])
    komo = ry.KOMO(C, 2, 5, 2, False)
    komo.addControlObjective([], 2, 1.0)
    komo.addModeSwitch([1, 2], ry.SY.stable, ["l_gripper", "box"])
    komo.addObjective([1], ry.FS.positionDiff, ["l_gripper", "box"], ry.OT.eq, [1e1])
    komo.addObjective([2], ry.FS.position, ["box"], ry.OT.eq, [1e1], [0, 0.3, 1.0])
    komo.optimize()
    C.setFrameState(komo.getConfiguration(9))
    assert np.allclose(C.getFrame("box").getPosition(), [0, 0.3, 1.0], atol=1e-3)
    assert np.allclose(C.getJointState(), komo.getPath()[9], atol=1e-9)
    before = C.getFrameState()
    C.setFrameState(before[:1] + np.array([0, 0, 1, 0, 0, 0, 0]), ["world"])
    assert C.getFrame("world").getPosition()[2] == pytest.approx(before[0, 2] + 1)
    with pytest.raises(ry.ArgumentError, match="one pose x y z qw qx qy qz per frame"):
        C.setFrameState(arm())  # it lacks the box


def test_mujoco_takes_the_place_of_bullet() -> None:
    C = arm()
    ball = C.addFrame("ball").setShape(ry.ST.sphere, [0.05]).setPosition([2, 0, 1]).setMass(0.1)
    for make in (
        lambda: ry.Simulation(C, ry.SimulatorEngine.bullet, 0),
        lambda: C.simulation(ry.SimulatorEngine.bullet, 0),
    ):
        with pytest.warns(ry.KinegraphWarning, match="there is no engine bullet; physx"):
            S = make()
    for _ in range(20):
        S.step([], 0.01, ry.ControlMode.none)
    assert ball.getPosition()[2] < 0.9
    with pytest.raises(kinegraph.ArgumentError, match="there is no engine bullet"):
        kinegraph.Simulation(C, kinegraph.SimulationEngine.bullet)


@pytest.mark.parametrize("name", ["CtrlSet", "CtrlSolver", "ImpType"])
def test_what_only_libry_had_says_what_to_call(name: str) -> None:
    with pytest.raises(ry.NotFound, match=f"robotic.{name}.*; (DiffIk|Simulation.applyForce)"):
        getattr(ry, name)()


def test_messages_are_silenced_and_heard_again(capsys: pytest.CaptureFixture[str]) -> None:
    komo = ry.KOMO(arm(), 1, 1, 0, False)
    try:
        ry.setLogLevel(-1)
        ry.NLP_Solver(komo.nlp(), verbose=1).solve()
        assert capsys.readouterr().out == ""
    finally:
        ry.setLogLevel(0)
    if not logging.getLogger("kinegraph").hasHandlers():  # a runner of tests may have its own
        ry.NLP_Solver(komo.nlp(), verbose=1).solve()
        assert "==nlp==" in capsys.readouterr().out
    assert logging.getLogger("kinegraph").propagate


def test_a_derived_scene_is_copied_whatever_its_constructor_takes() -> None:
    class Lab(ry.Config):
        def __init__(self, box: str) -> None:
            super().__init__()
            self.addFrame(box)
            self.box = box

    for lab in (Lab("box").copy(), copy.deepcopy(Lab("box"))):
        assert lab.getFrameNames() == ["box"] and lab.box == "box"
