"""Scenes for MuJoCo: actuators, hands and free objects, stepped in MuJoCo beside our simulation."""

import itertools
import xml.etree.ElementTree as ET
from pathlib import Path

import mujoco
import numpy as np
import pytest

import kinegraph as ry
from task_scenes import panda_tasks, planned


def test_a_scene_with_motors_has_actuators_a_hand_free_objects_and_a_keyframe(tmp_path: Path) -> None:
    C = panda_tasks.tower(1, 2).C
    C.writeMJCF(str(tmp_path / "tower.xml"), motors=True)
    m = mujoco.MjModel.from_xml_path(str(tmp_path / "tower.xml"))
    names = C.getJointNames()
    assert [m.actuator(i).name for i in range(m.nu)] == [*names, "l_panda_finger_joint1"]
    np.testing.assert_array_equal(m.actuator_forcerange[:7, 1], [87, 87, 87, 87, 12, 12, 12])
    np.testing.assert_allclose(m.actuator_ctrlrange[:7].T, C.getJointLimits())
    mass = np.diag(C.equationOfMotion(np.zeros(7))[0]) + 0.1  # the armature of motors
    np.testing.assert_allclose(m.actuator_gainprm[:7, 0], 1e4 * mass, rtol=1e-9)
    np.testing.assert_allclose(-m.actuator_biasprm[:7, 2], 200 * mass, rtol=1e-9)
    d = mujoco.MjData(m)
    mujoco.mj_resetDataKeyframe(m, d, m.key("now").id)
    mujoco.mj_forward(m, d)
    for frame in ("b0", "b1", "l_panda_joint7"):
        np.testing.assert_allclose(d.body(frame).xpos, C.getFrame(frame).getPosition(), atol=1e-9)
    assert [int(m.joint(f).type[0]) for f in ("b0", "b1")] == 2 * [int(mujoco.mjtJoint.mjJNT_FREE)]
    start = d.qpos.copy()
    mujoco.mj_step(m, d, 500)
    np.testing.assert_allclose(d.qpos, start, atol=2e-3)  # all stays where it is: gravity is compensated
    assert m.ncam == len([f for f in C.getFrames() if f.getShapeType() == ry.ST.camera])


def test_without_motors_nothing_of_this_is_written() -> None:
    C = panda_tasks.tower(1, 2).C
    with pytest.warns(ry.KinegraphWarning) as told:
        m = mujoco.MjModel.from_xml_string(C.asMJCF())
    assert m.nu == 0 and m.nq == 7
    assert any("'l_panda_finger_joint1' is not in q" in str(warning.message) for warning in told)


@pytest.mark.filterwarnings("ignore")
def test_a_pick_in_mujoco_is_that_of_the_simulation() -> None:
    C, plan = planned(panda_tasks.tower(1, 2))
    m = mujoco.MjModel.from_xml_string(C.asMJCF(motors=True))
    bot, states = ry.BotOp(C), []

    def look(_: float) -> None:
        o = bot.stepObservation()
        states.append(
            (o.qref, o.qvel_ref, o.qpos, bot.getGripperTarget(0), bot.getWorld().getFrame("b0").getPosition())
        )

    bot.watch(0, look)
    assert plan.execute(bot).feasible
    d = mujoco.MjData(m)
    mujoco.mj_resetDataKeyframe(m, d, 0)
    mujoco.mj_forward(m, d)
    q = [m.joint(name).qposadr[0] for name in C.getJointNames()]
    delay = -m.actuator_biasprm[:7, 2] / m.actuator_gainprm[:7, 0]
    joints, cube, heights = [], [], []
    for now, then in itertools.pairwise(states):
        joints.append(np.abs(d.qpos[q] - now[2]).max())
        cube.append(np.linalg.norm(d.body("b0").xpos - now[4]))
        heights.append(d.body("b0").xpos[2])
        d.ctrl[7] += np.clip(then[3] / 2 - d.ctrl[7], -5e-4, 1e-3)  # at the speed of the hand
        d.ctrl[:7] = then[0] + delay * then[1]
        mujoco.mj_step(m, d, 5)
    assert max(heights) > 0.77  # it was lifted
    assert max(joints) < 0.02 and joints[-1] < 1e-3
    assert max(cube) < 0.015
    np.testing.assert_allclose(d.body("b0").xpos, states[-1][4], atol=0.01)


def test_the_fingers_of_a_urdf_file_move(tmp_path: Path) -> None:
    C = ry.Config()
    C.addFile(ry.raiPath("panda/panda.g"))
    with pytest.warns(ry.KinegraphWarning):
        C.writeURDF(str(tmp_path / "panda.urdf"))
    joints = {joint.get("name"): joint for joint in ET.parse(tmp_path / "panda.urdf").getroot().iter("joint")}
    first, second = joints["panda_finger_joint1"], joints["panda_finger_joint2"]
    assert first.get("type") == second.get("type") == "prismatic"
    assert second.find("mimic").attrib == {"joint": "panda_finger_joint1", "multiplier": "1", "offset": "0"}
    assert float(first.find("limit").get("upper")) == 0.04
    again = ry.Config()
    again.addFile(str(tmp_path / "panda.urdf"))
    assert again.getJointNames()[:8] == [*C.getJointNames(), "panda_finger_joint1"]
    again.setJointState(np.r_[C.getJointState(), 0.04][: again.getJointDimension()])
    C.setJointState([0.04], ["panda_finger_joint1"])
    for name in ("panda_finger_joint1", "panda_finger_joint2"):
        link = again.getFrame(name)
        np.testing.assert_allclose(link.getPosition(), C.getFrame(name).getPosition(), atol=1e-9)
