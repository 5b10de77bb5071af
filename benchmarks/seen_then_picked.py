"""Picks and places things of which only the shapes are told, and where the cameras are.

    python benchmarks/seen_then_picked.py [--scenes 20] [--first 0] [--move] [--cell 0.02]

Each scene is a Panda at a table with a tray, two to four things that the robot knows by shape, and one that it does not
know, all in drawn places. Two fixed cameras with the noise of a stereo pair look at the table, before and during the
execution. The robot is to put one or two of the things onto the tray. With `--move`, somebody moves one of them by 6 to
10 cm once the robot has gripped something, or before its first motion if it is the only one. A scene counts as carried
out if the things stand on the tray of the simulated world in the end, and the unknown one was not moved by more than
1 cm.
"""

from __future__ import annotations

import argparse
import time
import warnings

import numpy as np
from stereo_cameras import camera_pose, image

import kinegraph as ry

EYES = ([-0.75, 1.15, 1.35], [0.8, 1.05, 1.3])
REGION = [[-0.55, -0.05, 0.655], [0.55, 0.8, 1.15]]
TABLE = 0.65  # m, height of its top


def add_thing(C, name, shape, size, place, turn):
    """Adds a loose thing that stands on the table."""
    height = size[2] if shape == ry.ST.ssBox else size[0]
    frame = C.addFrame(name, "table").setShape(shape, size).setJoint(ry.JT.rigid)
    frame.setPose([*place, TABLE + height / 2, np.cos(turn / 2), 0, 0, np.sin(turn / 2)])
    frame.setContact(1).setMass(0.15).setAttributes({"friction": 1.0})


def draw_shape(rng):
    if rng.random() < 0.4:
        return ry.ST.cylinder, [rng.uniform(0.06, 0.14), rng.uniform(0.02, 0.033)]
    return ry.ST.ssBox, [rng.uniform(0.03, 0.06), rng.uniform(0.04, 0.1), rng.uniform(0.05, 0.12), 0.003]


def draw_places(rng, count):
    """Places within reach, 12 cm apart, and beside the tray."""
    places = []
    while len(places) < count:
        place = rng.uniform([-0.4, 0.12], [0.2, 0.55])
        if all(np.linalg.norm(place - other) > 0.12 for other in places):
            places.append(place)
    return places


def draw(rng):
    """What the robot believes, the world, and the names of the things that it is to move."""
    C = ry.Config()
    C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
    tray = C.addFrame("tray", "table").setShape(ry.ST.ssBox, [0.22, 0.26, 0.02, 0.005])
    tray.setPosition([0.4, 0.2, TABLE + 0.01]).setContact(1)
    for i, eye in enumerate(EYES):
        C.addFrame(f"cam{i}").setPose(camera_pose(eye, [0, 0.3, 0.72]))
        C.getFrame(f"cam{i}").setAttributes({"focalLength": 1.1, "width": 640, "height": 480})
    names = [f"thing{i}" for i in range(rng.integers(2, 5))]
    world = C.copy()
    *places, stranger = draw_places(rng, len(names) + 1)
    for i, (name, place) in enumerate(zip(names, places, strict=True)):
        shape, size = draw_shape(rng)
        add_thing(world, name, shape, size, place, rng.uniform(-np.pi, np.pi))
        add_thing(C, name, shape, size, [-0.9, -0.4 + 0.2 * i], 0.0)  # nobody knows where it is
    shape, size = draw_shape(rng)
    add_thing(world, "stranger", shape, [*size[:2], size[2] + 0.08, size[3]] if len(size) > 2 else size, stranger, 0.3)
    return C, world, names, names[: rng.integers(1, 3)]


def push(bot, name, rng):
    """Moves a thing to a free place nearby."""
    world = bot.getWorld()
    others = [f for f in world.getFrames() if f.getName() in ("tray", "stranger") or f.getName().startswith("thing")]
    pose = world.getFrame(name).getPose()
    for _ in range(100):
        angle, far = rng.uniform(-np.pi, np.pi), rng.uniform(0.06, 0.1)
        place = pose[:2] + far * np.array([np.cos(angle), np.sin(angle)])
        gaps = [np.linalg.norm(place - f.getPosition()[:2]) for f in others if f.getName() != name]
        if min(gaps) > 0.12 and -0.42 < place[0] < 0.22 and 0.1 < place[1] < 0.58:
            bot.setFramePose(name, [*place, *pose[2:]])
            return True
    return False


def is_on_tray(world, name):
    tray, thing = world.getFrame("tray"), world.getFrame(name)
    off = abs(thing.getPosition() - tray.getPosition())
    return bool(off[0] < 0.13 and off[1] < 0.15 and thing.getPosition()[2] > TABLE + 0.03)


def run(seed, move, cell):
    rng = np.random.default_rng(seed)
    C, world, names, wanted = draw(rng)
    bot = ry.BotOp(world)
    map = ry.OccupancyMap(C, region=REGION, cell=cell)
    observer = ry.SceneObserver(
        lambda: [image(bot.getWorld(), f"cam{i}", rng) for i in range(len(EYES))],
        names,
        support="table",
        prior="anywhere",
        map=map,
    )
    observer.observe(C)
    lost = [name for name in names if observer.seen[name].status != ry.SeenStatus.seen]
    stranger = world.getFrame("stranger").getPosition()
    plan = ry.planTask(C, " ".join(f"(on tray {name})" for name in wanted))
    if not plan.feasible:
        return f"no plan: {plan.message}", False, lost
    moved = not move or (len(wanted) == 1 and push(bot, wanted[0], rng))
    execution = plan.run(bot, observe=observer)
    for event in execution:
        if not moved and event.kind == ry.TaskEventKind.grip:
            other = next((name for name in reversed(wanted) if name not in str(event)), wanted[0])
            moved = push(bot, other, rng)
    there = bot.getWorld()
    off = np.linalg.norm(there.getFrame("stranger").getPosition() - stranger)
    missing = [name for name in wanted if not is_on_tray(there, name)]
    if off > 0.01:
        return f"the unknown thing moved by {1e3 * off:.0f} mm", False, lost
    if missing:
        return f"{missing} not on the tray: {execution.result.message}", False, lost
    return "carried out", True, lost


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--scenes", type=int, default=20)
    parser.add_argument("--first", type=int, default=0, help="seed of the first scene")
    parser.add_argument("--move", action="store_true", help="somebody moves one of the things")
    parser.add_argument("--cell", type=float, default=0.02, help="side of the cells of the map, m")
    args = parser.parse_args()
    warnings.simplefilter("ignore", ry.KinegraphWarning)
    done = 0
    for seed in range(args.first, args.first + args.scenes):
        began = time.perf_counter()
        what, good, lost = run(seed, args.move, args.cell)
        done += good
        note = f" (first not seen: {', '.join(lost)})" if lost else ""
        print(f"scene {seed}: {what[:200]}{note}, {time.perf_counter() - began:.0f} s", flush=True)
    print(f"{done} of {args.scenes} carried out{' with one thing moved' if args.move else ''}")


if __name__ == "__main__":
    main()
