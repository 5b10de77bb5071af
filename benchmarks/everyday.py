"""Plans ordinary scenes, executes the plans in simulation with contact, and judges the end.

    python benchmarks/everyday.py [--generators "stack,swap"] [--scenes 5] [--first 0] [--jobs 2] [--repairs 3]
        [--time-limit 60] [--conditions undisturbed,errors,moved] [--details]

everyday_scenes.py and everyday_objects.py draw the scenes, one for each number. Each plan is executed under these
conditions:

- undisturbed;
- with errors of pose: all things and the arms are up to 3 mm and 1 degree away from the scene of the plan, without
  repairs;
- with one object moved by 3 to 10 cm between two steps of the execution, with repairs;
- with `--conditions start`: from a collision-free configuration within .1 rad of the start of the plan, without
  repairs.

An execution succeeds if 2 s after its end the goal holds, every thing that no action moved is at its place to 1 cm, and
nothing has fallen. The judge knows the simulated world, and nothing of what `execute` says; column "untrue" counts
executions whose own result differs. The table also has the processor time of planTask, the plans whose weakest step
survives errors of 3 mm, the objects placed with their whole footprint, and the reasons of failures.
"""

from __future__ import annotations

import argparse
import re
import statistics
import time
import warnings
from collections import Counter
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass, field

import numpy as np
from everyday_objects import OBJECT_GENERATORS
from everyday_scenes import GENERATORS, Scene

import kinegraph as ry

SHIFT, TURN = 3e-3, np.deg2rad(1.0)  # errors of pose: m, rad
MOVE = (0.03, 0.1)  # m: by which an object is moved
BESIDE = 0.1  # rad or m: by which joints are moved
GAP = 0.008  # m: between the moved object and all others
STAYED, LEVEL = 1e-2, np.cos(np.deg2rad(10.0))  # m; cosine
CONTACT = 6e-3  # m: between an object and its place
REST = 2.0  # s until the judge looks

ALL = {**GENERATORS, **OBJECT_GENERATORS}


def literals(goal: str) -> list[tuple[str, list[str], bool]]:
    return [(words.split()[0], words.split()[1:], not no) for words, no in re.findall(r"\(([^)]*)\)\s*(!?)", goal)]


def halfSizes(C: ry.Config, name: str) -> np.ndarray:
    """Half of the extents of the shape of a place: a box or an upright cylinder."""
    frame = C.getFrame(name)
    size = frame.getSize()
    if frame.getShapeType() == ry.ST.cylinder:
        return np.array([size[1], size[1], 0.5 * size[0]])
    return 0.5 * np.asarray(size[:3])


def pointsOf(C: ry.Config, name: str, place: str | None = None) -> np.ndarray:
    """The points of a body with all parts fixed to it, in the axes of the world, or of the top of a place."""
    frames, points = [C.getFrame(name)], []
    while frames:
        frame = frames.pop()
        frames += [f for f in frame.getChildren() if f.getJointType() == ry.JT.none]
        if frame.getShapeType() != ry.ST.none:
            points.append(frame.getMeshPoints() @ frame.getRotationMatrix().T + frame.getPosition())
    all_points = np.vstack(points)
    if place is None:
        return all_points
    base = C.getFrame(place)
    return (all_points - base.getPosition()) @ base.getRotationMatrix() - [0, 0, halfSizes(C, place)[2]]


def tilts(C: ry.Config, name: str, before: ry.Config) -> bool:
    """Whether another side of an object points up than before. Round ones may roll."""
    now, then = (world.getFrame(name).getRotationMatrix()[2] for world in (C, before))
    if C.getFrame(name).getShapeType() in (ry.ST.cylinder, ry.ST.capsule):
        now, then = (np.array([np.hypot(*up[:2]), up[2]]) for up in (now, then))
    return bool(now @ then < LEVEL)


def bottom(C: ry.Config, name: str) -> float:
    return float(pointsOf(C, name)[:, 2].min())


def standsOn(C: ry.Config, name: str, place: str) -> bool:
    """Whether the lowest point of an object is at the top of a place, and the middle of its lowest part above it."""
    points = pointsOf(C, name, place)
    sole = points[points[:, 2] < points[:, 2].min() + CONTACT, :2]
    middle = 0.5 * (sole.min(axis=0) + sole.max(axis=0))
    return bool(abs(points[:, 2].min()) < CONTACT and np.all(np.abs(middle) < halfSizes(C, place)[:2]))


def footprint(C: ry.Config, name: str, place: str) -> bool | None:
    """Whether the whole footprint of an object is on a place; None if the place is smaller."""
    points, room = pointsOf(C, name, place), halfSizes(C, place)
    sole = points[points[:, 2] < points[:, 2].min() + CONTACT, :2]
    if min(room[:2]) < 0.5 * max(np.ptp(sole, axis=0)):
        return None
    return bool(np.all(np.abs(sole) < room[:2] + 1e-3))


def holds(C: ry.Config, predicate: str, words: list[str]) -> bool:
    if predicate == "on" and words[0].endswith("gripper"):
        away = pointsOf(C, words[1]) - C.getFrame(words[0]).getPosition()
        return bool(np.all(away.min(axis=0) < 0.02) and np.all(away.max(axis=0) > -0.02))
    if predicate == "on":
        return standsOn(C, words[1], words[0])
    if predicate in ("opened", "closed"):
        return ry.doorStates(C)[words[0]] == predicate
    raise ValueError(f"the judge does not know ({predicate})")


def judge(scene: Scene, before: ry.Config, C: ry.Config, touched: set[str]) -> list[str]:
    """Returns the reasons for which the end is no success; `before` is the world as it was set up and disturbed."""
    wrong = []
    for predicate, words, expected in literals(scene.goal):
        if holds(C, predicate, words) != expected:
            wrong.append(f"({predicate} {' '.join(words)}) is {not expected}")
    names = scene.objects
    held = {w[1] for p, w, yes in literals(scene.goal) if p == "on" and yes and w[0].endswith("gripper")}
    places = placesOf(C, names)
    for name in names:
        if name in held:
            continue
        if tilts(C, name, before):
            wrong.append(f"{name} has fallen")
        elif name not in touched:
            moved = np.linalg.norm(C.getFrame(name).getPosition() - before.getFrame(name).getPosition())
            if moved > STAYED and not travels(C, name):
                wrong.append(f"{name} was pushed by {1e3 * moved:.0f} mm")
        elif not any(standsOn(C, name, place) for place in places if place != name):
            wrong.append(f"{name} stands on nothing")
    return wrong


def placesOf(C: ry.Config, objects: list[str]) -> list[str]:
    """Boxes, and objects with a box or a cylinder of their own."""
    tops = [f for f in C.getFrames() if f.getShapeType() in (ry.ST.box, ry.ST.ssBox, ry.ST.cylinder)]
    return [
        f.name for f in tops if f.name in objects or (f.getShapeType() != ry.ST.cylinder and not bodyOf(f, objects))
    ]


def bodyOf(frame: ry.Frame, objects: list[str]) -> str | None:
    """The object that a frame belongs to."""
    above: ry.Frame | None = frame
    while above is not None and above.name not in objects:
        above = above.getParent()
    return above.name if above is not None else None


def travels(C: ry.Config, name: str) -> bool:
    """Whether an object hangs below a joint that moves, as in a drawer."""
    frame = C.getFrame(name).getParent()
    while frame is not None:
        if frame.getJointType() not in (ry.JT.rigid, ry.JT.none):
            return True
        frame = frame.getParent()
    return False


def withErrors(scene: Scene, rng: np.random.Generator) -> ry.Config:
    """A copy of the scene whose things and arms are slightly displaced."""
    world = scene.C.copy()
    for name in [*scene.things, *scene.robots]:
        frame = world.getFrame(name)
        a = rng.uniform(0, 2 * np.pi)
        shift = SHIFT * np.sqrt(rng.uniform()) * np.array([np.cos(a), np.sin(a), 0.0])
        turn = 0.5 * rng.uniform(-TURN, TURN)
        pose = frame.getPose()
        w, x, y, z = pose[3:]
        c, s = np.cos(turn), np.sin(turn)
        turned = [c * w - s * z, c * x - s * y, c * y + s * x, c * z + s * w]  # about the vertical
        frame.setPose([*(pose[:3] + shift), *turned])
    return world


def moveArms(C: ry.Config, rng: np.random.Generator) -> None:
    """Draws a collision-free configuration close to that of a scene."""
    q, apart = C.getJointState(), len(C.getCollisions(0.0))
    moved = [name not in ry.doorStates(C) for name in C.getJointNames()]
    for _ in range(100):
        C.setJointState(q + np.where(moved, rng.uniform(-BESIDE, BESIDE, len(q)), 0.0))
        if len(C.getCollisions(0.0)) <= apart:
            return
    C.setJointState(q)


def displaced(scene: Scene, C: ry.Config, rng: np.random.Generator) -> tuple[str, np.ndarray] | None:
    """Draws an object with nothing on it, not in a hand nor in something that moves, and a free pose for it on the
    table, 3 to 10 cm away; None if there is none.
    """
    table = C.getFrame(scene.things[0]).getParent()
    if table is None or not table.getSize().size:
        table = C.getFrame("here")
    top = table.getPosition()[2] + 0.5 * table.getSize()[2]
    names, places = scene.objects, placesOf(C, scene.objects)
    free = [
        n
        for n in names
        if not tilts(C, n, scene.C) and not travels(C, n) and any(standsOn(C, n, p) for p in places if p != n)
    ]
    free = [n for n in free if not any(standsOn(C, o, n) for o in names if o != n and n in places)]
    for _ in range(300 if free else 0):
        name = free[rng.integers(len(free))]
        pose, a, r = C.getFrame(name).getPose(), rng.uniform(0, 2 * np.pi), rng.uniform(*MOVE)
        at = np.array([*(pose[:2] + r * np.array([np.cos(a), np.sin(a)])), top + pose[2] - bottom(C, name)])
        bases = [C.getFrame(base).getPosition() for base in scene.robots]
        reach = [min(float(np.linalg.norm((p - base)[:2])) for base in bases) for p in (pose[:3], at)]
        if 0.3 < reach[1] < max(0.66, reach[0]) and isFree(C, name, at, names):
            return name, np.array([*at, *pose[3:]])
    return None


def isFree(C: ry.Config, name: str, at: np.ndarray, objects: list[str]) -> bool:
    """Whether an object at a position is apart from all others, but for its support."""
    D = C.copy()
    D.getFrame(name).setPosition(at)
    for pair in D.getCollisions(GAP):
        frames = [D.getFrame(f) for f in pair[:2]]
        bodies = [bodyOf(f, objects) for f in frames]
        if bodies.count(name) == 1 and not isSupport(D, name, frames[1 - bodies.index(name)]):
            return False
    return True


def isSupport(C: ry.Config, name: str, other: ry.Frame) -> bool:
    return other.getShapeType() == ry.ST.ssBox and other.getPosition()[2] < bottom(C, name)


@dataclass
class Outcome:
    condition: str
    reached: bool = False
    said: bool = False
    whole: list[bool] = field(default_factory=list)
    why: str = ""


def attempt(scene: Scene, plan: ry.TaskPlan, condition: str, seed: int, repairs: int) -> Outcome | None:
    """Executes a plan under a condition; None if there is nothing to disturb."""
    rng = np.random.default_rng(seed)
    world = withErrors(scene, rng) if condition == "errors" else scene.C.copy()
    if condition == "start":
        moveArms(world, rng)
    reference, result, touched = world.copy(), Outcome(condition), set[str]()
    steps = int(rng.integers(1, 2 * len(plan.actions) + 1)) if condition == "moved" else 0  # until somebody comes
    bot = ry.BotOp(world)
    run = plan.run(bot, repairs=repairs if condition == "moved" else 0, time_limit=60.0)
    count = 0
    for event in run:
        touched |= {action[1] for action in run.plan.actions}
        count += 1
        if event.kind == ry.TaskEventKind.end:
            break
        if count != steps:
            continue
        now = scene.C.copy()
        bot.sync(now, 0.0)
        change = displaced(scene, now, rng)
        if change is None:
            steps += 1  # later, if nothing can be moved now
            continue
        bot.setFramePose(*change)
        reference.getFrame(change[0]).setPose(change[1])
    if condition == "moved" and count <= steps:
        return None
    result.said, result.why = run.result.feasible, str(run.result.message)
    bot.sync(world, REST)
    wrong = judge(scene, reference, world, touched)
    result.reached = not wrong
    if wrong and result.said:
        result.why = "; ".join(wrong)
    elif not wrong and not result.said:
        result.why = f"said: {result.why}"
    if not wrong:
        on = [w for p, w, yes in literals(scene.goal) if p == "on" and yes and not w[0].endswith("gripper")]
        result.whole = [w for w in (footprint(world, name, place) for place, name in on) if w is not None]
    return result


@dataclass
class Report:
    name: str
    number: int
    seconds: float = 0.0
    planned: bool = False
    false: bool = False
    robust: bool = False
    why: str = ""
    outcomes: list[Outcome] = field(default_factory=list)


def evaluate(name: str, number: int, options: argparse.Namespace) -> Report:
    warnings.simplefilter("ignore")
    scene = ALL[name](np.random.default_rng([number, *name.encode()]))
    began = time.process_time()
    plan = ry.planTask(scene.C, scene.goal, time_limit=options.time_limit)
    report = Report(name, number, time.process_time() - began, plan.feasible, why=str(plan.message))
    if plan.feasible:
        report.false = bool(ry.checkTaskPlan(scene.C, plan))
        report.robust = all(error >= SHIFT for error, _ in plan.tolerances)
        for condition in options.conditions:
            outcome = attempt(scene, plan, condition, number, options.repairs)
            if outcome is not None:
                report.outcomes.append(outcome)
    return report


def row(name: str, reports: list[Report], conditions: list[str]) -> str:
    planned = [r for r in reports if r.planned]
    seconds = [r.seconds for r in reports] or [0.0]
    cells = []
    for condition in conditions:
        outcomes = [o for r in planned for o in r.outcomes if o.condition == condition]
        cells.append(f"{sum(o.reached for o in outcomes):4} of {len(outcomes):<4}")
    untrue = sum(o.reached != o.said for r in planned for o in r.outcomes)
    whole = [w for r in planned for o in r.outcomes if o.condition == conditions[0] for w in o.whole]
    return (
        f"{name:17} {len(planned):4} of {len(reports):<4} {sum(r.false for r in planned):5}"
        f" {statistics.median(seconds):8.2f} {max(seconds):7.2f}   {'   '.join(cells)}  {untrue:6}"
        f"   {sum(r.robust for r in planned):4} of {len(planned):<4}   {sum(whole):4} of {len(whole):<4}"
    )


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--generators", default=",".join(ALL), type=lambda s: [n.strip() for n in s.split(",")])
    parser.add_argument("--scenes", type=int, default=5, help="scenes per generator")
    parser.add_argument("--first", type=int, default=0, help="the first number of a scene")
    parser.add_argument("--jobs", type=int, default=1, help="processes")
    parser.add_argument("--repairs", type=int, default=3)
    parser.add_argument("--time-limit", type=float, default=60.0, help="of planTask, s")
    parser.add_argument("--conditions", default="undisturbed,errors,moved", type=lambda s: s.split(","))
    parser.add_argument("--details", action="store_true", help="a line for each failure")
    options = parser.parse_args()
    heads = "   ".join(f"{c:12}" for c in options.conditions)
    print(
        f"{'generator':17} {'planned':>12} {'false':>5} {'median s':>8} {'most s':>7}   {heads}  untrue   robust         whole footprint"
    )
    numbers = range(options.first, options.first + options.scenes)
    all_reports: list[Report] = []
    with ProcessPoolExecutor(options.jobs) as pool:
        jobs = {n: [pool.submit(evaluate, n, k, options) for k in numbers] for n in options.generators}
        for name, futures in jobs.items():
            reports = [future.result() for future in futures]
            all_reports += reports
            print(row(name, reports, options.conditions), flush=True)
            reasons = Counter(f"plan: {r.why}" for r in reports if not r.planned)
            reasons.update(f"{o.condition}: {o.why}" for r in reports for o in r.outcomes if not o.reached)
            for why, count in reasons.most_common(4):
                print(f"    {count} x {why[:150]}", flush=True)
            for r in reports if options.details else []:
                for condition, why in [("plan", r.why), *((o.condition, o.why) for o in r.outcomes)]:
                    if why:
                        print(f"    scene {r.number}, {condition}: {why}", flush=True)
    print(row("all", all_reports, options.conditions))


if __name__ == "__main__":
    main()
