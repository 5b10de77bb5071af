"""Every motion problem can be stored: its copy has the same residuals and derivatives, and solves to the same bits."""

import importlib.util
import pickle
import warnings
from pathlib import Path

import numpy as np
import pytest

import kinegraph as ry

spec = importlib.util.spec_from_file_location(
    "komo_problems", Path(__file__).parents[3] / "benchmarks" / "komo_problems.py"
)
benchmarks = importlib.util.module_from_spec(spec)
spec.loader.exec_module(benchmarks)

SCENE = """
world: {}
table (world): { pose: [0, 0, .5], shape: ssBox, size: [2, 2, .1, .01] }
shoulder (table): { pose: [-.4, 0, .05] }
one (shoulder): { joint: hingeZ, limits: [-3, 3] }
two (one): { pre: [0, 0, .3], joint: hingeY, limits: [-3, 3], q: .5 }
three (two): { pre: [0, 0, .4], joint: hingeY, limits: [-3, 3], q: 1 }
four (three): { pre: [0, 0, .2], joint: hingeX, limits: [-3, 3] }
hand (four): { Q: [0, 0, .1], shape: ssBox, size: [.1, .05, .05, .01] }
palm (hand): { Q: [0, 0, -.05], shape: sphere, size: [.02] }
box (table): { joint: rigid, Q: [.2, .1, .1], shape: ssBox, size: [.1, .12, .1, .01], mass: .3 }
tray (table): { joint: rigid, Q: [.1, .4, .06], shape: ssBox, size: [.3, .2, .02, .01] }
stick (table): { joint: rigid, Q: [.2, -.3, .1], shape: capsule, size: [.3, .02], mass: .1 }
ball (world): { pose: [.2, .12, .8], joint: free, shape: sphere, size: [.05], mass: .5 }
"""


def scene() -> ry.Config:
    C = ry.Config()
    C.addText(SCENE)
    return C


def sameBits(komo: ry.KOMO, evaluations: int = 60) -> None:
    again = pickle.loads(pickle.dumps(komo))
    assert repr(again) == repr(komo)
    ours, theirs = komo.nlp(), again.nlp()
    assert ours.getTypes() == theirs.getTypes() and komo.getFeatureNames() == again.getFeatureNames()
    np.testing.assert_array_equal(ours.getBounds(), theirs.getBounds())
    for a, b in zip(komo.getPath_qAll(), again.getPath_qAll()):
        np.testing.assert_array_equal(a, b)
    x = ours.getInitializationSample()
    for noise in (0.0, 0.1):
        at = x + noise * np.random.default_rng(1).standard_normal(len(x))
        for a, b in zip(ours.evaluate(at), theirs.evaluate(at)):
            np.testing.assert_array_equal(a, b)
    solved = []
    for nlp in (ours, theirs):
        solver = ry.NLP_Solver(nlp, verbose=0).setOptions(stopEvals=evaluations, verbose=0)
        solved.append(solver.setInitialization(x).solve())
    np.testing.assert_array_equal(solved[0].x, solved[1].x)
    assert solved[0].message == solved[1].message


@pytest.mark.parametrize("name", benchmarks.PROBLEMS)
def test_benchmarks(name):
    _, komo = benchmarks.PROBLEMS[name](ry)
    sameBits(komo, 20)


@pytest.mark.parametrize("name", ["IK", "IKobstacle", "PushToReach", "StableSphere"])
def test_named_problems(name):
    sameBits(ry.make_NLP_Problem(name).as_KOMO())


@pytest.mark.parametrize("word", ["_sequence", "_path"])
@pytest.mark.parametrize("name", ["Pick", "Handover", "StackAndBalance"])
def test_skeleton_problems(name, word):
    nlp = getattr(ry, f"OptBench_Skeleton_{name}")(getattr(ry, word)).get()
    sameBits(nlp.as_KOMO(), 8)


ATTACHMENTS = {
    "stable": ["hand", "box"],
    "stableOn": ["tray", "box"],
    "stableOnX": ["tray", "box"],
    "stableOnY": ["tray", "box"],
    "stableYPhi": ["tray", "box"],
    "stableZero": ["tray", "box"],
    "dynamic": ["ball"],
    "dynamicOn": ["tray", "box"],
    "dynamicTrans": ["box"],
    "quasiStatic": ["ball"],
    "quasiStaticOn": ["tray", "box"],
    "magic": ["ball"],
    "magicTrans": ["tray", "box"],
}


@pytest.mark.filterwarnings("ignore:no moving shape of the scene")
@pytest.mark.parametrize(("symbol", "frames"), ATTACHMENTS.items())
def test_mode_switches(symbol, frames):
    komo = ry.KOMO(scene(), 2, 4, 2, True)
    komo.addControlObjective([], 2, 0.1)
    komo.addObjective([], ry.FS.accumulatedCollisions, [], ry.OT.eq)
    komo.addObjective([1.0], ry.FS.positionDiff, ["hand", frames[-1]], ry.OT.eq, [10.0])
    komo.addModeSwitch([1.0, -1.0], getattr(ry.SY, symbol), frames)
    sameBits(komo)


CONDITIONS = {
    "touch": ["hand", "box"],
    "above": ["box", "tray"],
    "inside": ["ball", "tray"],
    "oppose": ["hand", "palm", "box"],
    "restingOn": ["tray", "stick"],
    "poseEq": ["hand", "box"],
    "positionEq": ["hand", "box"],
    "stableRelPose": ["hand", "ball"],
    "stablePose": ["ball"],
    "downUp": ["hand"],
    "lift": ["hand"],
    "relPosY": ["hand", "box"],
    "contact": ["box", "ball"],
    "contactStick": ["box", "ball"],
    "contactComplementary": ["box", "ball"],
    "bounce": ["box", "ball"],
    "push": ["hand", "ball"],
    "topBoxGrasp": ["hand", "box"],
    "topBoxPlace": ["hand", "box", "tray"],
    "touchBoxNormalX": ["hand", "box"],
    "touchBoxNormalY": ["hand", "box"],
    "touchBoxNormalZ": ["hand", "box"],
    "boxGraspX": ["hand", "box", "palm"],
    "boxGraspY": ["hand", "box", "palm"],
    "boxGraspZ": ["hand", "box", "palm"],
    "dampMotion": ["hand"],
    "alignByInt": ["hand", "box"],
    "makeFree": ["box"],
    "forceBalance": ["ball"],
    "end": [],
}
ENTRIES = {**CONDITIONS, **ATTACHMENTS}


@pytest.mark.parametrize("symbol", [s.name for s in ry.SY])
def test_symbols_of_skeletons(symbol):
    S = ry.Skeleton()
    if symbol in ("identical", "pushAndPlace"):
        with pytest.raises(ry.Error, match=f"{symbol} is not supported; use"):
            S.addEntry([1.0], getattr(ry.SY, symbol), ["hand", "box"])
        return
    S.addEntry([1.0, 1.5], getattr(ry.SY, symbol), ENTRIES[symbol])
    S.addEntry([2.0], ry.SY.touch, ["hand", "ball"])
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ry.KinegraphWarning)
        sameBits(S.getKomo_path(scene(), 8, 0.3, -1.0, 0.01, -1.0), 30)
        if symbol != "bounce":  # speeds need three slices
            sameBits(S.getKomo_waypoints(scene(), 0.1, 0.1, -1.0), 30)
        sameBits(S.getKomo_finalSlice(scene(), 0.1, 0.1, -1.0), 30)


@pytest.mark.parametrize("symbol", [s.name for s in ry.SY if s.name not in ATTACHMENTS])
def test_conditions_are_not_mode_switches(symbol):
    komo = ry.KOMO(scene(), 2, 4, 2, False)
    with pytest.raises(
        ry.Error,
        match=f"addModeSwitch: {symbol} does not attach an object; expected one of stable, .*a skeleton accepts all modes",
    ):
        komo.addModeSwitch([1.0, -1.0], getattr(ry.SY, symbol), ["hand", "box"])


@pytest.mark.parametrize("kind", ["slide", "stick", "complementary", "bounce"])
@pytest.mark.parametrize("order", [0, 1, 2])
def test_contacts(kind, order):
    komo = ry.KOMO(scene(), 2, 3, order, False)
    if kind == "bounce" and order < 2:
        with pytest.raises(ry.Error, match="bounce of 'ball' off 'box': .*kOrder 2"):
            komo.addContact([1.0], "ball", "box", kind)
        return
    assert komo.addContact([1.0, 2.0], "ball", "box", kind, 0.7).startswith("poa_ball_box_")
    komo.addObjective([], ry.FS.totalForce, ["ball"], ry.OT.eq)
    if order == 2:
        komo.addObjective([], ry.FS.physics, ["ball"], ry.OT.eq)
    again = pickle.loads(pickle.dumps(komo))
    assert str(komo.getForceInteractions()) == str(again.getForceInteractions()) != "[]"
    sameBits(komo)


@pytest.mark.parametrize("free", [False, True])
def test_contact_force_frames(free):
    komo = ry.KOMO(scene(), 1, 2, 0, False)
    if free:
        komo.addContact_WithPoaFrame([], "ball", "box", 0.5, 0.5, 0.02)
    else:
        komo.addContactForceFrame([], "ball", "box", 0.5, 0.5)
    komo.addObjective([], ry.FS.totalForce, ["ball"], ry.OT.eq, [1.0])
    komo.addQuaternionNorms()
    sameBits(komo)


@pytest.mark.parametrize("kind", ["free", "transXYPhi", "transXY", "hingeZ", "quatBall", "none"])
@pytest.mark.parametrize("stable", [False, True])
def test_added_frames(kind, stable):
    komo = ry.KOMO(scene(), 2, 2, 1, False)
    komo.addFrameDof("seat", "tray", getattr(ry.JT, kind), stable, "box")
    komo.addRigidSwitch(1.0, ["seat", "box"])
    komo.addObjective([2.0], ry.FS.positionDiff, ["hand", "seat"], ry.OT.eq, [1.0])
    komo.addQuaternionNorms()
    sameBits(komo)


def test_a_changed_path_and_old_timings():
    komo = ry.KOMO()
    komo.setTiming(1.5, 4, 2.5, 2)
    komo.setConfig(scene(), True)
    komo.addControlObjective([], 2, 1.0)
    komo.addObjective([1.0, 1.5], ry.FS.angularVel, ["hand"], ry.OT.sos, [1.0], [0, 0, 0.3])
    komo.initRandom()
    sameBits(komo)


def height(frame):
    return frame.getPosition()[2]


def test_custom_features_pickle_if_python_can():
    komo = ry.KOMO(scene(), 1, 2, 1, False)
    komo.addObjective([1.0], height, ["hand"], ry.OT.eq, [1.0], [0.9])
    sameBits(komo)
    komo.addObjective([1.0], lambda frame: frame.getPosition()[0], ["hand"], ry.OT.eq)
    with pytest.raises(
        (AttributeError, pickle.PicklingError), match="test_custom_features_pickle_if_python_can.*lambda"
    ):
        pickle.dumps(komo)


def test_a_contact_of_no_kind_is_explained():
    komo = ry.KOMO(scene(), 1, 1, 0, False)
    with pytest.raises(ry.Error, match="no contact of kind 'stuck'.*stick"):
        komo.addContact([], "ball", "box", "stuck")
    with pytest.raises(ry.Error, match="coefficient of friction is -1"):
        komo.addContact([], "ball", "box", "stick", -1.0)
