"""Plans and executes five problems of task and motion planning, with a Panda arm.

    python benchmarks/tamp_problems.py [--problems hanoi3,kitchen] [--seeds 3] [--first 0] [--time-limit 60]
        [--plan-only]

The problems follow the five of F. Lagriffoul, N. T. Dantam, C. Garrett, A. Akbari, S. Srivastava and L. E. Kavraki,
"Platform-Independent Benchmarks for Task and Motion Planning", IEEE Robotics and Automation Letters 3(4), 2018. They
are built here from primitives, smaller than there and of sizes chosen here, for one arm that stands at a table:

- hanoi3, hanoi4: slabs on three places, without rods; a slab lies only on a larger one, or on an empty place;
- blocks: six blocks in two stacks, to be stacked in another order on another place;
- sorting: four blue blocks to the left place, four green ones to the right, with three red ones among them;
- unblock: a low green block to another place, between two tall red ones that stand where they stood in the end;
- kitchen: two cups are cleaned on the sink, a cabbage behind a radish is cooked on the stove; all go to the table mat,
  and the radish stands on the board in the end.

The table has planned seeds, processor time, actions, findings of the independent checker, and the executions in
simulation whose end, 2 s later, is the goal.
"""

from __future__ import annotations

import argparse
import statistics
import time
import warnings
from collections.abc import Callable
from dataclasses import dataclass, field
from itertools import pairwise

import everyday
import numpy as np
from everyday_scenes import Scene, Table

import kinegraph as ry


@dataclass
class Problem:
    """A scene with the goal that a simulation shows, the whole goal, and actions besides the default ones."""

    scene: Scene
    goal: str
    domain: ry.Domain | None = None
    rules: dict[str, ry.TaskRule] = field(default_factory=dict)


HANOI = """
is_gripper is_object is_place on busy larger
START_STATE {{ {facts} }}
DecisionRule pick {{ Obj, From, Hand,
  {{ (is_gripper Hand) (is_object Obj) (on From Obj) (is_place From) (busy Hand)! (on Obj ANY)! }}
  {{ (on From Obj)! (on Hand Obj) (busy Hand) }} }}
DecisionRule place {{ Obj, Hand, To,
  {{ (is_gripper Hand) (is_object Obj) (on Hand Obj) (larger To Obj) (on To ANY)! }}
  {{ (busy Hand)! (on Hand Obj)! (on To Obj) }} }}
"""


def hanoi(rng: np.random.Generator, count: int) -> Problem:
    t, pegs, slabs = Table(rng), ["left", "middle", "right"], [f"slab{i}" for i in range(count)]
    for name, x in zip(pegs, (-0.35, 0.0, 0.35), strict=True):
        y = 0.42 if name == "middle" else float(rng.uniform(0.2, 0.3))
        t.plate(name, (0.16, 0.16), (x + float(rng.uniform(-0.03, 0.03)), y))
    for below, name, w in zip(["left", *slabs], slabs, np.linspace(0.074, 0.04, count), strict=False):
        t.box(name, (float(w), float(w), 0.04), on=below)
    larger = [f"(larger {a} {b})" for i, b in enumerate(slabs) for a in [*pegs, *slabs[:i]]]
    goal = " ".join(f"(on {a} {b})" for a, b in zip(["right", *slabs], slabs, strict=False))
    return Problem(t.scene(goal), goal, ry.Domain.fromFolText(HANOI.format(facts=" ".join(larger))))


def blocks(rng: np.random.Generator) -> Problem:
    t = Table(rng)
    for name, x in (("left", -0.3), ("right", 0.3)):
        t.plate(name, (0.26, 0.12), (x, float(rng.uniform(0.25, 0.35))))
    names = [f"block{c}" for c in rng.permutation(list("ABCDEF"))]
    for i, name in enumerate(names):
        t.box(
            name,
            (0.05, 0.05, 0.05),
            (-0.065 + 0.13 * (i // 3), 0.0) if i % 3 == 0 else None,
            on="left" if i % 3 == 0 else names[i - 1],
        )
    stacks = (("right", "blockA", "blockB", "blockC"), ("right", "blockD", "blockE", "blockF"))
    goal = " ".join(f"(on {a} {b})" for stack in stacks for a, b in pairwise(stack))
    return Problem(t.scene(goal), goal)


def sorting(rng: np.random.Generator) -> Problem:
    t, size = Table(rng), (0.04, 0.04, 0.08)
    for name, x in (("left", -0.5), ("right", 0.5)):
        t.plate(name, (0.2, 0.26), (x, 0.1))
    cells = rng.permutation([(x, y) for x in (-0.18, -0.06, 0.06, 0.18) for y in (0.25, 0.37, 0.49)])
    colors = ["blue"] * 4 + ["green"] * 4 + ["red"] * 3
    for i, color in enumerate(colors):
        t.box(f"{color}{i}", size, (float(cells[i][0]), float(cells[i][1])))
    places = {"blue": "left", "green": "right"}
    goal = " ".join(f"(on {places[c]} {c}{i})" for i, c in enumerate(colors) if c in places)
    return Problem(t.scene(goal), goal)


def unblock(rng: np.random.Generator) -> Problem:
    t, y = Table(rng), float(rng.uniform(0.3, 0.36))
    t.plate("left", (0.05, 0.05), (-0.25, y))
    t.plate("right", (0.2, 0.2), (0.3, float(rng.uniform(0.25, 0.33))))
    t.box("green", (0.04, 0.04, 0.04), on="left")
    for i, side in enumerate((-1, 1)):
        t.plate(f"mark{i}", (0.06, 0.1), (-0.25 + 0.06 * side, y))
        t.box(f"red{i}", (0.05, 0.05, 0.16), on=f"mark{i}")
    goal = "(on right green) (on mark0 red0) (on mark1 red1)"
    return Problem(t.scene(goal), goal)


def kitchen(rng: np.random.Generator) -> Problem:
    t = Table(rng)
    t.plate("sink", (0.18, 0.18), (-0.5, 0.15))
    t.plate("stove", (0.18, 0.18), (0.5, 0.15))
    t.plate("board", (0.3, 0.22), (-0.22, 0.45))
    t.plate("mat", (0.34, 0.26), (0.25, 0.42))
    t.box("cabbage", (0.06, 0.06, 0.06), (float(rng.uniform(-0.02, 0.02)), 0.05), on="board")
    t.box("radish", (0.04, 0.04, 0.08), (0.0, -0.05), on="board")
    for i in range(2):
        t.can(f"cup{i}", 0.027, float(rng.uniform(0.08, 0.1)), (-0.25 + 0.2 * i, 0.15))
    shown = "(on mat cup0) (on mat cup1) (on mat cabbage) (on board radish)"
    domain, rules = ry.defaultDomain(), {}
    for action, place, fact in (("clean", "sink", "cleaned"), ("cook", "stove", "cooked")):
        domain.addAction(action, ["Obj"], f"(is_object Obj) (on {place} Obj)", f"({fact} Obj)")
        rules[action] = ry.TaskRule(lambda w, time, words, variant: None, lambda C, words: ["wait"])
    return Problem(t.scene(shown), f"{shown} (cleaned cup0) (cleaned cup1) (cooked cabbage)", domain, rules)


PROBLEMS: dict[str, Callable[[np.random.Generator], Problem]] = {
    "hanoi3": lambda rng: hanoi(rng, 3),
    "hanoi4": lambda rng: hanoi(rng, 4),
    "blocks": blocks,
    "sorting": sorting,
    "unblock": unblock,
    "kitchen": kitchen,
}


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--problems", default=",".join(PROBLEMS), type=lambda s: s.split(","))
    parser.add_argument("--seeds", type=int, default=3)
    parser.add_argument("--first", type=int, default=0, help="the first seed")
    parser.add_argument("--time-limit", type=float, default=60.0, help="of planTask, s")
    parser.add_argument("--plan-only", action="store_true", help="without executions")
    options = parser.parse_args()
    warnings.simplefilter("ignore")
    print(f"{'problem':10} {'planned':>9} {'median s':>9} {'most s':>7} {'actions':>8} {'false':>6} {'executed':>10}")
    for name in options.problems:
        seconds, actions, false, reached, whys = [], [], 0, [], []
        for seed in range(options.first, options.first + options.seeds):
            problem = PROBLEMS[name](np.random.default_rng([seed, *name.encode()]))
            extra = {"domain": problem.domain, "rules": problem.rules} if problem.domain else {}
            began = time.process_time()
            plan = ry.planTask(problem.scene.C, problem.goal, time_limit=options.time_limit, **extra)
            seconds.append(time.process_time() - began)
            if not plan.feasible:
                whys.append(f"seed {seed}: {plan.message}")
                continue
            actions.append(len(plan.actions))
            false += bool(ry.checkTaskPlan(problem.scene.C, plan))
            if not options.plan_only:
                outcome = everyday.attempt(problem.scene, plan, "undisturbed", seed, 0)
                reached.append(outcome.reached)
                whys += [] if outcome.reached else [f"seed {seed}: {outcome.why}"]
        print(
            f"{name:10} {len(actions):4} of {options.seeds:<3}{statistics.median(seconds):9.2f} {max(seconds):7.2f}"
            f" {statistics.median(actions or [0]):8.0f} {false:6} {sum(reached):5} of {len(reached)}",
            flush=True,
        )
        for why in whys:
            print(f"    {why[:200]}", flush=True)


if __name__ == "__main__":
    main()
