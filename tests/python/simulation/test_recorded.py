"""Models, features and inverse kinematics against recorded numbers."""

import numpy as np
import pytest

import kinegraph as ry
from base_pairs import pairsAtBases
from conftest import recorded

MODELS = ["panda", "pandaSingle", "pandasTable"]


@pytest.fixture(params=MODELS)
def model(request):
    numbers = recorded(request.param)
    C = ry.Config()
    C.addFile(ry.raiPath(numbers["file"]))
    return C, numbers


def samePoses(ours, theirs):
    """Largest difference; a quaternion and its negative are the same rotation."""
    ours, theirs = np.array(ours), np.array(theirs)
    signs = np.sign(np.sum(ours[:, 3:] * theirs[:, 3:], axis=1, keepdims=True))
    return max(np.abs(ours[:, :3] - theirs[:, :3]).max(), np.abs(ours[:, 3:] - signs * theirs[:, 3:]).max())


def test_every_frame_has_its_parent_its_pose_and_its_joint(model):
    C, numbers = model
    ours = {frame.name: frame for frame in C.getFrames()}
    poses = [(ours[frame["name"]].getPose(), frame["pose"]) for frame in numbers["frames"] if not frame.get("drawn")]
    assert samePoses(*zip(*poses)) < 1e-6
    for frame in numbers["frames"]:
        if frame.get("drawn"):
            continue
        parent = ours[frame["name"]].getParent()
        assert (parent.name if parent else None) == frame["parent"], frame["name"]
        assert ours[frame["name"]].getJointType() == getattr(ry.JT, frame.get("joint") or "none"), frame["name"]


def test_joints_limits_and_the_home_configuration_are_as_recorded(model):
    C, numbers = model
    assert list(C.getJointNames()) == numbers["joint_names"]
    assert np.allclose(C.getJointState(), numbers["q_home"], atol=1e-9)
    assert np.allclose(C.getJointLimits(), numbers["limits"], atol=1e-9)


def test_the_same_pairs_of_frames_may_collide(model):
    C, numbers = model
    names = C.getCollidablePairs()
    ours = {frozenset(pair) for pair in zip(names[::2], names[1::2])}
    assert ours == {frozenset(pair) for pair in [*numbers["collidable_pairs"], *pairsAtBases(C)]}


def test_poses_at_random_joint_states_are_as_recorded(model):
    C, numbers = model
    names = [frame["name"] for frame in numbers["frames"]]
    ids = {frame.name: frame.ID for frame in C.getFrames()}
    kept = [i for i, frame in enumerate(numbers["frames"]) if frame["name"] in ids and not frame.get("drawn")]
    assert len(kept) > 0.4 * len(names)
    for sample in numbers["random"]:
        C.setJointState(sample["q"])
        ours = C.getFrameState()[[ids[names[i]] for i in kept]]
        assert samePoses(ours, np.array(sample["poses"])[kept]) < 1e-6


NEEDS_DYNAMICS = {"energy", "physics", "totalForce", "contactConstraints"}
DIRECTIONS = {"AlignXWithDiff", "AlignYWithDiff"}  # there of length |d| / (|d| + 1e-4 m), which is never an axis


def evaluate(C, symbol, record):
    """y and J of a feature: of the configuration, or, with an order, of the last slice of a path x."""
    if record["order"] == 0:
        return C.eval(symbol, record["frames"])
    komo = ry.KOMO(C, 3, 1, 2, False)
    komo.addObjective([3.0], symbol, record["frames"], ry.OT.eq, [1.0], [], record["order"])
    y, entries = komo.nlp().evaluate(record["x"])
    J = np.zeros((len(y), len(record["x"])))
    for row, column, value in entries:
        J[int(row), int(column)] += value
    return y, J


def signs(rows, quaternion):
    """A quaternion, in rows from..to, may come with either sign."""
    flipped = np.ones(rows)
    flipped[slice(*quaternion)] = -1
    return np.ones(rows), flipped


@pytest.mark.parametrize("name", ["features_panda", "features_builtin"])
def test_features_and_their_jacobians_are_as_recorded(name):
    numbers = recorded(name)
    C = ry.Config()
    if "scene" in numbers:
        C.addText(numbers["scene"])
    else:
        C.addFile(ry.raiPath(numbers["scene_file"]))
    wrong = []
    for record in numbers["records"]:
        if record["symbol"] in NEEDS_DYNAMICS | DIRECTIONS:
            continue
        if record["order"] == 0:
            C.setJointState(numbers["q_samples"][record["sample"]])
        else:
            C.setJointState(numbers["q_samples"][0])
        y, J = evaluate(C, getattr(ry.FS, record["symbol"]), record)
        theirs_y, theirs_J = np.array(record["y"]), np.array(record["J"]).reshape(J.shape)
        difference = min(
            max(np.abs(sign * y - theirs_y).max(initial=0), np.abs(sign[:, None] * J - theirs_J).max(initial=0))
            for sign in signs(len(y), record.get("sign_free", (0, 0)))
        )
        if not difference < 2e-5:
            wrong.append((record["symbol"], record["frames"], record["order"], difference))
    assert wrong == []


def test_the_two_link_arm_moves_as_recorded():
    numbers = recorded("tutorial_arm")
    C = ry.Config()
    C.addText(numbers["scene"])
    for sample in numbers["arm"]:
        C.setJointState(sample["q"])
        for name in ("link1", "link2", "endeffector"):
            assert samePoses([C.getFrame(name).getPose()], [sample[name]["pose"]]) < 1e-6
            assert np.allclose(C.eval(ry.FS.position, [name])[1], sample[name]["J_position"], atol=1e-6)


@pytest.mark.parametrize("joint", recorded("tutorial_arm")["joints"], ids=lambda joint: joint["scene"].split()[-2])
def test_a_joint_places_its_frame_as_recorded(joint):
    C = ry.Config()
    C.addText(joint["scene"])
    C.setJointState(joint["q"])
    assert samePoses([C.getFrames()[-1].getPose()], [joint["pose"]]) < 1e-6


def ikProblem(C, numbers):
    problem = numbers["problem"]
    C.addFrame("target").setPosition(problem["target_position"])
    komo = ry.KOMO(C, *problem["komo"])
    for objective in problem["objectives"]:
        target = numbers["q_home"] if "target" in objective else []
        komo.addObjective(
            [],
            getattr(ry.FS, objective["feature"]),
            objective["frames"],
            getattr(ry.OT, objective["type"]),
            objective["scale"],
            target,
        )
    return komo


def test_an_inverse_kinematics_problem_has_the_recorded_residuals_and_a_solution_as_good(panda):
    numbers = recorded("komo_ik_position")
    komo = ikProblem(panda, numbers)
    nlp = komo.nlp()
    assert nlp.getDimension() == numbers["dim"]
    assert [str(kind).rsplit(".")[-1] for kind in nlp.getFeatureTypes()] == numbers["types"]
    assert np.allclose(nlp.getBounds(), numbers["bounds"])
    assert np.allclose(nlp.evaluate(numbers["q_home"])[0], numbers["phi_at_home"], atol=1e-6)
    result = ry.NLP_Solver(nlp, verbose=0).solve()
    assert result.feasible
    assert result.sos < numbers["best_sos"] * 1.01
    assert result.evals <= numbers["median_evaluations"]
    for run in numbers["runs"]:
        y = np.array(nlp.evaluate(run["x"])[0])
        assert np.isclose(np.sum(y[:7] ** 2), run["sos"], atol=1e-5)


def test_the_equation_of_motion_of_a_double_pendulum_is_as_recorded():
    numbers = recorded("tutorial_arm")["dynamics"]
    C = ry.Config()
    C.addText(numbers["scene"])
    C.setJointState(numbers["q"])
    M, F = C.dyn_MF(numbers["qdot"])
    assert np.allclose(M, numbers["M"], rtol=1e-6) and np.allclose(F, numbers["F"], rtol=1e-6)
    assert np.allclose(C.dyn_F0(), numbers["F0"], rtol=1e-6)
    assert np.allclose(C.inverseDynamics(numbers["qdot"], [1, 2]), M @ [1, 2] + F)
