"""How solutions move: derivatives by the implicit function theorem equal differences of solutions, and one-sided ones
are reported."""

import pickle

import numpy as np
import pytest

import kinegraph as ry

STEP = 1e-5
TOLERANCE = 1e-5  # relative to the largest entry


def panda():
    C = ry.Config()
    C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
    C.addFrame("box").setShape(ry.ST.sphere, [0.15]).setPosition([0.2, 0.3, 0.9]).setContact(1)
    C.addFrame("goal").setPosition([0.35, 0.35, 0.95])
    return C


def quaternionOf(r):
    """Returns the quaternion of a rotation vector."""
    angle = np.linalg.norm(r)
    return np.array([1.0, 0, 0, 0]) if angle == 0 else np.array([np.cos(angle / 2), *(np.sin(angle / 2) / angle * r)])


def product(a, b):
    return np.array([a[0] * b[0] - a[1:] @ b[1:], *(a[0] * b[1:] + b[0] * a[1:] + np.cross(a[1:], b[1:]))])


def moved(pose, by):
    """A pose moved by position and rotation vector, as `sensitivity` counts them."""
    pose = np.array(pose, dtype=float)
    return np.concatenate([pose[:3] + by[:3], product(quaternionOf(by[3:]), pose[3:])])


def solutionOf(komo, start, parameter):
    solver = ry.NLP_Solver(komo.nlp())
    if start is not None:
        solver.setInitialization(start)
    result = solver.solve(verbose=0)
    assert result.feasible
    return result.sensitivity(parameter)


def assertEqualsDifferences(make, parameter, size):
    """`make` makes a KOMO whose parameter is moved by a vector. Differences of two steps rid each other of their third
    order."""
    at = solutionOf(make(np.zeros(size)), None, parameter)
    assert at.jacobian.shape == (len(at.x), size)
    for k in range(size):
        found = []
        for h in (STEP, 2 * STEP):
            ends = [solutionOf(make(sign * h * np.eye(size)[k]), at.x, parameter).x for sign in (1, -1)]
            found.append((ends[0] - ends[1]) / (2 * h))
        expected = (4 * found[0] - found[1]) / 3
        np.testing.assert_allclose(at.jacobian[:, k], expected, atol=TOLERANCE * max(1, abs(expected).max()), rtol=0)
    v = np.random.default_rng(0).normal(size=len(at.x))
    gradient = v @ at.jacobian
    np.testing.assert_allclose(at.gradient(v), gradient, atol=1e-8 * max(1, abs(gradient).max()), rtol=0)
    return at


def reach(C, target=(0.0, 0.0, 0.0), slices=1, order=0, scale=(10.0,), collisions=ry.FS.pairCollisions, type=ry.OT.eq):
    komo = ry.KOMO(C, 1, slices, order, True)
    komo.addControlObjective([], order, 1e-1 if order == 0 else 1.0)
    komo.addObjective([1.0], ry.FS.positionDiff, ["l_gripper", "goal"], type, scale, target)
    komo.addObjective([], ry.FS.jointLimits, [], ry.OT.ineq)
    komo.addObjective([], collisions, [], ry.OT.ineq if collisions == ry.FS.pairCollisions else ry.OT.eq, [10])
    if order == 2:
        komo.addObjective([1.0], ry.FS.qItself, [], ry.OT.eq, [10], [], order - 1)
    return komo


@pytest.mark.parametrize("slices, order", [(1, 0), (8, 1), (12, 2)])
@pytest.mark.parametrize("collisions", [ry.FS.pairCollisions, ry.FS.accumulatedCollisions])
def test_by_a_target(slices, order, collisions):
    C = panda()
    assertEqualsDifferences(lambda p: reach(C, p, slices, order, collisions=collisions), "positionDiff", 3)


def test_by_the_place_of_an_obstacle_that_presses():
    C = panda()

    def make(p):
        C.getFrame("box").setPosition(np.add(p, [0.2, 0.3, 0.9]))
        return reach(C, slices=10, order=2)

    at = assertEqualsDifferences(make, "box", 3)
    assert any("pairCollisions" in name for name in at.active)
    assert abs(at.jacobian).max() > 0.1
    assert at.names[0] == "position of box, x"


@pytest.mark.parametrize("collisions", [ry.FS.pairCollisions, ry.FS.accumulatedCollisions])
def test_by_the_place_of_what_an_obstacle_hangs_on(collisions):
    """The frame itself has no shape, and no objective names it."""

    def make(p):
        C = panda()
        C.delFrame("box")
        C.addFrame("mount").setPosition(np.array([0.2, 0.3, 0.5]) + p)
        C.addFrame("box", "mount").setShape(ry.ST.sphere, [0.15]).setRelativePosition([0, 0, 0.4]).setContact(1)
        return reach(C, slices=6, order=2, collisions=collisions)

    at = solutionOf(make(np.zeros(3)), None, "mount")
    assert any("ollisions" in name for name in at.active) and abs(at.jacobian).max() > 0.1
    assertEqualsDifferences(make, "mount", 3)


def test_by_the_pose_of_the_base_turns_all_that_hangs_there():
    C = panda()
    base = C.getFrame("l_panda_base")
    given = base.getRelativePose()

    def make(p):
        base.setRelativePose(moved(given, p))
        return reach(C, slices=1)

    assertEqualsDifferences(make, ("l_panda_base", "pose"), 6)


def test_by_a_frame_on_the_hand_as_for_calibration():
    C = panda()
    camera = C.addFrame("camera", "l_gripper")
    given = [0.05, 0.0, 0.03, 1.0, 0, 0, 0]

    def make(p):
        camera.setRelativePose(moved(given, p))
        komo = ry.KOMO(C, 1, 1, 0, False)
        komo.addControlObjective([], 0, 1e-1)
        komo.addObjective([], ry.FS.positionDiff, ["camera", "goal"], ry.OT.eq, [10])
        komo.addObjective([], ry.FS.vectorZ, ["camera"], ry.OT.eq, [1], [0, 0, 1])
        return komo

    assertEqualsDifferences(make, ("camera", "pose"), 6)


@pytest.mark.parametrize("order", [0, 2])
def test_by_scales(order):
    C = panda()
    given = np.array([3.0, 4.0, 5.0])
    make = lambda p: reach(C, slices=1 if order == 0 else 6, order=order, scale=given + p, type=ry.OT.sos)  # noqa: E731
    assertEqualsDifferences(make, ("positionDiff", "scale"), 3)


def test_by_where_a_motion_starts():
    C = panda()
    q = C.getJointState()

    def make(p):
        C.setJointState(q + p)
        komo = ry.KOMO(C, 1, 8, 2, False)
        komo.addControlObjective([], 2, 1.0)
        komo.addObjective([1.0], ry.FS.positionDiff, ["l_gripper", "goal"], ry.OT.eq, [10])
        return komo

    assertEqualsDifferences(make, "start", 7)


def test_across_mode_switches():
    C = panda()
    C.addFrame("ball").setShape(ry.ST.sphere, [0.03]).setPosition([0.3, 0.3, 1.0])

    def make(p):
        C.getFrame("ball").setPosition(np.add(p, [0.3, 0.3, 1.0]))
        komo = ry.KOMO(C, 2, 5, 2, False)
        komo.addControlObjective([], 2, 1.0)
        komo.addModeSwitch([1.0, 2.0], ry.SY.stable, ["l_gripper", "ball"], True)
        komo.addObjective([1.0], ry.FS.positionDiff, ["l_gripper", "ball"], ry.OT.eq, [10])
        komo.addObjective([1.0], ry.FS.vectorZ, ["l_gripper"], ry.OT.eq, [10], [0, 0, 1])
        komo.addObjective([2.0], ry.FS.position, ["ball"], ry.OT.eq, [10], [0.1, 0.4, 1.1])
        komo.addObjective([2.0], ry.FS.quaternion, ["ball"], ry.OT.sos, [1], [1, 0, 0, 0])
        komo.addQuaternionNorms()  # else the norm of the ball's is free
        return komo

    at = assertEqualsDifferences(make, "ball", 3)
    assert at.freeDirections == 0


@pytest.mark.parametrize("parts", ["position", "pose", "direction", "relative", "feature"])
@pytest.mark.parametrize("home", [0.0, 1.0])
def test_of_inverse_kinematics(parts, home):
    C = panda()
    C.getFrame("box").setPosition([2.0, 2.0, 0.0])
    pose = C.getFrame("l_gripper").getPose() + np.array([0.03, 0.04, 0.05, 0, 0, 0, 0])
    size = {"position": 3, "pose": 6, "direction": 6, "relative": 3, "feature": 3}[parts]

    def targets(p):
        if parts == "pose":
            return {"l_gripper": moved(pose, p)}
        if parts == "direction":
            return {"l_gripper": {"position": pose[:3] + p[:3], "z": np.add(p[3:], [0.1, 0.2, -1.0])}}
        if parts == "relative":
            return {"l_gripper": {"position": np.add(p, [-0.1, 0.05, 0.1]), "relativeTo": "goal"}}
        if parts == "feature":
            return {(ry.FS.positionDiff, "l_gripper", "goal"): np.add(p, [-0.1, 0.05, 0.1])}
        return {"l_gripper": pose[:3] + p}

    at = ry.solveIk(C, targets(np.zeros(size)), home_weight=home).sensitivity()
    assert at.jacobian.shape == (7, size)
    assert (at.freeDirections > 0) == (home == 0)
    assert ("shortest" in at.message) == (home == 0)
    if home == 0:
        C.setJointState(at.x)  # the way from there is the shortest one
    for k in range(size):
        ends = [ry.solveIk(C, targets(s * STEP * np.eye(size)[k]), home_weight=home).sensitivity().x for s in (1, -1)]
        np.testing.assert_allclose(at.jacobian[:, k], (ends[0] - ends[1]) / (2 * STEP), atol=5 * TOLERANCE, rtol=0)


def test_of_many_answers_at_once_whatever_the_threads():
    C = panda()
    rng = np.random.default_rng(1)
    targets = [0.3, 0.3, 1.1] + 0.05 * rng.normal(size=(20, 3))
    targets[4] = [5, 5, 5]
    results = ry.solveIk(C, {"l_gripper": targets}, attempts=3)
    v = rng.normal(size=(20, 7))
    gradients = results.gradients(v)
    assert gradients.shape == (20, 3)
    assert np.array_equal(gradients, results.gradients(v, threads=4), equal_nan=True)
    for i, result in enumerate(results):
        if result:
            assert np.array_equal(gradients[i], result.sensitivity().gradient(v[i]))
        else:
            assert np.isnan(gradients[i]).all()
    assert not results[4]


def halfLine(p):
    """Minimize (x - p)^2 subject to x >= 0."""
    factory = ry.NLP_Factory()
    factory.setDimension(1)
    factory.setFeatureTypes([ry.OT.sos, ry.OT.ineq])
    factory.setBounds([-10.0], [10.0])
    factory.setEvalCallback(lambda x: (np.array([x[0] - p, -x[0]]), np.array([[1.0], [-1.0]])))
    return ry.NLP_Solver(factory).solve(verbose=0)


def test_a_non_smooth_solution_is_reported_with_each_one_sided_derivative():
    assert halfLine(1.0).sensitivity(("residual", 0)).jacobian[0, 0] == pytest.approx(1, abs=1e-9)
    assert halfLine(-1.0).sensitivity(("residual", 0)).jacobian[0, 0] == pytest.approx(0, abs=1e-9)
    result = halfLine(0.0)
    sides = [result.sensitivity(("residual", [0]), holdWeak=hold) for hold in (False, True)]
    assert [side.jacobian[0, 0] for side in sides] == pytest.approx([1, 0], abs=1e-9)
    for side in sides:
        assert len(side.weak) == 1
        assert not side.isRegular
        assert "not differentiable" in side.message
        assert "not differentiable" in repr(side)


def test_what_has_no_effect_is_named():
    C = panda()
    komo = reach(C)
    C.getFrame("box").setPosition([2.0, 2.0, 0.0])
    komo.updateRootObjects(C)
    at = ry.NLP_Solver(komo.nlp()).solve(verbose=0).sensitivity("box", "positionDiff")
    assert at.withoutEffect == [f"position of box, {axis}" for axis in "xyz"]
    assert not at[0].any()
    assert at[1].any()
    assert len(at) == 2
    assert at.columns(1) == slice(3, 6, 1)
    with pytest.raises(IndexError, match="parameter 2 of 2"):
        at[2]


def test_mistakes_are_reported():
    C = panda()
    komo = reach(C)
    result = ry.NLP_Solver(komo.nlp()).solve(verbose=0)
    with pytest.raises(ry.NotFound, match="similar names: .*positionDiff"):
        result.sensitivity("positionDif of l_gripper, goal")
    with pytest.raises(ry.NotFound, match="'positonDiff'.*; the objectives are .*positionDiff of l_gripper, goal"):
        result.sensitivity("positonDiff")
    with pytest.raises(
        ry.ArgumentError, match=r"'residual' needs indices in the same tuple: sensitivity\(\(\"residual"
    ):
        result.sensitivity("residual", 1)
    with pytest.raises(ry.NotFound, match="no 'size'.*position or pose"):
        result.sensitivity(("box", "size"))
    with pytest.raises(ry.ArgumentError, match="is moved by its joint"):
        result.sensitivity("l_panda_joint4")
    with pytest.raises(ry.ArgumentError, match="no objective 9; the problem has"):
        result.sensitivity(9)
    with pytest.raises(ry.ArgumentError, match="order 0"):
        result.sensitivity("start")
    with pytest.raises(ry.ArgumentError, match="no parameters"):
        result.sensitivity()
    with pytest.raises(ry.ArgumentError, match="solve the problem first"):
        pickle.loads(pickle.dumps(result)).sensitivity("box")
    far = reach(C, [5.0, 0.0, 0.0])
    with pytest.raises(ry.ArgumentError, match="violates its constraints"):
        ry.NLP_Solver(far.nlp()).solve(verbose=0).sensitivity("box")
    with pytest.raises(ry.ArgumentError, match="not a solution"):
        ry.solveIk(C, {"l_gripper": [5, 5, 5]}, attempts=1).sensitivity()
    answer = ry.solveIk(C, {"l_gripper": [0.3, 0.3, 1.1]})
    with pytest.raises(ry.NotFound, match="the targets are of l_gripper"):
        answer.sensitivity("l_griper")
    with pytest.raises(ry.ArgumentError, match="3 entries; the solution has 7"):
        answer.sensitivity("l_gripper").gradient([1, 2, 3])


def test_limits_that_are_given_as_bounds_and_as_an_objective_stay_differentiable():
    C = ry.Config()
    C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
    komo = ry.KOMO(C, 1, 1, 0, False)
    komo.addControlObjective([], 0, 1e-1)
    komo.addObjective([], ry.FS.jointLimits, [], ry.OT.ineq, [1.0])
    beyond = C.getJointState() + 2.0 * np.eye(7)[3]  # the limit of the elbow is in between
    komo.addObjective([1.0], ry.FS.qItself, [], ry.OT.sos, [1.0], beyond)
    result = ry.NLP_Solver(komo.nlp(), verbose=0).solve()
    of_target = result.sensitivity(2)  # of the position
    assert of_target.active, "the problem is no test: no limit presses"
    assert of_target.isRegular, of_target.message
