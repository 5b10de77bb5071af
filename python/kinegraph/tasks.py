"""From a goal to a motion: which object, with which hand, how grasped, where put down, along which path."""

from __future__ import annotations

import itertools
import time as clock
from collections import Counter
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from ._core import JT, KOMO, Config, Domain, LogicProblem, NLP_Solver, PlanSearch, RRT_PathFinder, sceneFacts, solveIk
from .errors import ArgumentError
from .manipulation import KOMO_ManipulationHelper, missed
from .task_actions import DEFAULT_RULES, Action, TaskRule, TaskWaypoints, allVariants, defaultDomain, sceneWords
from .task_check import checkTaskPlan, overlapAlong
from .task_proofs import Impossible, impossibleActions

_STARTS = 3  # of a waypoint problem, for each choice of variants
_CHOICES = 6  # of variants, at most
_PENETRATION = 1e-3  # m
_LIFT = 0.2  # m: how far above its ends a motion is led where the straight one collides
_MOTION_STARTS = 3  # sets of waypoints whose motions are tried


@dataclass
class Branch:
    """A sequence of actions that was tried, and why it was given up; '' where it was not."""

    actions: list[Action]
    why: str
    proved: bool = False


@dataclass
class TaskPlan:
    """What planTask found, or why it found nothing.

    status: 'solved', 'proved impossible' (no motion can do it; says why) or 'not found' (within the effort).
    actions: each a list of words. waypoints: q after each action, shape (K, n). path: shape (T, n), rad or m, with
    `segments[i]` the rows of action i. causes: why branches were given up, the most frequent first. tree: all branches.
    """

    status: str
    message: str
    actions: list[Action] = field(default_factory=list)
    waypoints: np.ndarray | None = None
    path: np.ndarray | None = None
    segments: list[slice] = field(default_factory=list)
    causes: list[tuple[str, int]] = field(default_factory=list)
    tree: list[Branch] = field(default_factory=list)
    violations: list[str] = field(default_factory=list)
    evaluations: int = 0
    expansions: int = 0
    attachments: list[tuple[str, str]] = field(default_factory=list)
    scenes: list[Config] = field(default_factory=list)
    goal: list[str] = field(default_factory=list)

    @property
    def feasible(self) -> bool:
        """Whether there is a plan whose motion passed the checker."""
        return self.status == "solved"

    def __str__(self) -> str:
        lines = [f"{self.status}: {self.message}"]
        lines += [f"  {i + 1}. ({' '.join(action)})" for i, action in enumerate(self.actions)]
        lines += [f"  {count} x {cause}" for cause, count in self.causes[:8]]
        return "\n".join(lines)

    def why(self) -> str:
        """Why there is no plan, or what stood in the way of others: causes, the most frequent first.

        Returns:
            A line per cause.
        """
        return "\n".join(f"{cause} ({count} branches)" for cause, count in self.causes) or self.message

    def play(self, C: Config, pause: bool = False) -> None:
        """Shows the motion of each action in the viewer, with what is held moving along.

        Args:
            C: A scene whose viewer shows it; it ends as after the plan.
            pause: Waits for a key before each action.
        Raises:
            ArgumentError: There is no motion.
        """
        if self.path is None:
            raise ArgumentError(f"play: there is no motion; {self.message}")
        for action, rows, scene in zip(self.actions, self.segments, self.scenes, strict=True):
            if pause:
                C.view(True, f"({' '.join(action)})")
            for q in self.path[rows]:
                scene.setJointState(q)
                for frame in C.getFrames():
                    if frame.getParent() is None or frame.getJointType() == JT.rigid:
                        frame.setPose(scene.getFrame(frame.name).getPose())
                C.setJointState(q)
                C.view(False, f"({' '.join(action)})")


class _Task:
    """One call of planTask."""

    def __init__(
        self, C: Config, goal: str, domain: Domain | None, rules: dict[str, TaskRule] | None, **limits: Any
    ) -> None:
        self.C = C.copy()
        self.rules = {**DEFAULT_RULES, **(rules or {})}
        self.domain = defaultDomain() if domain is None else domain
        self.limits = limits
        self.start = sceneWords(self.C, sceneFacts(self.C))
        self.problem = LogicProblem(self.domain, " ".join(self.start), goal)
        self.search = PlanSearch(self.problem)
        missing = sorted({a[0] for a in self.search.actions} - set(self.rules))
        if missing:
            raise ArgumentError(
                f"planTask: nothing is known of what the actions {', '.join(missing)} ask; give them in `rules`"
            )
        self.tree: list[Branch] = []
        self.causes: Counter[str] = Counter()
        self.evaluations = 0
        self.guessed = False  # is anything forbidden that was not proved?
        self.known: dict[tuple[Any, ...], bool] = {}
        self.deadline = None if limits["seconds"] is None else clock.monotonic() + limits["seconds"]

    def run(self) -> TaskPlan:
        if self.search.unreachable:
            return self._end("proved impossible", "; ".join(self.search.oddities))
        proofs = impossibleActions(self.C, self.search.actions) if self.rules["pick"] is DEFAULT_RULES["pick"] else []
        for proof in proofs:
            self.search.forbid(proof.action, proof.facts)
        while True:
            actions = self.search.next()
            if actions is None:
                return self._nothing(proofs)
            if not actions:
                return self._end("solved", "the goal holds already")
            plan = self._try(actions)
            if plan is not None:
                return plan
            if self.evaluations >= self.limits["evaluations"] or self._late():
                return self._end("not found", f"no plan within the effort; {self._first_cause()}")

    def _late(self) -> bool:
        return self.deadline is not None and clock.monotonic() > self.deadline

    def _first_cause(self) -> str:
        return self.causes.most_common(1)[0][0] if self.causes else "nothing was tried"

    def _nothing(self, proofs: list[Impossible]) -> TaskPlan:
        if self.search.status == "limit":
            return self._end("not found", "the search in logic is too large")
        if self.guessed:
            return self._end("not found", f"all plans in logic fail; {self._first_cause()}")
        for proof in proofs:
            self.causes[proof.why] += 1
        if not proofs or not self._possible_without(proofs):
            return self._end("proved impossible", self._contradiction())
        return self._end("proved impossible", self._needed(proofs))

    def _possible_without(self, proofs: list[Impossible]) -> bool:
        return PlanSearch(self.problem).next() is not None

    def _needed(self, proofs: list[Impossible]) -> str:
        """The proofs that matter: with these alone there is no plan; those that can be left out one by one are."""
        whys = list(dict.fromkeys(proof.why for proof in proofs))
        for why in list(whys):
            rest = [w for w in whys if w != why]
            search = PlanSearch(self.problem)
            for proof in proofs:
                if proof.why in rest:
                    search.forbid(proof.action, proof.facts)
            if search.next() is None:
                whys = rest
        return "; ".join(whys)

    def _contradiction(self) -> str:
        """The fewest literals of the goal that no sequence of actions reaches together."""
        goal = self.problem.goal
        for literal in list(goal):
            rest = [g for g in goal if g != literal]
            if rest and PlanSearch(LogicProblem(self.domain, " ".join(self.start), " ".join(rest))).next() is None:
                goal = rest
        return f"no sequence of actions reaches {' and '.join(goal)}" + (" together" if len(goal) > 1 else "")

    def _end(self, status: str, message: str, **more: Any) -> TaskPlan:
        return TaskPlan(
            status,
            message,
            causes=self.causes.most_common(),
            tree=self.tree,
            evaluations=self.evaluations,
            expansions=self.search.expansions,
            goal=self.problem.goal,
            **more,
        )

    # --- geometry ----------------------------------------------------------------------------------------------------

    def _try(self, actions: list[Action]) -> TaskPlan | None:
        """TaskWaypoints, then motions; forbids what fails."""
        why = ""
        for found in range(_MOTION_STARTS):
            waypoints = self._waypoints(actions, found)
            if waypoints is None:
                break
            plan = self._motions(waypoints)
            if isinstance(plan, TaskPlan):
                self.tree.append(Branch(actions, ""))
                return plan
            why = plan
        if why:
            self._give_up(actions, why)
            self.search.forbidBeginning(actions)
        else:
            self._forbid_failing(actions)
        return None

    def _give_up(self, actions: list[Action], why: str) -> None:
        self.guessed = True
        self.causes[why] += 1
        self.tree.append(Branch(actions, why))

    def _solve(self, C: Config, actions: list[Action], seed: int, starts: int) -> tuple[TaskWaypoints | None, str]:
        """TaskWaypoints that satisfy all that the actions ask, or None and why not."""
        said = ""
        rng = np.random.default_rng([self.limits["seed"], seed, len(actions)])
        for number, variants in enumerate(allVariants(C, actions, self.rules)):
            if number >= _CHOICES or self._late():
                break
            for start in range(starts):
                waypoints = TaskWaypoints(C, actions, variants, self.rules)
                solver = NLP_Solver(waypoints.komo.nlp(), verbose=0)
                solver.setInitialization(waypoints.start(None if start == seed == 0 else rng))
                result = solver.solve(0)
                self.evaluations += result.evals
                if result.feasible:
                    return waypoints, ""
                said = said or _cause(waypoints.komo, actions)
        return None, said or f"{_text(actions[-1:])}: the hand cannot hold it"

    def _waypoints(self, actions: list[Action], seed: int) -> TaskWaypoints | None:
        waypoints, _ = self._solve(self.C, actions, seed, _STARTS)
        return waypoints

    def _forbid_failing(self, actions: list[Action]) -> None:
        """Finds the first action at which it fails, and what stands in its way."""
        count = 1
        while count < len(actions) and self._possible(actions[:count]):
            count += 1
        beginning = actions[:count]
        alone = _alone(beginning)
        if not self._possible(alone, without=self._others(alone)):
            why = self._why(alone, self._others(alone))
            self._give_up(beginning, why)
            if len(alone) == len(beginning) or _starts_with_pick(alone, self.start):
                self.search.forbid(alone[-1], "")
            else:
                self.search.forbidBeginning(beginning)
            return
        for fact, other in self._in_the_way(alone[-1]):
            if not self._possible(alone, without=[o for o in self._others(alone) if o != other]):
                why = f"while {fact}: {self._why(alone, [o for o in self._others(alone) if o != other])}"
                self._give_up(beginning, why)
                self.search.forbid(alone[-1], fact)
                return
        self._give_up(beginning, self._why(beginning, []))
        self.search.forbidBeginning(beginning)

    def _others(self, actions: list[Action]) -> list[str]:
        """Objects that the actions are not about."""
        used = {word for action in actions for word in action}
        return [
            fact[1:-1].split()[1]
            for fact in self.start
            if fact.startswith("(is_object ") and fact[1:-1].split()[1] not in used
        ]

    def _in_the_way(self, action: Action) -> list[tuple[str, str]]:
        """Facts of the start that put something where the action puts or takes its object."""
        return [
            (f, f[1:-1].split()[2])
            for f in self.start
            if f.startswith("(on ") and f[1:-1].split()[1] in action[1:] and f[1:-1].split()[2] not in action
        ]

    def _scene(self, without: list[str]) -> Config:
        C = self.C.copy()
        for name in without:
            C.getFrame(name).setContact(0)
        return C

    def _possible(self, actions: list[Action], without: list[str] | tuple[str, ...] = ()) -> bool:
        key = (tuple(map(tuple, actions)), tuple(without))
        if key not in self.known:
            self.known[key] = self._solve(self._scene(list(without)), actions, 0, _STARTS)[0] is not None
        return self.known[key]

    def _why(self, actions: list[Action], without: list[str]) -> str:
        return self._solve(self._scene(without), actions, 0, 1)[1]

    def _motions(self, waypoints: TaskWaypoints) -> TaskPlan | str:
        """The motions between waypoints, checked; or why there is none."""
        paths, scenes = [], []
        for phase, action in enumerate(waypoints.actions):
            C, q0, q1 = waypoints.komo.getSubProblem(phase)
            path, why = self._motion(C, q0, q1, action, waypoints.actions[phase - 1] if phase else [])
            if path is None:
                return f"{_text([action])}: {why}"
            paths.append(path)
            scenes.append(C)
        ends = np.cumsum([0] + [len(p) for p in paths])
        plan = self._end(
            "solved",
            f"{len(paths)} actions; checked: logic, motions free to 1 mm, grasps, placements, support",
            actions=waypoints.actions,
            waypoints=waypoints.komo.getPath(),
            path=np.vstack(paths),
            segments=[slice(int(a), int(b)) for a, b in itertools.pairwise(ends)],
            attachments=[
                (waypoints.komo.getConfiguration(i).getFrame(a[1]).getParent().name, a[1])
                for i, a in enumerate(waypoints.actions)
            ],
            scenes=scenes,
        )
        plan.violations = checkTaskPlan(self.C, plan, self.search.states(plan.actions))
        return plan if not plan.violations else plan.violations[0]

    def _motion(
        self, C: Config, q0: np.ndarray, q1: np.ndarray, action: Action, before: Action
    ) -> tuple[np.ndarray | None, str]:
        """A motion of one action: smooth if that is free between its slices, too, else one that trees find."""
        C.setJointState(q0)
        for via in (None, _above(C, action, q0, q1)):
            m = KOMO_ManipulationHelper()
            m.setup_point_to_point_motion(C, q1)
            if via is not None:
                s = np.linspace(0.0, 1.0, m.komo.getT() // 2 + 1)[1:, None]
                m.komo.initWithPath(np.vstack([q0 + s * (via - q0), via + s * (q1 - via)]))
            result = NLP_Solver(m.komo.nlp(), verbose=0).solve(0)
            self.evaluations += result.evals
            path = np.vstack([q0, m.komo.getPath()])
            if result.feasible and overlapAlong(C, path) <= _PENETRATION:
                return path, ""
        finder = RRT_PathFinder()
        finder.setOptions(verbose=0, collisionTolerance=_PENETRATION)
        finder.setProblem(C)
        finder.setStartGoal([q0], [q1])
        found = finder.solve(0)
        self.evaluations += found.evals
        if not found.feasible:
            return None, f"no motion was found: {found.message}"
        path = np.asarray(found.x)
        overlap = overlapAlong(C, path)
        return (path, "") if overlap <= _PENETRATION else (None, f"bodies overlap by {overlap:.4f} m on the way")


def _above(C: Config, action: Action, q0: np.ndarray, q1: np.ndarray) -> np.ndarray | None:
    """Joints with the hand above the middle of its way; None if there are none."""
    hand = {"pick": 3, "handover": 3, "place": 2}.get(action[0])
    if hand is None:
        return None
    D, at = C.copy(), []
    for q in (q0, q1):
        D.setJointState(q)
        at.append(D.getFrame(action[hand]).getPosition())
    middle = [*(0.5 * (at[0] + at[1]))[:2], max(at[0][2], at[1][2]) + _LIFT]
    result = solveIk(D, {action[hand]: middle}, attempts=10)
    return np.array(result.q) if result.feasible else None


def _alone(actions: list[Action]) -> list[Action]:
    """The last action, with the one that gave the hand its object."""
    last = actions[-1]
    for i in range(len(actions) - 2, -1, -1):
        if actions[i][1] == last[1] and last[0] != "pick":
            return [*_alone(actions[: i + 1]), last]
        if actions[i][1] == last[1]:
            break
    return [last]


def _starts_with_pick(actions: list[Action], start: list[str]) -> bool:
    """Is the object picked where it is at the start?"""
    first = actions[0]
    return first[0] == "pick" and f"(on {first[2]} {first[1]})" in start


def _cause(komo: KOMO, actions: list[Action]) -> str:
    return f"{_text(actions[-1:])}: {missed(komo) or 'the waypoints miss what the actions ask'}"


def _text(actions: list[Action]) -> str:
    return " ".join(f"({' '.join(a)})" for a in actions)


def planTask(
    C: Config,
    goal: str,
    domain: Domain | None = None,
    rules: dict[str, TaskRule] | None = None,
    seconds: float | None = None,
    evaluations: int = 200000,
    seed: int = 0,
) -> TaskPlan:
    """Finds what to do, and how to move, so that a goal holds: a search in logic proposes sequences of actions; cheap
    proofs of reach, size and room, then waypoints with grasps and placements, then motions say whether bodies can carry
    them out; conflicts go back into the logic. What is called solved has passed checkTaskPlan.

    Without a domain the actions are pick, place and handover. Grippers, objects and places are those that the scene
    names (`logical: { is_gripper }`); else frames whose names end with gripper, frames with a joint of type rigid and a
    shape, and level boxes that do not move.

    Args:
        C: The scene; it is not changed.
        goal: Literals that shall hold: "(on tray cup) (on tray jug)"; with ! behind one, that it does not.
        domain: Actions in logic; None: the default ones.
        rules: What actions of other names ask: name -> TaskRule.
        seconds: Gives up after that long; None: never. The answer then depends on the machine.
        evaluations: Effort: gives up after so many evaluations of motion problems.
        seed: Of the starts that are drawn.
    Returns:
        A TaskPlan; not finding one is no error.
    Raises:
        ParseError: A word of the goal is not in the scene.
        ArgumentError: Nothing is known of an action.
    """
    return _Task(C, goal, domain, rules, seconds=seconds, evaluations=evaluations, seed=seed).run()
