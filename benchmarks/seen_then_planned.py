"""Plans motions in scenes that only depth images describe, and judges them in the true scenes.

    python benchmarks/seen_then_planned.py [--scenes 100] [--looks 0] [--cell 0.02] [--first 0]

Each scene is a Panda at a table with four to six things that its Config does not have; one of them stands behind
another one, seen from the first of two fixed cameras. Depths have the noise of a stereo camera, and holes. The hand is
to go low from one side to the other, between configurations that are free in the true scene. Unseen space behind what
was measured is blocked (unseen="shadows"). With `--looks N`, the camera at the wrist takes up to N further images, from
where nextView says. A plan goes through something if it collides in the true scene at one of 500 times.
"""

from __future__ import annotations

import argparse
import copy
import time

import numpy as np
from stereo_cameras import camera_pose, image

import kinegraph as ry

EYES = ([-0.7, 1.1, 1.45], [0.75, 1.0, 1.4])
REGION = [[-0.55, -0.05, 0.655], [0.55, 0.8, 1.25]]


def draw(rng):
    """The scene that the robot knows, and the true one."""
    C = ry.Config()
    C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
    C.getFrame("cameraWrist").setAttributes({"width": 320, "height": 240})
    for i, eye in enumerate(EYES):
        C.addFrame(f"cam{i}").setPose(camera_pose(eye, [0, 0.35, 0.75]))
        C.getFrame(f"cam{i}").setAttributes({"focalLength": 1.1, "width": 640, "height": 480})
    truth = copy.copy(C)
    places = [rng.uniform([-0.25, 0.2], [0.25, 0.6]) for _ in range(rng.integers(3, 6))]
    away = places[0] - np.array(EYES[0][:2])
    places.append(places[0] + 0.13 * away / np.linalg.norm(away))  # in the shadow of the first thing
    for i, place in enumerate(places):
        low = i == len(places) - 1
        height = rng.uniform(0.08, 0.14) if low else rng.uniform(0.15, 0.3)
        thing = truth.addFrame(f"thing{i}").setPosition([*place, 0.65 + height / 2])
        if rng.random() < 0.4:
            thing.setShape(ry.ST.cylinder, [height, rng.uniform(0.03, 0.05)])
        else:
            thing.setShape(ry.ST.box, [*rng.uniform(0.05, 0.12, 2), height])
        thing.setContact(1)
    return C, truth


def ends(truth, rng):
    """Configurations with the hand low on the left and on the right; none if 60 draws find none."""
    q = truth.getJointState()
    found = []
    for side in (-1, 1):
        for _ in range(60):
            truth.setJointState(q + 0.2 * rng.normal(size=7))
            target = rng.uniform([0.12, 0.25, 0.74], [0.38, 0.55, 0.85]) * [side, 1, 1]
            ik = ry.solveIk(truth, {"l_gripper": target}, margin=0.01)
            if ik.feasible:
                found.append(ik.q)
                break
    truth.setJointState(q)
    return found if len(found) == 2 else None


def is_free(truth, plan):
    return truth.isValid(np.array([plan.eval(t)[0] for t in np.linspace(0, plan.duration, 500)])).all()


def run(seed, looks, cell):
    rng = np.random.default_rng(seed)
    C, truth = draw(rng)
    pair = ends(truth, rng)
    if pair is None:
        return None
    start, goal = pair
    C.setJointState(start)
    truth.setJointState(start)
    map = ry.OccupancyMap(C, REGION, cell)
    map.update(C, [image(truth, camera, rng) for camera in ("cam0", "cam1")])
    map.attach(C, unseen="shadows")
    began = time.perf_counter()
    plan = ry.planMotion(C, goal, margin=0.002, max_start_penetration=cell)
    seconds = time.perf_counter() - began
    used, through = 0, False
    while plan.blockedByUnseen and used < looks:
        view = ry.nextView(C, map, "cameraWrist", plan)
        if not view.feasible:
            break
        through |= not is_free(truth, view.plan)
        C.setJointState(view.q)
        truth.setJointState(view.q)
        map.update(C, image(truth, "cameraWrist", rng))
        map.attach(C, unseen="shadows")
        used += 1
        plan = ry.planMotion(C, goal, margin=0.002, max_start_penetration=cell)
    through |= plan.feasible and not is_free(truth, plan)
    return plan, through, used, seconds


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--scenes", type=int, default=100)
    parser.add_argument("--first", type=int, default=0, help="seed of the first scene")
    parser.add_argument("--looks", type=int, default=0)
    parser.add_argument("--cell", type=float, default=0.02)
    args = parser.parse_args()
    planned, through, asked, times, looks = 0, 0, 0, [], 0
    for seed in range(args.first, args.first + args.scenes):
        result = run(seed, args.looks, args.cell)
        if result is None:
            print(f"scene {seed}: no free ends")
            continue
        plan, bad, used, seconds = result
        asked += 1
        planned += plan.feasible
        through += bad
        looks += used
        times.append(seconds)
        what = "planned" if plan.feasible else plan.message[:110]
        print(f"scene {seed}: {what}{', THROUGH' if bad else ''}, {used} looks, {1e3 * seconds:.0f} ms", flush=True)
    print(
        f"{planned} of {asked} planned, {through} through something, {looks} looks, median {1e3 * np.median(times):.0f} ms"
    )


if __name__ == "__main__":
    main()
