"""All collision checks of configurations and motions count the same pairs."""

import numpy as np
import pytest

import kinegraph as ry

pytestmark = pytest.mark.filterwarnings("ignore:.*at a constant relative pose")


def bench(n=0):
    """A slider on a bench that it overlaps by 3 mm as a root of its own, below a lamp; `n` balls far away."""
    C = ry.Config()
    C.addText(
        """
        base: { X: [0 0 .047], shape: box, size: [.2 .2 .1], contact: 1 }
        slide (base): { pre: [0 0 .3], joint: transX, limits: [-2 2], shape: sphere, size: [.1], contact: 1 }
        hand (slide): { Q: [0 0 .05] }
        floor: { X: [0 0 -.05], shape: box, size: [4 4 .1], contact: 1 }
        wall: { X: [1 0 .5], shape: box, size: [.02 1 1.2], contact: 1 }
        """
    )
    for i in range(n):
        C.addFrame(f"ball{i}").setShape(ry.ST.sphere, [0.1]).setPosition([50.0 + i, 0, 0]).setContact(1)
    return C


@pytest.fixture(params=[0, 100], ids=["few bodies", "many bodies"])
def scene(request):
    return bench(request.param)


def test_pairsThatNoJointMovesSayNothingAboutQ(scene):
    assert {frozenset(pair[:2]) for pair in scene.getCollisions()} == {
        frozenset(["base", "floor"]),
        frozenset(["floor", "wall"]),
    }
    np.testing.assert_array_equal(scene.isValid([[0.0], [0.889], [0.891], [1.0], [1.2]]), [1, 1, 0, 0, 1])
    assert scene.checkMotion([0.0], [0.88]) is None
    assert set(scene.checkMotion([0.0], [1.2]).frames) == {"slide", "wall"}
    np.testing.assert_array_equal(scene.isMotionFree([[0.0], [0.0]], [[0.88], [1.2]]), [True, False])
    assert ry.solveIk(scene, {"hand": [0.5, 0.0, 0.397]}).feasible
    assert not ry.solveIk(scene, {"hand": [1.0, 0.0, 0.397]}).feasible


def solved(C, x, feature=ry.FS.accumulatedCollisions):
    komo = ry.KOMO(C, 1, 1, 0, False)
    komo.addObjective([], ry.FS.position, ["hand"], ry.OT.sos, [[10, 0, 0]], [x, 0, 0])
    komo.addObjective([], feature, [], ry.OT.ineq, [10.0])
    return komo, ry.NLP_Solver(komo.nlp(), verbose=0).solve()


def test_aKomoAsksJointsOnlyForWhatTheyCanDo(scene):
    komo, result = solved(scene, 0.5)
    assert result.feasible and komo.getPath()[0][0] == pytest.approx(0.5, abs=1e-3)
    komo, result = solved(scene, 0.95)
    assert result.feasible and scene.isValid(komo.getPath(), margin=-1e-3).all()
    assert not scene.isValid([[0.95]])


def test_theFeatureMeasuresTheSceneAsItIs(scene):
    """Scripts place objects without a joint, and query their penetration."""
    depth = scene.eval(ry.FS.accumulatedCollisions)[0][0]
    assert depth == pytest.approx(scene.coll_totalViolation(), abs=1e-12) and depth > 0.003
    scene.getFrame("floor").setPosition([0, 0, -0.5])
    assert scene.eval(ry.FS.accumulatedCollisions)[0][0] == 0.0


def test_withoutJointsEveryQIsFree():
    C = ry.Config()
    for name in "ab":
        C.addFrame(name).setShape(ry.ST.sphere, [0.1]).setContact(1)
    assert C.isValid(np.zeros((1, 0))).all()
    assert C.eval(ry.FS.accumulatedCollisions)[0][0] == pytest.approx(0.2)


def test_solveIkIsNotSolvedWhereOtherJointsHoldAPairTooNear():
    C = bench()
    C.addFrame("other", "base", "pre: [.6 0 0], joint: transZ, q: .1, shape: sphere, size: [.2], contact: 1")
    result = ry.solveIk(C, {"hand": [-0.6, 0.0, 0.397]})
    assert not result.feasible and not C.isValid([result.q])[0]
    assert "'other'" in result.message and "no joint that moves a target separates them" in result.message


def test_limitsHaveATolerance(scene):
    np.testing.assert_array_equal(
        scene.isValid([[np.float32(2.0)], [2.0 + 9e-6], [-2.0 - 9e-6], [2.0 + 2e-5]]), [1, 1, 1, 0]
    )
    np.testing.assert_array_equal(scene.isMotionFree([[1.5], [1.5]], [[2.0 + 9e-6], [2.1]]), [True, False])
    contact = scene.checkMotion([1.5], [2.5])
    assert contact.limit == "slide" and contact.time == pytest.approx(0.5) and contact.frames == ("slide", "slide")
    assert "joint slide leaves its limits" in repr(contact)
    assert scene.checkMotion([0.5], [3.0]).limit is None


def test_aNoteSaysOnceWhichPairsNeverMove():
    C = bench()
    C.getFrame("wall").setPosition([1.0, 0, 0.61])
    C.getFrame("base").setPosition([0, 0, 0.047])
    with pytest.warns(ry.KinegraphWarning, match="'base' and 'floor' overlap at a constant relative pose"):
        C.isValid([[0.0]])
    C.isValid([[0.0]])  # an error if it warned again
    C.addFrame("far").setPosition([9.0, 0, 0])
    assert C.checkMotion([0.0], [0.1]) is None
    assert len(C.contactWarnings()) == 1 and C.contactWarnings()[0] in C.report()


def test_aNoteSaysWhichObstacleIsIgnored():
    C = bench()
    C.getFrame("floor").setPosition([0, 0, -0.5])
    C.addFrame("box").setShape(ry.ST.box, [0.2, 0.2, 0.2]).setPosition([0.2, 0, 0.35])
    with pytest.warns(ry.KinegraphWarning, match="'box' is near moving links but cannot collide"):
        ry.solveIk(C, {"hand": [0.5, 0.0, 0.397]})
    C.getFrame("box").setContact(1)
    assert C.contactWarnings() == [] and not C.isValid([[0.2]])[0]
