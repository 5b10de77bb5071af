"""Logic-geometric programs: a search in logic proposes plans, a motion problem says whether bodies can carry them out."""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from ._core import (
    FS,
    JT,
    KOMO,
    OT,
    Config,
    Domain,
    LogicProblem,
    NLP_Solver,
    PlanSearch,
    SolverReturn,
    parseText,
    sceneFacts,
)
from .errors import ArgumentError, FileError, ParseError
from .manipulation import KOMO_ManipulationHelper, missed

Action = list[str]

_STEPS = 30  # slices per action
_STARTS = 4  # of a waypoint problem before another plan is tried
_PLANS_PER_LEVEL = 8
_NOISE = 0.3
_MOTION_STARTS = 3
_MARGIN = 0.02  # m: how far inside of a box a gripper is


class LGP_TAMP_Abstraction:
    """What LGP_Tool asks of a domain. Subclass it, or default_LGP_TAMP_Abstraction, for actions of your own."""

    def __init__(self, C: Config) -> None:
        """Makes an abstraction of a scene, without actions.

        Args:
            C: The scene.
        """
        self.C = C
        self.explicitCollisions: list[str] = []

    def getNewActionSequence(self) -> list[Action] | None:
        """The next plan in logic.

        Returns:
            A list of actions, each a list of words; None if there is no further one.
        """
        return None

    def forbidBeginning(self, plan: list[Action]) -> None:
        """No further plan shall begin like that: it was found infeasible. An abstraction may ignore it.

        Args:
            plan: The first actions.
        """

    def setup_sequence(self, C: Config, K: int) -> KOMO:
        """The waypoint problem of a plan, without what the actions ask.

        Args:
            C: The scene.
            K: The number of actions.
        Returns:
            A KOMO with a slice per action.
        """
        komo = KOMO(C, K, 1, 1, False)
        komo.addControlObjective([], 1, 1e-2)
        komo.addQuaternionNorms()
        return komo

    def setup_motion(self, C: Config, K: int) -> KOMO:
        """The motion problem of a plan, without what the actions ask.

        Args:
            C: The scene.
            K: The number of actions.
        Returns:
            A KOMO with 30 slices per action, free of collisions, that ends at rest.
        """
        helper = KOMO_ManipulationHelper()
        helper.setup_motion(C, K, _STEPS)
        return helper.komo

    def add_action_constraints(self, komo: KOMO, time: float, prev_action: Action, action: Action) -> None:
        """Adds what an action asks of the waypoints.

        Args:
            komo: The problem.
            time: When the action is done, in phases.
            prev_action: The action before it, [] if there is none.
            action: The action.
        Raises:
            ArgumentError: The action is not known.
        """
        raise ArgumentError(f"no constraints are known for action {action}; override add_action_constraints")

    def add_action_constraints_motion(self, komo: KOMO, time: float, prev_action: Action, action: Action) -> None:
        """Adds what an action asks of the motion; by default what it asks of the waypoints.

        Args:
            komo: The problem.
            time: When the action is done, in phases.
            prev_action: The action before it, [] if there is none.
            action: The action.
        Raises:
            ArgumentError: The action is not known.
        """
        self.add_action_constraints(komo, time, prev_action, action)

    def add_all(self, komo: KOMO, plan: list[Action], motion: bool) -> None:
        """Adds what the actions of a plan ask, then that the explicit pairs do not collide.

        Args:
            komo: The problem.
            plan: The actions.
            motion: Of the motion; else of the waypoints.
        Raises:
            ArgumentError: An action is not known.
        """
        add = self.add_action_constraints_motion if motion else self.add_action_constraints
        for i, action in enumerate(plan):
            add(komo, float(i + 1), plan[i - 1] if i else [], action)
        for i in range(0, len(self.explicitCollisions), 2):
            komo.addObjective([], FS.distance, self.explicitCollisions[i : i + 2], OT.ineq, [1e1])


class default_LGP_TAMP_Abstraction(LGP_TAMP_Abstraction):
    """Actions from a .lgp file and the .fol file that it names: pick_touch, pick_box, handover, place_straightOn,
    place_box, poseEq, gripper_push, end_push. Actions of other names need a subclass."""

    def __init__(self, C: Config, lgp_file: str) -> None:
        """Reads the files, and what the scene says in logic.

        Args:
            C: The scene.
            lgp_file: Name of the .lgp file: `fol: <file>`, `terminal: "(on tray cup)"`, `coll: [a b]`.
        Raises:
            FileError: A file cannot be read.
            ParseError: A file is wrong, or the goal has an unknown word.
        """
        super().__init__(C)
        try:
            with open(lgp_file, encoding="utf-8") as file:
                text = file.read()
        except OSError as error:
            raise FileError(f"default_LGP_TAMP_Abstraction: cannot read '{lgp_file}': {error.strerror}") from None
        entries = parseText(text, os.fspath(lgp_file))
        for key in ("fol", "terminal"):
            if not isinstance(entries.get(key), str):
                raise ParseError(
                    f'{lgp_file}:1:1: there is no `{key}:`; expected fol: <file> and terminal: "(on tray cup)"'
                )
        folder = os.path.dirname(os.path.abspath(lgp_file))
        self.domain = Domain.fromFol(os.path.join(folder, entries["fol"].strip("<>")))
        self.explicitCollisions = _pairs(C, entries.get("coll", []), lgp_file)
        self.search = PlanSearch(LogicProblem(self.domain, " ".join(sceneFacts(C)), entries["terminal"]))
        if self.search.unreachable:
            odd = "; ".join(self.search.oddities)
            raise ParseError(f"{lgp_file}: the goal cannot be reached: {odd}")

    def getNewActionSequence(self) -> list[Action] | None:
        """The next plan in logic, the shortest first.

        Returns:
            A list of actions, each a list of words; None if there is no further one.
        """
        return self.search.next()

    def forbidBeginning(self, plan: list[Action]) -> None:
        """No further plan begins like that.

        Args:
            plan: The first actions.
        """
        self.search.forbidBeginning(plan)

    def setup_sequence(self, C: Config, K: int) -> KOMO:
        """The waypoint problem of a plan, without what the actions ask.

        Args:
            C: The scene.
            K: The number of actions.
        Returns:
            A KOMO with a slice per action.
        """
        komo = super().setup_sequence(C, K)
        self._held: dict[str, str] = {}
        self._count = K
        return komo

    def setup_motion(self, C: Config, K: int) -> KOMO:
        """The motion problem of a plan, without what the actions ask.

        Args:
            C: The scene.
            K: The number of actions.
        Returns:
            A KOMO with 30 slices per action, free of collisions, that ends at rest.
        """
        komo = super().setup_motion(C, K)
        self._held = {}
        self._count = K
        return komo

    def add_action_constraints(self, komo: KOMO, time: float, prev_action: Action, action: Action) -> None:
        """Adds what an action asks of the waypoints.

        Args:
            komo: The problem, of setup_sequence.
            time: When the action is done, in phases.
            prev_action: The action before it, [] if there is none.
            action: The action: its name, and its arguments as in the .fol file.
        Raises:
            ArgumentError: The action is not known.
        """
        helper = KOMO_ManipulationHelper()
        helper.komo = komo
        rule = _ACTIONS.get(action[0])
        if rule is None:
            known = ", ".join(_ACTIONS)
            raise ArgumentError(f"unknown action '{action[0]}'; known are {known}; others need a subclass")
        rule(self, helper, time, action)

    def switch(self, m: KOMO_ManipulationHelper, time: float, frame: str, obj: str) -> None:
        """From a time on an object sits at a frame; it does not jump there.

        Args:
            m: A helper on the problem.
            time: In phases.
            frame: Name of the frame.
            obj: Name of the object.
        Raises:
            FrameNotFound: A name that is not in the scene.
        """
        held = self._held.get(obj)
        m.komo.addRigidSwitch(time, [frame, obj], False)
        frames, feature = ([obj, held], FS.poseRel) if held else ([obj], FS.pose)
        m.komo.addObjective([time], feature, frames, OT.eq, [1e1], [], 1)
        steps = self.steps(m.komo)
        if steps > 1 and time < self._count:  # accelerations tell of two velocities
            after = time + 1 / steps
            m.komo.addObjective([after], FS.linangVel, [obj], OT.eq, [1e0], [], 2)
        self._held[obj] = frame

    def steps(self, komo: KOMO) -> int:
        """Slices per action.

        Args:
            komo: The problem that was set up last.
        Returns:
            1 for waypoints.
        """
        return int(komo.getT()) // self._count

    def is_last(self, time: float) -> bool:
        """Whether the plan ends at a time.

        Args:
            time: In phases.
        Returns:
            True at the end of the problem that was set up last.
        """
        return round(time) >= self._count


def _pairs(C: Config, names: Any, where: str) -> list[str]:
    known = C.getFrameNames()
    for name in names:
        if name not in known:
            C.getFrame(name)  # raises, with names that are near
    if len(names) % 2:
        raise ParseError(f"{where}: coll has {len(names)} names; expected pairs")
    return list(names)


def _pick_frame(
    tamp: default_LGP_TAMP_Abstraction, m: KOMO_ManipulationHelper, time: float, hand: str, obj: str
) -> None:
    name = f"pickPose_{hand}_{obj}_{round(time)}"
    m.add_stable_frame(JT.free, hand, name)
    tamp.switch(m, time, name, obj)


def _pick_touch(tamp: default_LGP_TAMP_Abstraction, m: KOMO_ManipulationHelper, time: float, action: Action) -> None:
    _, obj, _, hand = action
    _pick_frame(tamp, m, time, hand, obj)
    m.komo.addObjective([time], FS.distance, [obj, hand], OT.eq, [1e2])


def _pick_box(tamp: default_LGP_TAMP_Abstraction, m: KOMO_ManipulationHelper, time: float, action: Action) -> None:
    _, obj, _, hand = action
    _pick_frame(tamp, m, time, hand, obj)
    frames, inside = [hand, obj], 0.5 * np.array(tamp.C.getFrame(obj).getSize()[:3]) - _MARGIN
    rows = np.array([[1e1, 0, 0], [0, 0, 1e1]])
    m.komo.addObjective([time], FS.positionRel, frames, OT.eq, [0, 1e1, 0])
    m.komo.addObjective([time], FS.positionRel, frames, OT.ineq, rows, inside)
    m.komo.addObjective([time], FS.positionRel, frames, OT.ineq, -rows, -inside)
    for product in (FS.scalarProductXX, FS.scalarProductXZ):
        m.komo.addObjective([time - 0.2, time], product, frames, OT.eq, [1e0])
    m.komo.addObjective([time - 0.3, time], FS.distance, [_palm(hand), obj], OT.ineq, [1e1], [-0.001])
    m.komo.addObjective([time], FS.distance, [obj, hand], OT.ineq, [-1e1])


def _palm(hand: str) -> str:
    return hand.removesuffix("gripper") + "palm"


def _place_straight_on(
    tamp: default_LGP_TAMP_Abstraction, m: KOMO_ManipulationHelper, time: float, action: Action
) -> None:
    _, obj, _, to = action
    name = f"placePose_{to}_{obj}_{round(time)}"
    m.add_place_frame(to, obj, name)
    tamp.switch(m, time, name, obj)


def _place_box(tamp: default_LGP_TAMP_Abstraction, m: KOMO_ManipulationHelper, time: float, action: Action) -> None:
    _, obj, hand, to = action
    if not tamp.is_last(time):
        name = f"placePose_{to}_{obj}_{round(time)}"
        m.add_stable_frame(JT.free, to, name)
        tamp.switch(m, time, name, obj)
    m.place_box(time, obj, to, _palm(hand), "x")
    m.komo.addObjective([time], FS.distance, [obj, hand], OT.ineq, [-1e1])


def _pose_eq(tamp: default_LGP_TAMP_Abstraction, m: KOMO_ManipulationHelper, time: float, action: Action) -> None:
    m.komo.addObjective([time], FS.poseDiff, action[1:3], OT.eq, [1e1])


def _push(tamp: default_LGP_TAMP_Abstraction, m: KOMO_ManipulationHelper, time: float, action: Action) -> None:
    _, obj, floor, hand = action
    if not tamp.is_last(time):
        name = f"pushPose_{hand}_{obj}_{round(time)}"
        m.add_stable_frame(JT.free, hand, name, obj)
        tamp.switch(m, time, name, obj)
        if tamp.steps(m.komo) > 1:
            m.komo.addObjective([time], FS.poseDiff, [name, obj], OT.eq, [1e0])
    else:
        return  # it begins, and nothing says where to
    m.straight_push([time, time + 1], obj, hand, floor, 1.0, f"_straight_pushStart_{hand}_{obj}_{round(time)}")


def _end_push(tamp: default_LGP_TAMP_Abstraction, m: KOMO_ManipulationHelper, time: float, action: Action) -> None:
    if not tamp.is_last(time):
        raise ArgumentError("end_push is the last action of a plan; another one follows")
    _, _, obj, _, to = action
    m.place_box(time, obj, to, "", "z")


_ACTIONS: dict[str, Callable[[default_LGP_TAMP_Abstraction, KOMO_ManipulationHelper, float, Action], None]] = {
    "pick_touch": _pick_touch,
    "pick_box": _pick_box,
    "handover": lambda tamp, m, time, a: _pick_touch(tamp, m, time, [a[0], a[1], a[2], a[3]]),
    "place_straightOn": _place_straight_on,
    "place_box": _place_box,
    "poseEq": _pose_eq,
    "gripper_push": _push,
    "end_push": _end_push,
}


class LGP_Tool:
    """Finds plans that bodies can carry out: each plan of the abstraction becomes a waypoint problem. Beginnings that
    fail from all starts are not tried again; effort is counted in solves.

        tamp = ry.default_LGP_TAMP_Abstraction(C, "problem.lgp")
        lgp = ry.LGP_Tool(C, tamp)
        lgp.solve()
        print(lgp.getSolvedPlan())
        lgp.solveFullMotion()
    """

    _solver: type[NLP_Solver] = NLP_Solver  # robotic has its own

    def __init__(self, C: Config, tamp: LGP_TAMP_Abstraction, translator: object = None) -> None:
        """Makes a tool; nothing is searched yet.

        Args:
            C: The scene.
            tamp: What is asked for plans, and for what their actions ask.
            translator: Of older scripts; the abstraction does its work.
        """
        self.C, self.tamp = C, tamp
        self.status = "not started"
        self.message = ""
        self.solves = 0
        self._plan: list[Action] | None = None
        self._komo: KOMO | None = None
        self._x: np.ndarray | None = None
        self._known: dict[tuple[tuple[str, ...], ...], bool] = {}
        self._causes: dict[str, int] = {}

    def solve(self, verbose: int = 1, maxSolves: int = 2000) -> bool:
        """Searches until a new plan with feasible waypoints is found. Repeated calls give further plans.

        Args:
            verbose: 1: a line per plan that was tried; 0: nothing.
            maxSolves: Effort: waypoint problems that are solved, at most.
        Returns:
            True if there is one; else `status` is 'proved impossible' (the logic has no plan at all) or 'not found', and
            `message` says why plans failed.
        """
        budget = self.solves + maxSolves
        while self.solves < budget:
            plan = self.tamp.getNewActionSequence()
            if plan is None:
                break
            failed = self._failing(plan)
            if verbose > 0:
                print(f"-- {'feasible' if failed is None else 'infeasible'}: {_text(plan)}")
            if failed is None:
                self._plan, self.status, self.message = plan, "solved", ""
                return True
            self.tamp.forbidBeginning(plan[:failed])
        self.status = "not found" if self._causes or self.solves >= budget else "proved impossible"
        causes = sorted(self._causes.items(), key=lambda c: -c[1])
        self.message = "; ".join(f"{cause} ({count} plans)" for cause, count in causes[:5]) or "no plan in logic"
        return False

    def getSolvedPlan(self) -> list[Action]:
        """The plan that was found last.

        Returns:
            A list of actions, each a list of words.
        Raises:
            ArgumentError: Nothing was found yet.
        """
        return self._solved()[0]

    def getSolvedKOMO(self) -> KOMO:
        """The waypoint problem of the plan that was found last, at its solution.

        Returns:
            A KOMO with a slice per action.
        Raises:
            ArgumentError: Nothing was found yet.
        """
        return self._solved()[1]

    def get_piecewiseMotionProblem(self, phase: int, fixEnd: bool = True) -> KOMO:
        """The motion of one action between its waypoints, with attachments as they are then.

        Args:
            phase: 0: the first action.
            fixEnd: It ends exactly at the waypoint.
        Returns:
            A KOMO with 30 slices that starts on the straight way.
        Raises:
            ArgumentError: Nothing was found yet, or there is no such action.
        """
        plan, waypoints = self._solved()
        if not 0 <= phase < len(plan):
            raise ArgumentError(f"get_piecewiseMotionProblem: phase is {phase}; the plan has {len(plan)} actions")
        C, _, q1 = waypoints.getSubProblem(phase)
        helper = KOMO_ManipulationHelper()
        helper.setup_motion(C, 1, _STEPS, 1e-2)
        helper.komo.initWithWaypoints([q1], 1, True, 0.5)
        if fixEnd:
            helper.komo.addObjective([1.0], FS.jointState, [], OT.eq, [1e0], q1)
        return helper.komo

    def get_fullMotionProblem(self, initWithWaypoints: bool = True) -> KOMO:
        """The motion over all actions of the plan, 30 slices each.

        Args:
            initWithWaypoints: It starts at the waypoints; else where the scene is.
        Returns:
            A KOMO.
        Raises:
            ArgumentError: Nothing was found yet.
        """
        plan, waypoints = self._solved()
        komo = self.tamp.setup_motion(self.C, len(plan))
        self.tamp.add_all(komo, plan, motion=True)
        if initWithWaypoints and self._x is not None:
            komo.initWithWaypoints(list(waypoints.getPath()), 1, True, 0.0)
            shared = len(self._x) - sum(len(q) for q in waypoints.getPath_qAll())
            x = np.concatenate([self._x[:shared], *komo.getPath_qAll()])
            nlp = komo.nlp()
            if len(x) == nlp.getDimension():
                nlp.evaluate(x)
        return komo

    def solvePiecewiseMotions(self, verbose: int = 1) -> list[SolverReturn]:
        """Solves the motions of all actions, one after the other.

        Args:
            verbose: 1: a line per action; 0: nothing.
        Returns:
            How each ended. The paths are in `paths`, shape (30, n) each, rad or m.
        Raises:
            ArgumentError: Nothing was found yet.
        """
        self.paths, results = [], []
        for phase in range(len(self._solved()[0])):
            komo = self.get_piecewiseMotionProblem(phase, True)
            results.append(self._solver(komo.nlp(), verbose=0).solve(0))
            self.paths.append(komo.getPath())
            if verbose > 0:
                print(f"-- {_text([self._solved()[0][phase]])}: {results[-1].message}")
        return results

    def solveFullMotion(self, verbose: int = 1) -> SolverReturn:
        """Solves the motion over all actions, from the waypoints.

        Args:
            verbose: 1: a line says how it ended; 0: nothing.
        Returns:
            How it ended. The path is in `path`, shape (T, n), rad or m.
        Raises:
            ArgumentError: Nothing was found yet.
        """
        rng = np.random.default_rng(0)
        for start in range(_MOTION_STARTS):
            komo = self.get_fullMotionProblem(True)
            helper = KOMO_ManipulationHelper()
            helper.komo = komo
            solver = self._solver(komo.nlp(), verbose=0)
            solver.setInitialization(helper.x + 0.02 * start * rng.standard_normal(len(helper.x)))
            result = solver.solve(0)
            if result.feasible:
                break
        self.path, self.motion = komo.getPath(), komo
        if verbose > 0:
            print(f"-- full motion: {result.message}")
        return result

    def view_solved(self, pause: bool = True) -> int:
        """Shows the waypoints.

        Args:
            pause: Waits for a key.
        Returns:
            The key, or 0.
        Raises:
            ArgumentError: Nothing was found yet.
        """
        return int(self._solved()[1].view(pause, _text(self._solved()[0])) or 0)

    def view_close(self) -> None:
        """Closes the viewer of the waypoints."""
        if self._komo is not None:
            self._komo.view_close()

    def _solved(self) -> tuple[list[Action], KOMO]:
        if self._plan is None or self._komo is None:
            raise ArgumentError("LGP_Tool: no plan was found yet; call solve")
        return self._plan, self._komo

    def _failing(self, plan: list[Action]) -> int | None:
        """How many of the first actions cannot be carried out together; None if all can."""
        if self._feasible(plan):
            return None
        for count in range(1, len(plan)):
            if not self._feasible(plan[:count]):
                return count
        return len(plan)

    def _feasible(self, plan: list[Action]) -> bool:
        key = tuple(map(tuple, plan))
        if key not in self._known:
            self._known[key] = self._solve_waypoints(plan)
        return self._known[key]

    def _solve_waypoints(self, plan: list[Action]) -> bool:
        komo = self.tamp.setup_sequence(self.C, len(plan))
        self.tamp.add_all(komo, plan, motion=False)
        nlp = komo.nlp()
        rng = np.random.default_rng(0)
        helper = KOMO_ManipulationHelper()
        helper.komo = komo
        x0 = helper.x
        lower, upper = np.asarray(nlp.getBounds())
        bounded = lower < upper
        for start in range(_STARTS):
            x = x0 + _NOISE * start * rng.standard_normal(len(x0))
            x[bounded] = np.clip(x, lower, upper)[bounded]
            solver = self._solver(nlp, verbose=0)
            solver.setInitialization(x)
            result = solver.solve(0)
            self.solves += 1
            if result.feasible:
                self._komo, self._x = komo, np.array(result.x)
                return True
        said = f"{_text(plan[-1:])}: {missed(komo) or result.message}"
        self._causes[said] = self._causes.get(said, 0) + 1
        return False


def _text(plan: Sequence[Sequence[str]]) -> str:
    return " ".join(f"({' '.join(action)})" for action in plan)


default_TAMP_Provider = default_LGP_TAMP_Abstraction  # as scripts of earlier years call it


class default_Logic2KOMO_Translator:
    """Of older scripts: what an action asks is said by default_LGP_TAMP_Abstraction."""
