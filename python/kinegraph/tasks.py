"""From a goal to a motion: which object, with which hand, how grasped, where put down, along which path."""

from __future__ import annotations

import itertools
import time as clock
from collections import Counter
from collections.abc import Iterator
from functools import partial
from typing import Any

import numpy as np

from ._core import Config, Domain, LogicProblem, PlanSearch, sceneFacts
from .errors import ArgumentError
from .in_order import Stopped, checkThreads, inOrder
from .task_actions import DEFAULT_RULES, UPRIGHT, TaskRule
from .task_attempts import Failure, TaskAttempts
from .task_check import checkTaskPlan
from .task_conflicts import (
    actionsAlone,
    contradiction,
    inTheWay,
    literals,
    neededProofs,
    objectsWithout,
    standsOnItself,
    startsWithPick,
    whileFacts,
)
from .task_domain import defaultDomain, planText, sceneWords, wordsOf
from .task_motions import TaskMotions, TimedRows, motionLimits
from .task_plan import Branch, TaskPlan
from .task_proofs import Impossible, impossibleActions
from .task_waypoints import Action, TaskWaypoints

_MOTION_STARTS = 3  # sets of waypoints whose motions are tried
_BETTER_STARTS = 16  # the same, where they have motions, and better ones are wanted


class _Task:
    """One call of planTask."""

    def __init__(
        self, C: Config, goal: str, domain: Domain | None, rules: dict[str, TaskRule] | None, **limits: Any
    ) -> None:
        self.C = C.copy()
        self.rules = {**DEFAULT_RULES, **({"place": UPRIGHT} if "(up " in goal else {}), **(rules or {})}
        self.domain = defaultDomain() if domain is None else domain
        self.limits = limits
        self.regrasps = domain is None  # not tried yet
        self.motion_limits = motionLimits(self.C, limits["velocity"], limits["acceleration"])
        self.goal = goal
        self._begin(sceneWords(self.C, sceneFacts(self.C), goal))
        missing = sorted({a[0] for a in self.search.actions} - set(self.rules))
        if missing:
            raise ArgumentError(
                f"planTask: nothing is known of what the actions {', '.join(missing)} ask; give them in `rules`"
            )
        self.tree: list[Branch] = []
        self.causes: Counter[str] = Counter()
        self.guessed = False  # is anything forbidden that was not proved?
        self.known: dict[tuple[Any, ...], Failure | None] = {}
        self.deadline = None if limits["seconds"] is None else clock.monotonic() + limits["seconds"]
        self.threads = checkThreads("planTask", limits["threads"])
        self.attempts = TaskAttempts(self.rules, limits["seed"], self.threads, self._late)

    def _begin(self, start: list[str]) -> None:
        self.start = start
        self.problem = LogicProblem(self.domain, " ".join(start), self.goal)
        self.search = PlanSearch(self.problem)

    def plans(self) -> Iterator[TaskPlan]:
        """Plans, each faster than the one before; without any, an answer that says why."""
        if self.search.unreachable:
            yield self._end("proved impossible", "; ".join(self.search.oddities))
            return
        proofs = impossibleActions(self.C, self.search.actions) if self.rules["pick"] is DEFAULT_RULES["pick"] else []
        self._exclude(proofs)
        best = np.inf
        while (actions := self._next(best == np.inf, proofs)) is not None:
            if not actions:
                q = self.C.getJointState()
                yield self._end("solved", "the goal holds already", path=q[None], times=np.zeros(1))
                return
            for plan in self._try(actions):
                if plan.duration < best:
                    best = plan.duration
                    yield plan
                if self._spent():
                    break
            if self._spent():
                if best == np.inf:
                    yield self._end("not found", f"no plan within the effort; {self._first_cause()}")
                return
        if best == np.inf:
            yield self._nothing(proofs)

    def _exclude(self, proofs: list[Impossible]) -> None:
        for proof in proofs:
            self.search.forbid(proof.action, proof.facts)

    def _next(self, none_yet: bool, proofs: list[Impossible]) -> list[Action] | None:
        """The next plan in logic. Where all fail, things may also be put down to be grasped in another way."""
        actions = self.search.next()
        if actions is None and none_yet and self.guessed and self.regrasps and self.search.status != "limit":
            self.regrasps = False
            self._begin([*self.start, *(f"(fresh {obj})" for obj in wordsOf(self.start, "is_object"))])
            self._exclude(proofs)
            actions = self.search.next()
        return actions

    def _spent(self) -> bool:
        return self.attempts.evaluations >= self.limits["evaluations"] or self._late()

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
        if not proofs or PlanSearch(self.problem).next() is None:
            return self._end("proved impossible", contradiction(self.domain, self.problem, self.start))
        return self._end("proved impossible", neededProofs(self.problem, proofs))

    def _end(self, status: str, message: str, **more: Any) -> TaskPlan:
        return TaskPlan(
            status,
            message,
            causes=self.causes.most_common(),
            tree=self.tree,
            evaluations=self.attempts.evaluations,
            expansions=self.search.expansions,
            goal=self.problem.goal,
            start=self.start,
            **more,
        )

    # --- geometry ----------------------------------------------------------------------------------------------------

    def _try(self, actions: list[Action]) -> Iterator[TaskPlan]:
        """Plans with these actions, from other waypoints each; forbids what fails."""
        if cycle := standsOnItself(self.search.states(actions)):
            self.search.forbidBeginning(actions)
            self.tree.append(Branch(actions, f"'{cycle}' would stand on itself"))
            return
        failed: Failure | None = None
        found = False
        for seed in range(_BETTER_STARTS):
            if seed >= _MOTION_STARTS and not found:
                break
            waypoints = self.attempts.find(self.C, actions, seed)
            if isinstance(waypoints, Failure):
                if seed == 0:
                    self.known[tuple(map(tuple, actions)), ()] = waypoints
                break
            plan = self._motions(waypoints)
            if isinstance(plan, TaskPlan):
                self.tree.append(Branch(actions, ""))
                found = True
                yield plan
            else:
                failed = plan
        if found:
            self.search.forbidBeginning(actions)
        elif failed:
            self._give_up(actions, failed.why, failed.ghost)
            self.search.forbidBeginning(actions)
        else:
            self._forbid_failing(actions)

    def _give_up(self, actions: list[Action], why: str, ghost: Config | None = None) -> None:
        self.guessed = True
        if any(branch.actions == actions and branch.why == why for branch in self.tree):
            return  # tried before regrasps were allowed
        self.causes[why] += 1
        self.tree.append(Branch(actions, why, ghost))

    def _forbid_failing(self, actions: list[Action]) -> None:
        """Finds the first action at which it fails, and what stands in its way."""
        count = 1
        while count < len(actions) and self._failure(actions[:count]) is None:
            count += 1
        beginning = actions[:count]
        alone = actionsAlone(beginning)
        others = objectsWithout(alone, self.start)
        if failure := self._failure(alone, others):
            self._give_up(beginning, failure.why, failure.ghost)
            general = len(alone) == len(beginning) or startsWithPick(alone, self.start)
            self._forbid(beginning, whileFacts(alone, self.start) if general else None)
            return
        for fact, other in inTheWay(alone[-1], self.start):
            if failure := self._failure(alone, [o for o in others if o != other]):
                self._give_up(beginning, f"while {fact}: {failure.why}", failure.ghost)
                self._forbid(beginning, f"{fact} {whileFacts(alone, self.start)}")
                return
        failure = self._failure(beginning)
        assert failure is not None, "what is whole failed"
        self._give_up(beginning, failure.why, failure.ghost)
        self.search.forbidBeginning(beginning)

    def _forbid(self, beginning: list[Action], facts: str | None) -> None:
        """The last action is impossible while facts hold; None, or where they do not hold then: after what was done before."""
        holds = self.search.states(beginning)[-2]
        if facts is not None and all(fact in holds for fact in literals(facts)):
            self.search.forbid(beginning[-1], facts.strip())
        else:
            self.search.forbidBeginning(beginning)

    def _scene(self, without: list[str]) -> Config:
        C = self.C.copy()
        for name in without:
            C.getFrame(name).setContact(0)
        return C

    def _failure(self, actions: list[Action], without: list[str] | tuple[str, ...] = ()) -> Failure | None:
        """Why actions cannot be carried out while some objects are not there; None if they can."""
        key = (tuple(map(tuple, actions)), tuple(without))
        if key not in self.known:
            solved = self.attempts.find(self._scene(list(without)), actions, 0)
            self.known[key] = solved if isinstance(solved, Failure) else None
        return self.known[key]

    def _motions(self, waypoints: TaskWaypoints) -> TaskPlan | Failure:
        """The motions between waypoints, checked; or why there is none."""
        actions = waypoints.actions
        phases = [waypoints.komo.getSubProblem(phase) for phase in range(len(actions))]
        jobs = [
            partial(self._motion, *phase, action, before)
            for phase, action, before in zip(phases, actions, [[], *actions[:-1]], strict=True)
        ]
        rows: list[TimedRows] = []
        found = inOrder(jobs, self.threads)
        for (C, _, q1), action, (motion, why, evaluations) in zip(phases, actions, found, strict=True):
            self.attempts.evaluations += evaluations
            if motion is None:
                C.setJointState(q1)
                return Failure(f"{planText([action])}: {why}", C)
            rows.append(motion)
        plan = self._plan(waypoints, rows, [phase[0] for phase in phases])
        plan.violations = checkTaskPlan(self.C, plan, self.search.states(plan.actions))
        return plan if not plan.violations else Failure(plan.violations[0], None)

    def _motion(
        self, C: Config, q0: np.ndarray, q1: np.ndarray, action: Action, before: Action, _stopped: Stopped
    ) -> tuple[TimedRows | None, str, int]:
        """The motion of an action, why there is none, and how many evaluations that took."""
        motions = TaskMotions(self.motion_limits, self.start, self.limits["seed"])
        motion, why = motions.between(C, q0, q1, action, before)
        return motion, why, motions.evaluations

    def _plan(self, waypoints: TaskWaypoints, rows: list[TimedRows], scenes: list[Config]) -> TaskPlan:
        ends = np.cumsum([0] + [len(motion.path) for motion in rows])
        began = np.cumsum([0.0] + [motion.times[-1] for motion in rows])
        return self._end(
            "solved",
            f"{len(rows)} actions, {began[-1]:.2f} s; checked: logic, motions free to 1 mm at all times, limits, grasps, "
            "placements, support",
            actions=waypoints.actions,
            waypoints=waypoints.komo.getPath(),
            path=np.vstack([motion.path for motion in rows]),
            times=np.concatenate([start + motion.times for start, motion in zip(began, rows, strict=False)]),
            limits=self.motion_limits,
            segments=[slice(int(a), int(b)) for a, b in itertools.pairwise(ends)],
            attachments=[
                (waypoints.komo.getConfiguration(i).getFrame(a[1]).getParent().name, a[1])
                for i, a in enumerate(waypoints.actions)
            ],
            scenes=scenes,
        )


def planTask(
    C: Config,
    goal: str,
    domain: Domain | None = None,
    rules: dict[str, TaskRule] | None = None,
    seconds: float | None = None,
    evaluations: int = 200000,
    seed: int = 0,
    velocity: Any = None,
    acceleration: Any = None,
    threads: int = 1,
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
        velocity: Most |dq/dt|, a number or one per joint, rad/s or m/s; None: the model's, 1 where it says none.
        acceleration: Most |d2q/dt2|, the same, rad/s^2 or m/s^2; None: what reaches full speed in half a second.
        threads: How many try variants of actions, and motions, at the same time; the plan is the same, to the bit.
            They call `rules`, too.
    Returns:
        A TaskPlan; not finding one is no error.
    Raises:
        ParseError: A word of the goal is not in the scene.
        ArgumentError: Nothing is known of an action.
    """
    return next(planTasks(C, goal, domain, rules, seconds, evaluations, seed, velocity, acceleration, threads))


def planTasks(
    C: Config,
    goal: str,
    domain: Domain | None = None,
    rules: dict[str, TaskRule] | None = None,
    seconds: float | None = None,
    evaluations: int = 200000,
    seed: int = 0,
    velocity: Any = None,
    acceleration: Any = None,
    threads: int = 1,
) -> Iterator[TaskPlan]:
    """Plans that get better while one waits: the first is that of planTask, each further one takes less time than the one
    before. They come from other waypoints of the same actions, and from other actions.

        for plan in ry.planTasks(C, "(on tray cup)", evaluations=20000):
            print(plan.duration)

    Args:
        C: The scene; it is not changed.
        goal: As for planTask.
        domain: As for planTask.
        rules: As for planTask.
        seconds: Ends after that long; None: never.
        evaluations: Effort: ends after so many evaluations of motion problems.
        seed: Of the starts that are drawn.
        velocity: As for planTask.
        acceleration: As for planTask.
        threads: As for planTask.
    Returns:
        An iterator of TaskPlans; where there is none, one that says why.
    Raises:
        ParseError: A word of the goal is not in the scene.
        ArgumentError: Nothing is known of an action.
    """
    options = {
        "seconds": seconds,
        "evaluations": evaluations,
        "seed": seed,
        "velocity": velocity,
        "acceleration": acceleration,
        "threads": threads,
    }
    for plan in _Task(C, goal, domain, rules, **options).plans():
        plan.again = lambda scene: planTask(scene, goal, domain, rules, **options)
        yield plan
