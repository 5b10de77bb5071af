"""What a failure in geometry says in logic: which actions and facts exclude each other."""

from __future__ import annotations

from ._core import Domain, LogicProblem, PlanSearch
from .task_domain import PICKS, wordsOf
from .task_proofs import Impossible
from .task_waypoints import Action


def actionsAlone(actions: list[Action]) -> list[Action]:
    """The last action, with those that gave the hand its object."""
    last = actions[-1]
    for i in range(len(actions) - 2, -1, -1):
        if actions[i][1] == last[1] and last[0] not in PICKS:
            return [*actionsAlone(actions[: i + 1]), last]
        if actions[i][1] == last[1]:
            break
    return [last]


def startsWithPick(actions: list[Action], start: list[str]) -> bool:
    """Is the object picked where it is at the start?"""
    first = actions[0]
    return first[0] in PICKS and f"(on {first[2]} {first[1]})" in start


def objectsWithout(actions: list[Action], start: list[str]) -> list[str]:
    """Objects that actions are not about."""
    used = {word for action in actions for word in action}
    return [obj for obj in wordsOf(start, "is_object") if obj not in used]


def inTheWay(action: Action, start: list[str]) -> list[tuple[str, str]]:
    """Facts of the start that put something where the action puts or takes its object, and what that is."""
    words = [(fact, fact[1:-1].split()) for fact in start if fact.startswith("(on ")]
    return [(fact, obj) for fact, (_, place, obj) in words if place in action[1:] and obj not in action]


def whileFacts(alone: list[Action], start: list[str]) -> str:
    """Facts of the start on which a failure rests: another grasp may do what this one cannot, and what stands on a carrier
    may be brought within reach."""
    last = alone[-1]
    under = {words[2]: words[1] for words in (f[1:-1].split() for f in start if f.startswith("(on "))}
    below = set()
    for word in last[1:]:
        while word in under:
            below.add(word)
            word = under[word]
    facts = [f"(fresh {obj})" for obj in sorted(below)]
    if len(alone) > 1:
        facts += [*(f for f in start if f.startswith("(up ") and f.endswith(f" {last[1]})"))]
    return " ".join(fact for fact in facts if fact in start)


def standsOnItself(states: list[list[str]]) -> str:
    """An object that would stand on what stands on it, in one of the states; '' if there is none."""
    for state in states:
        under = {words[2]: words[1] for words in (f[1:-1].split() for f in state if f.startswith("(on "))}
        for obj in under:
            below, steps = under.get(obj), 0
            while below is not None and below != obj and steps < len(under):
                below, steps = under.get(below), steps + 1
            if below == obj:
                return obj
    return ""


def literals(text: str) -> list[str]:
    """The literals of a text."""
    return [f"({part.strip()}" for part in text.split("(") if part.strip()]


def neededProofs(problem: LogicProblem, proofs: list[Impossible]) -> str:
    """The proofs that matter: with these alone there is no plan; those that can be left out one by one are."""
    whys = list(dict.fromkeys(proof.why for proof in proofs))
    for why in list(whys):
        rest = [w for w in whys if w != why]
        search = PlanSearch(problem)
        for proof in proofs:
            if proof.why in rest:
                search.forbid(proof.action, proof.facts)
        if search.next() is None:
            whys = rest
    return "; ".join(whys)


def contradiction(domain: Domain, problem: LogicProblem, start: list[str]) -> str:
    """The fewest literals of the goal that no sequence of actions reaches together."""
    goal = problem.goal
    for literal in list(goal):
        rest = [g for g in goal if g != literal]
        if rest and PlanSearch(LogicProblem(domain, " ".join(start), " ".join(rest))).next() is None:
            goal = rest
    return f"no sequence of actions reaches {' and '.join(goal)}" + (" together" if len(goal) > 1 else "")
