"""Contact forces in motion problems: the laws of Newton, Euler and Coulomb, computed on paper."""

import numpy as np
import pytest

import kinegraph as ry

FS, OT, SY, JT = ry.FS, ry.OT, ry.SY, ry.JT
G = 9.81


def box_on_table(mass=2.0, height=0.65) -> ry.Config:
    C = ry.Config()
    C.addFrame("world")
    C.addFrame("table", "world").setPosition([0, 0, 0.5]).setShape(ry.ST.ssBox, [1.0, 1.0, 0.1, 0.01]).setContact(1)
    box = C.addFrame("box", "world").setPosition([0.1, 0.2, height]).setShape(ry.ST.ssBox, [0.2, 0.2, 0.2, 0.01])
    box.setContact(1).setMass(mass)
    return C


def solve(komo):
    result = ry.NLP_Solver(komo.nlp(), verbose=0).solve()
    assert result.feasible, result.message
    return result


@pytest.mark.parametrize("call", ["addContactForceFrame", "addContact_WithPoaFrame"])
def test_a_box_that_rests_is_held_by_its_weight_below_its_center(call):
    C = box_on_table(height=0.66)
    C.getFrame("box").setJoint(JT.free)
    komo = ry.KOMO(C, 1, 1, 0, False)
    distance = [] if call == "addContactForceFrame" else [0.01]
    point = getattr(komo, call)([1.0], "box", "table", 0.7, 1.5, *distance)
    assert point.name == "poa_box_table_1"
    komo.addObjective([], FS.totalForce, ["box"], OT.eq)
    komo.addObjective([], FS.jointState, [], OT.sos, [1e-1], C.getJointState())
    komo.addQuaternionNorms()
    solve(komo)
    (force,) = komo.getForceInteractions()
    assert (force["onto"], force["from"], force["slice"]) == ("box", "table", 0)
    np.testing.assert_allclose(force["force"], [0, 0, 2.0 * G], atol=1e-3)
    np.testing.assert_allclose(force["poa"], [0.1, 0.2, 0.55], atol=1e-4)
    np.testing.assert_allclose(komo.getPath()[0][:3], [0.1, 0.2, 0.65], atol=1e-4)


def test_a_box_on_a_lift_weighs_more_while_it_accelerates():
    acceleration, tau, slices = 3.0, 0.05, 8
    C = box_on_table()
    C.getFrame("table").setJoint(JT.transZ)
    C.getFrame("box").setJoint(JT.free)
    komo = ry.KOMO()
    komo.setTiming(1, slices, tau * slices, 2)
    komo.setConfig(C, False)
    komo.addContactForceFrame([], "box", "table", 0.7, 2.0)
    for t in range(slices):
        time = (t + 1) * tau
        height = C.getFrame("table").getRelativePosition()[2] + 0.5 * acceleration * time**2
        komo.addObjective([(t + 1) / slices], FS.position, ["table"], OT.eq, [[0, 0, 1e1]], [0, 0, height])
    komo.addObjective([2 / slices, 1.0], FS.physics, ["box"], OT.eq)
    komo.addControlObjective([], 2, 1e-2)
    komo.addQuaternionNorms()
    solve(komo)
    forces = [f["force"] for f in komo.getForceInteractions()]
    assert len(forces) == slices
    for force in forces[1:-1]:  # that of the last slice moves nothing any more; the first starts from rest
        np.testing.assert_allclose(force, [0, 0, 2.0 * (G + acceleration)], atol=0.02)


def pushed(mode, slices=6, offset=0.03):
    """A finger pushes a box on a table, next to its center."""
    C = box_on_table()
    C.addFrame("rail", "world").setPosition([-0.055, 0.2 + offset, 0.65])
    C.addFrame("finger", "rail").setShape(ry.ST.sphere, [0.05]).setContact(1).setJoint(JT.transX)
    tau = 0.1
    komo = ry.KOMO()
    komo.setTiming(1, slices, tau * slices, 2)
    komo.setConfig(C, False)
    komo.addModeSwitch([0.0, -1.0], mode, ["table", "box"], False)
    komo.addContactForceFrame([], "box", "finger", 0.5, 2.0)
    komo.addControlObjective([], 2, 1e-1)
    komo.addQuaternionNorms()
    return C, komo, tau


def box_motion(C, komo):
    frame = C.getFrameNames().index("box")
    poses = komo.getPathFrames()[:, frame]
    return poses[:, :3], 2.0 * np.arctan2(poses[:, 6], poses[:, 3])


def test_a_pushed_box_obeys_newton_and_euler():
    C, komo, tau = pushed(SY.dynamicOn)
    komo.addObjective([1.0], FS.position, ["box"], OT.eq, [[1e1, 0, 0]], [0.3, 0, 0])
    solve(komo)
    mass, _, inertia = C.getFrame("box").getInertia()
    position, angle = box_motion(C, komo)
    interactions = komo.getForceInteractions()
    assert position[-1, 0] == pytest.approx(0.3, abs=1e-3)
    assert max(np.linalg.norm(f["force"]) for f in interactions) > 1.0
    for t in range(2, len(position)):
        push = interactions[t - 1]
        acceleration = (position[t] - 2 * position[t - 1] + position[t - 2]) / tau**2
        np.testing.assert_allclose(push["force"][:2], mass * acceleration[:2], atol=0.02)
        torque = np.cross(push["poa"] - position[t - 1], push["force"])[2]
        turning = (angle[t] - 2 * angle[t - 1] + angle[t - 2]) / tau**2
        assert inertia[2, 2] * turning == pytest.approx(torque, abs=5e-3)


def test_a_box_in_quasi_static_motion_rests_where_nothing_pushes_it():
    C, komo, tau = pushed(SY.quasiStaticOn)
    komo.addObjective([0.5, 1.0], FS.qItself, ["finger"], OT.eq, [1e1], [0.02], 0)
    solve(komo)
    position, _ = box_motion(C, komo)
    forces = np.array([f["force"] for f in komo.getForceInteractions()])
    velocity = np.diff(position, axis=0) / tau
    np.testing.assert_allclose(forces[1:, 0], 2.0 * 10.0 * velocity[:, 0], atol=0.05)


@pytest.mark.parametrize(
    "mode", [SY.dynamic, SY.dynamicOn, SY.dynamicTrans, SY.quasiStatic, SY.quasiStaticOn], ids=lambda m: m.name
)
@pytest.mark.parametrize("free", [False, True], ids=["along z", "free"])
def test_jacobians_with_contact_forces(mode, free):
    C = box_on_table()
    C.addFrame("finger", "world").setPosition([-0.06, 0.2, 0.65]).setShape(ry.ST.sphere, [0.05]).setJoint(JT.free)
    komo = ry.KOMO(C, 2, 2, 2, False)
    komo.addModeSwitch([1.0, -1.0], mode, ["table", "box"], True)
    if free:
        komo.addContact_WithPoaFrame([1.0, 2.0], "box", "finger", 0.5, 2.0, 0.01)
    else:
        komo.addContactForceFrame([1.0, 2.0], "box", "finger", 0.5, 2.0)
    komo.addObjective([], FS.totalForce, ["box"], OT.eq)
    komo.addObjective([], FS.contactConstraints, ["box", "finger"], OT.eq)
    nlp = komo.nlp()
    assert len(komo.getForceInteractions()) == 3
    x = np.concatenate(komo.getPath_qAll())
    prefix = nlp.getDimension() - len(x)
    rng = np.random.default_rng(3)
    start = np.concatenate([np.asarray(nlp.getInitializationSample())[:prefix], x])
    assert nlp.checkJacobian(start + 0.02 * rng.standard_normal(len(start)), 1e-4)


def test_totalForce_without_contacts_is_the_weight_and_needs_a_mass():
    C = box_on_table()
    C.getFrame("box").setJoint(JT.free)
    y, J = C.eval(FS.totalForce, ["box"])
    np.testing.assert_allclose(y, [0, 0, 2.0 * G, 0, 0, 0], atol=1e-12)
    assert not J.any()
    np.testing.assert_array_equal(C.eval(FS.contactConstraints, ["box", "table"])[0], np.zeros(3))
    with pytest.raises(ry.Error, match="'table' has no mass"):
        C.eval(FS.totalForce, ["table"])


def test_mistakes_are_named():
    komo = ry.KOMO(box_on_table(), 1, 1, 0, False)
    for arguments, words in [
        (([1.0], "box", "tabel", 0.5, 1.0), "tabel"),
        (([1.0], "box", "box", 0.5, 1.0), "cannot push itself"),
        (([1.0], "box", "table", 0.0, 1.0), "friction"),
        (([1.0], "box", "table", 0.5, -1.0), "mass"),
        (([3.0], "box", "table", 0.5, 1.0), "select no slice"),
    ]:
        with pytest.raises(ry.Error, match=words):
            komo.addContactForceFrame(*arguments)
