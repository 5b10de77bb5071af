"""Named test problems for solvers: `make_NLP_Problem('Rosenbrock')`."""

from __future__ import annotations

from ._core import FS, JT, KOMO, NLP, OT, ST, SY, Config, makeTestProblem, testProblemNames
from .compatibility.parameters import params_get
from .errors import NotFound
from .model_paths import raiPath


def _panda() -> Config:
    C = Config()
    C.addFile(raiPath("scenarios/pandaSingle.g"))
    return C


def _reach(C: Config, target: str) -> KOMO:
    """Moves the Panda's gripper to a point, near its home configuration, within the joint limits."""
    komo = KOMO(C, 1, 1, 0, False)
    komo.addControlObjective([], 0, 0.1)
    komo.addObjective([], FS.jointLimits, [], OT.ineq)
    komo.addObjective([], FS.positionDiff, ["l_gripper", target], OT.eq, [10.0])
    return komo


def _ik(seed: int) -> KOMO:
    C = _panda()
    C.addFrame("target", "table").setRelativePosition([0.3, 0.2, 0.2]).setShape(ST.sphere, [0.02]).setColor([1, 1, 0])
    return _reach(C, "target")


def _ikObstacle(seed: int) -> KOMO:
    """Inverse kinematics to a point behind an upright capsule."""
    C = _panda()
    C.addFrame("dot", "table").setRelativePosition([0.2, 0.5, 0.3]).setShape(ST.sphere, [0.02])
    C.addFrame("obstacle", "table").setRelativePosition([0.1, 0.2, 0.5]).setShape(ST.capsule, [1, 0.1]).setColor([0.2])
    komo = _reach(C, "dot")
    for link in [*(f"l_panda_coll{i}" for i in range(3, 8)), "l_palm"]:
        komo.addObjective([1.0], FS.negDistance, [link, "obstacle"], OT.ineq, [10.0], [-0.001])
    return komo


def _pushToReach(seed: int) -> KOMO:
    """Four waypoints: go to a box, push it aside, grasp a stick behind it, touch a distant point with the stick."""
    C = _panda()
    box = C.addFrame("box", "table").setJoint(JT.rigid).setRelativePosition([0.4, 0, 0.25])
    box.setShape(ST.ssBox, [0.15, 0.4, 0.4, 0.005]).setMass(0.1).setContact(1)
    C.addFrame("dot", "table").setRelativePosition([-0.6, 0.6, 0.1]).setShape(ST.sphere, [0.02]).setColor([1, 1, 0.5])
    stick = C.addFrame("stick", "table").setJoint(JT.rigid).setRelativePosition([0.75, 0, 0.1])
    stick.setRelativeQuaternion([0.5**0.5, 0.5**0.5, 0, 0]).setShape(ST.capsule, [0.6, 0.02]).setColor(
        [0.6]
    ).setContact(1)
    gripper, palm, start = "l_gripper", "l_palm", "push_start"

    komo = KOMO(C, 4, 1, 1, False)
    komo.addControlObjective([], 0, 0.1)
    komo.addControlObjective([], 1, 0.1)
    komo.addObjective([], FS.jointLimits, [], OT.ineq)
    komo.addQuaternionNorms()
    komo.addQuaternionNorms()  # twice, as in the package robotic
    komo.addFrameDof("obj_trans", "table", JT.transXY, False, "box")
    komo.addRigidSwitch(1.0, ["obj_trans", "box"])

    # The box moves along the y axis of `push_start`, and the gripper is behind it, from 1 to 2.
    komo.addFrameDof(start, "box", JT.hingeZ, True)
    komo.addObjective([2.0], FS.AlignYWithDiff, [start, "box"], OT.eq, [1.0], [], 1)
    komo.addObjective([1.0], FS.negDistance, [gripper, "box"], OT.eq, [1.0], [-0.025])
    komo.addObjective([1.0], FS.positionRel, [gripper, start], OT.eq, [[1, 0, 0], [0, 0, 1]])
    komo.addObjective([1.0], FS.positionRel, [gripper, start], OT.ineq, [[0, 1, 0]], [0, -0.02, 0])
    komo.addObjective([1.0], FS.scalarProductYY, [gripper, start], OT.ineq, [-1.0], [0.2])
    komo.addObjective([1.0], FS.scalarProductYZ, [gripper, start], OT.ineq, [-1.0], [0.2])
    komo.addObjective([1.0], FS.vectorXDiff, [gripper, start], OT.eq, [1.0])
    komo.addObjective([2.0], FS.poseRel, [gripper, "box"], OT.eq, [10.0], [], 1)
    komo.addObjective([2.0], FS.negDistance, ["stick", "box"], OT.ineq, [10.0], [-0.02])
    komo.addObjective([3.0, -1.0], FS.qItself, ["obj_trans"], OT.eq, [10.0], [], 1)

    # The fingers are around the stick at 3, and nothing else of the arm touches the box.
    komo.addObjective([3.0], FS.positionRel, [gripper, "stick"], OT.eq, [[10, 0, 0], [0, 10, 0]])
    komo.addObjective([3.0], FS.positionRel, [gripper, "stick"], OT.ineq, [0, 0, 10], [0, 0, 0.28])
    komo.addObjective([3.0], FS.positionRel, [gripper, "stick"], OT.ineq, [0, 0, -10], [0, 0, -0.28])
    komo.addObjective([2.8, 3.0], FS.scalarProductXZ, [gripper, "stick"], OT.eq, [1.0])
    komo.addObjective([2.7, 3.0], FS.negDistance, [palm, "stick"], OT.ineq, [10.0], [-0.001])
    for link in [*(f"l_panda_coll{i}" for i in range(1, 8)), palm]:
        komo.addObjective([2.0, 4.0], FS.negDistance, [link, "box"], OT.ineq, [10.0], [-0.02])
    komo.addModeSwitch([3.0, -1.0], SY.stable, [gripper, "stick"], True)

    komo.addObjective([4.0], FS.negDistance, ["stick", "dot"], OT.eq, [10.0])
    komo.addObjective([4.0], FS.negDistance, ["stick", "table"], OT.ineq, [10.0], [-0.01])
    komo.addObjective([4.0], FS.negDistance, [palm, "table"], OT.ineq, [10.0], [-0.01])
    return komo


def _supports(seed: int) -> list[str]:
    """Samples the sphere's supports: for seed 0 the first sample of the package robotic, otherwise each with
    probability 1/2."""
    if seed == 0:
        return ["box", "l_finger", "r_finger"]
    import random  # not at import: it takes milliseconds, and is rarely needed

    rng = random.Random(seed)
    while True:
        chosen = [name for name in ("box", "wall", "l_finger", "r_finger") if rng.random() < 0.5]
        if chosen:
            return chosen


def _stableSphere(seed: int) -> KOMO:
    """A sphere held in the air by contacts with a sample of a box, a wall and two movable balls."""
    C = Config()
    for side in "lr":
        C.addFile(raiPath("scenarios/ballFinger.g"), f"{side}_")
        C.getFrame(f"{side}_finger").setShape(ST.sphere, [0.05])
    C.addFrame("world")
    table = C.addFrame("table", "world").setRelativePosition([0, 0, 0.1]).setShape(ST.ssBox, [1, 1, 0.1, 0.01])
    wall = C.addFrame("wall", "table").setRelativePosition([-0.45, 0, 0.3]).setShape(ST.ssBox, [0.1, 1, 0.5, 0.01])
    box = C.addFrame("box", "table").setRelativePosition([0.05, -0.35, 0.25]).setShape(ST.ssBox, [0.9, 0.3, 0.4, 0.01])
    for frame in (table, wall, box):
        frame.setColor([0.8]).setContact(1)
    C.addFrame("obj", "world", "joint: trans3, limits: [-.5, -.5, 0, .5, .5, 1], q: [0, 0, .3], sampleUniform: 1")
    C.getFrame("obj").setShape(ST.sphere, [0.1]).setColor([1, 0.5, 0, 0.5]).setMass(0.2).setContact(1)
    for side in "lr":
        for axis in "XYZ":
            C.getFrame(f"{side}_joint{axis}").setJoint(getattr(JT, f"trans{axis}"), [-0.5, 0.5])

    komo = KOMO(C, 1, 1, 0, True)
    komo.addControlObjective([], 0, 0.1)
    komo.addObjective([], FS.totalForce, ["obj"], OT.eq, [10.0])
    komo.addObjective([], FS.accumulatedCollisions, [], OT.eq, [10.0])
    for name in _supports(seed):
        komo.addContact([], "obj", name, "stick", 0.75)
    return komo


_MOTIONS = {
    "IK": _ik,
    "IKobstacle": _ikObstacle,
    "PushToReach": _pushToReach,
    "StableSphere": _stableSphere,
}


def get_NLP_Problem_names() -> list[str]:
    """Returns the names of make_NLP_Problem."""
    return [*testProblemNames(), *_MOTIONS]


def make_NLP_Problem(problem_name: str, dim: int | None = None, seed: int = 0) -> NLP:
    """Creates a problem by name.

    Args:
        problem_name: One of get_NLP_Problem_names().
        dim: Number of variables, or of spheres for SpherePacking; None: the parameter 'problem/dim', or 2 (50 spheres).
        seed: Seed of random problems: square, Rugged, LinearProgram, StableSphere (its supports).
    Returns:
        The problem.
    Raises:
        NotFound: There is no such name; the message lists all names.
    """
    if problem_name in _MOTIONS:
        return _MOTIONS[problem_name](seed).nlp()
    if problem_name not in testProblemNames():
        import difflib  # not at import: it takes milliseconds, and is rarely needed

        near = difflib.get_close_matches(problem_name, get_NLP_Problem_names())
        hint = f"; similar names: {', '.join(near)}" if near else ""
        raise NotFound(
            f"there is no problem {problem_name!r}; expected one of {', '.join(get_NLP_Problem_names())}{hint}"
        )
    size = params_get().get("problem/dim", -1) if dim is None else dim
    return makeTestProblem(problem_name, int(size), seed)
