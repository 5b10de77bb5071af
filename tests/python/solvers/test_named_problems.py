"""The named motion problems: their parts agree with the package robotic, and they can be solved."""

import json
from itertools import groupby
from pathlib import Path

import numpy as np
import pytest

import kinegraph as ry

RECORDED = json.loads((Path(__file__).parents[2] / "data" / "named_problems.json").read_text())
MOTIONS = [name for name in RECORDED if name != "origin"]
WEIGHT = 0.2 * 9.81  # of the sphere, N

# More or fewer residuals than robotic, on purpose. Pick: an attachment from 1 to 1 lasts; in robotic it must also have
# been there before, so that the arm cannot go to the cube. StackAndBalance: with a slice per phase, forces are smooth
# between the two slices of a contact, too.
OTHER_ROWS = {
    "OptBench_Skeleton_Pick _sequence": {"eq": -7},
    "OptBench_Skeleton_Pick _path": {"eq": -7},
    "OptBench_Skeleton_StackAndBalance _sequence": {"sos": 12},
}


def problem(name: str) -> ry.NLP:
    if name.startswith("OptBench"):
        kind, word = name.split()
        return getattr(ry, kind)(getattr(ry, word)).get()
    return ry.make_NLP_Problem(name)


def counts(types):
    return {kind: sum(1 for t in types if t == kind) for kind in ("f", "sos", "ineq", "eq")}


def dense(nlp, x):
    phi, J = nlp.evaluate(x)
    J = np.asarray(J)
    if J.shape == (len(phi), len(x)):
        return phi, J
    full = np.zeros((len(phi), len(x)))
    for row, column, value in J:
        full[int(row), int(column)] += value
    return phi, full


def violation(nlp, x):
    phi, _ = nlp.evaluate(x)
    return max(
        abs(value) if kind == ry.OT.eq else max(value, 0.0) if kind == ry.OT.ineq else 0.0
        for value, kind in zip(phi, nlp.getTypes())
    )


@pytest.mark.parametrize("name", MOTIONS)
def test_it_has_the_variables_and_residuals_of_the_reference(name):
    nlp, recorded = problem(name), RECORDED[name]
    assert nlp.dimension == recorded["dimension"]
    types = [t.name for t in nlp.getTypes()]
    there = counts([kind for kind, times in recorded["types"] for _ in range(times)])
    for kind, more in OTHER_ROWS.get(name, {}).items():
        there[kind] += more
    assert counts(types) == there
    if name not in OTHER_ROWS and "Stack" not in name:
        assert [[kind, len(list(run))] for kind, run in groupby(types)] == recorded["types"]


# Rows that differ on purpose, by the tag that getFeatureNames gives them: the sign of a quaternion means nothing; a
# direction of motion has length one; a point inside of a body has a negative distance.
def comparable(name, tags, phi):
    flip = np.ones(len(phi))
    keep = np.ones(len(phi), bool)
    for i, tag in enumerate(tags):
        if name == "StableSphere" and "poa" in tag:
            flip[i] = -1.0
        keep[i] = not tag.startswith(("F_FrictionCone", "F_AlignYWithDiff"))
    return flip, keep


@pytest.mark.parametrize("name", [name for name in MOTIONS if "x" in RECORDED[name] and name not in OTHER_ROWS])
def test_residuals_and_derivatives_are_those_of_the_reference(name):
    nlp, recorded = problem(name), RECORDED[name]
    if name != "PushToReach":  # a hinge there has 1e-5 more room
        np.testing.assert_allclose(nlp.getBounds(), recorded["bounds"], atol=1e-5)
    x, unit = np.array(recorded["x"]), np.ones(len(recorded["x"]))
    if name == "StableSphere":  # forces in weights, points as the first frame sees them
        for contact in range(3):
            unit[12 + 6 * contact : 15 + 6 * contact] = WEIGHT
            x[11 + 6 * contact] -= 0.5
    phi, J = dense(nlp, x / unit)
    theirs, J_theirs = np.array(recorded["phi"]), np.zeros((len(recorded["phi"]), len(x)))
    rows, columns, values = recorded["J"]
    J_theirs[rows, columns] = values
    komo = nlp.as_KOMO()
    tags = komo.getFeatureNames() if komo else [""] * len(phi)
    flip, keep = comparable(name, tags, phi)
    for tag in ("F_Pose/vel", "F_PoseRel/vel"):
        for start in [i for i, t in enumerate(tags) if t.startswith(tag) and (i == 0 or tags[i - 1] != t)]:
            quaternion = slice(start + 3, start + 7)
            if np.linalg.norm(phi[quaternion] + theirs[quaternion]) < np.linalg.norm(
                phi[quaternion] - theirs[quaternion]
            ):
                flip[quaternion] = -1.0
    np.testing.assert_allclose((flip * phi)[keep], theirs[keep], atol=2e-6)
    if name == "MinimalConvexCore":  # there the derivative of the cost lacks a division by the length
        keep[0] = False
    np.testing.assert_allclose((flip[:, None] * J / unit)[keep], J_theirs[keep], atol=2e-5)


@pytest.mark.parametrize(("name", "target", "cost"), [("IK", "target", 0.00851), ("IKobstacle", "dot", 0.0382)])
def test_the_best_of_twenty_reaches_has_the_least_cost_known(name, target, cost):
    nlp, rng = ry.make_NLP_Problem(name), np.random.default_rng(0)
    home = nlp.as_KOMO().getPath()[0]
    ends = []
    for _ in range(20):
        solver = ry.NLP_Solver(nlp, verbose=0).setInitialization(home + 0.3 * rng.standard_normal(7))
        ends.append(solver.solve())
        if ends[-1].feasible:
            reached = nlp.as_KOMO().getConfiguration(0).eval(ry.FS.positionDiff, ["l_gripper", target])[0]
            assert np.linalg.norm(reached) < 1e-3
    assert abs(min(end.sos for end in ends if end.feasible) - cost) < 1e-4


@pytest.mark.parametrize(
    "name", ["StableSphere", "MinimalConvexCore", *(n for n in MOTIONS if "Pick" in n or "Handover" in n)]
)
def test_the_default_solver_solves_it_at_once(name):
    nlp = problem(name)
    ret = ry.NLP_Solver(nlp, verbose=0).solve()
    assert violation(nlp, ret.x) < 1e-3, ret.message


def test_pushing_a_box_away_to_reach_far_with_a_stick_needs_restarts():
    nlp = ry.make_NLP_Problem("PushToReach")
    komo = nlp.as_KOMO()
    result = komo.solveFromMany(20, seed=0)
    assert result.best.feasible
    assert violation(komo.nlp(), result.best.x) < 1e-3
    end = komo.getConfiguration(3)
    assert abs(end.eval(ry.FS.negDistance, ["stick", "dot"])[0][0]) < 1e-3
    assert end.getFrame("stick").getParent().name == "l_gripper"
    moved = end.getFrame("box").getPosition() - komo.getConfiguration(0).getFrame("box").getPosition()
    assert np.linalg.norm(moved[:2]) > 0.05 and abs(moved[2]) < 1e-3


def test_the_sphere_is_held_by_forces_that_push():
    nlp = ry.make_NLP_Problem("StableSphere")
    ry.NLP_Solver(nlp, verbose=0).solve()
    komo = nlp.as_KOMO()
    contacts = komo.getForceInteractions()
    assert [c["from"] for c in contacts] == ["box", "l_finger", "r_finger"]
    np.testing.assert_allclose(sum(np.array(c["force"]) for c in contacts), [0, 0, WEIGHT], atol=1e-3)
    center = komo.getConfiguration(0).getFrame("obj").getPosition()
    for contact in contacts:
        inwards = center - np.array(contact["poa"])
        cosine = inwards @ contact["force"] / np.linalg.norm(inwards) / np.linalg.norm(contact["force"])
        assert cosine > 0.8 - 1e-3, "within the cone of friction"
        assert abs(np.linalg.norm(inwards) - 0.1) < 1e-3, "on the surface"


def test_what_holds_the_sphere_is_drawn_with_the_seed():
    def supports(seed):
        nlp = ry.make_NLP_Problem("StableSphere", seed=seed)
        ry.NLP_Solver(nlp, verbose=0).setOptions(stopEvals=1, verbose=0).solve()
        return [c["from"] for c in nlp.as_KOMO().getForceInteractions()]

    drawn = [supports(seed) for seed in range(8)]
    assert all(drawn) and supports(3) == drawn[3] and len({tuple(names) for names in drawn}) > 3


def test_one_arm_hands_the_stick_over_to_the_other():
    nlp = ry.OptBench_Skeleton_Handover(ry._sequence).get()
    ry.NLP_Solver(nlp, verbose=0).solve()
    komo = nlp.as_KOMO()
    assert [komo.getConfiguration(t).getFrame("stick").getParent().name for t in range(3)] == [
        "R_endeff",
        "L_endeff",
        "L_endeff",
    ]
    assert abs(komo.getConfiguration(2).eval(ry.FS.negDistance, ["stick", "ball"])[0][0]) < 1e-3


@pytest.mark.parametrize("unconstrained", [False, True])
def test_the_pose_of_a_gripper_in_line_with_a_box(tmp_path, unconstrained):
    scene = tmp_path / "arm.g"
    scene.write_text(
        f"Include: <{ry.raiPath('scenarios/simpleArm.g')}>\n"
        "gripper (endeff): { Q: [0, 0, .05] }\n"
        "box: { pose: [.4, .5, .6, .3, .9, .2, 0.1], shape: ssBox, size: [.1, .1, .1, .02] }\n"
    )
    nlp = ry.OptBenchmark_InvKin_Endeff(str(scene), unconstrained).get()
    kind = ry.OT.sos if unconstrained else ry.OT.eq
    assert nlp.getTypes() == [ry.OT.sos] * 7 + [kind] * 7
    ret = ry.NLP_Solver(nlp, verbose=0).solve()
    assert ret.feasible
    end = nlp.as_KOMO().getConfiguration(0)
    for feature in (ry.FS.positionDiff, ry.FS.vectorZDiff, ry.FS.scalarProductXX):
        assert np.abs(end.eval(feature, ["gripper", "box"])[0]).max() < 2e-3


def test_words_are_numbers_and_only_two_say_how_fine_a_motion_is():
    assert [int(w) for w in (ry._left, ry._right, ry._sequence, ry._path)] == [0, 1, 2, 3]
    assert ry.ArgWord._path is ry._path and ry.ArgWord(2) is ry._sequence
    with pytest.raises(
        ry.ArgumentError, match="OptBench_Skeleton_Pick: sequenceOrPath is .*_left.*; expected _sequence or _path"
    ):
        ry.OptBench_Skeleton_Pick(ry._left)
    with pytest.raises(ry.Error, match="nowhere"):
        ry.OptBenchmark_InvKin_Endeff("nowhere.g", False)


def test_the_problem_outlives_what_made_it():
    nlp = ry.OptBench_Skeleton_Pick(ry._sequence).get()
    assert violation(nlp, ry.NLP_Solver(nlp, verbose=0).solve().x) < 1e-3


def test_aMistypedNameIsToldWithTheOneThatIsNear():
    with pytest.raises(ry.NotFound, match="'PushToReech'; expected one of .*; similar names: PushToReach"):
        ry.make_NLP_Problem("PushToReech")
