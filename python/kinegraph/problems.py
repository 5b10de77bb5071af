"""Problems by name, to try solvers on: `make_NLP_Problem('Rosenbrock')`."""

from __future__ import annotations

from ._core import FS, KOMO, NLP, OT, ST, Config, makeTestProblem, testProblemNames
from .errors import NotFound
from .model_paths import raiPath
from .parameters import params_get


def _reach(obstacle: bool) -> NLP:
    """The Panda's gripper to a point in front of it, near to its home posture, within the joint limits."""
    C = Config()
    C.addFile(raiPath("scenarios/pandaSingle.g"))
    C.addFrame("goal").setPosition([0.3, 0.3, 1.0])
    if obstacle:
        C.addFrame("ball").setPosition([0.2, 0.25, 1.0]).setShape(ST.sphere, [0.1]).setColor([1, 0.5, 0])
    komo = KOMO(C, 1, 1, 0, False)
    komo.addObjective([], FS.qItself, [], OT.sos, [0.1], C.getJointState())
    komo.addObjective([], FS.jointLimits, [], OT.ineq)
    komo.addObjective([], FS.positionDiff, ["l_gripper", "goal"], OT.eq, [1.0])
    if obstacle:
        for link in ("l_palm", "l_gripper"):
            if C.getFrame(link, False) is not None and C.getFrame(link).getShapeType() != ST.marker:
                komo.addObjective([], FS.negDistance, [link, "ball"], OT.ineq)
    return komo.nlp()


_MOTIONS = {"IK": False, "IKobstacle": True}


def get_NLP_Problem_names() -> list[str]:
    """The names that make_NLP_Problem knows."""
    return [*testProblemNames(), *_MOTIONS]


def make_NLP_Problem(name: str, dim: int | None = None, seed: int = 0) -> NLP:
    """A problem by name.

    Args:
        name: One of get_NLP_Problem_names().
        dim: Number of variables, of spheres for SpherePacking; None: the parameter 'problem/dim', or 2 (50 spheres).
        seed: Of the problems that are drawn by chance: square, Rugged, LinearProgram.
    Raises:
        NotFound: There is no such name; the message lists those that there are.
    """
    if name in _MOTIONS:
        return _reach(_MOTIONS[name])
    if name not in testProblemNames():
        raise NotFound(f"there is no problem {name!r}; expected one of {', '.join(get_NLP_Problem_names())}")
    size = params_get().get("problem/dim", -1) if dim is None else dim
    return makeTestProblem(name, int(size), seed)
