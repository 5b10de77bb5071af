#!/usr/bin/env python3
"""Measures the speed of control loops, and how well they respect their constraints.

    python benchmarks/control.py [mpc] [diffik] [--steps 400] [--peers PYTHON ...]

`mpc`: a receding horizon of 20 slices of 50 ms, order 2. A Panda follows a figure of eight at 0.3 m/s within limits of
joints and velocities. It avoids itself, the table, and five spheres that cross its path, and executes its plan exactly.
Penetration is checked ten times between two calls. Times are the fastest of each call in five runs.

`diffik`: a gripper at 0.3 m/s (rms), 5 ms steps, 45 pairs: `free` along a figure of eight, `dip` through the table,
`far` out of reach. mink, pink (the 10 nearest pairs) and placo (no pairs) run in turns if one of the given Pythons has
them; see control_peers.py.

Times are processor times of the thread. Steps take microseconds, and the system timer interrupts some of them. `least`
uses the fastest time of each step in five runs, which compute the same bits.
"""

import argparse
import json
import subprocess
import tempfile
import time
from pathlib import Path

import control_peers
import numpy as np
import panda_peers

import kinegraph as ry

VELOCITY = np.array([2.175] * 4 + [2.61] * 3)
TAU, SLICES, SPHERES = 0.05, 20, 5


def panda(spheres=0):
    C = ry.Config()
    C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
    C.addFrame("target").setShape(ry.ST.marker, [0.1]).setPose(C.getFrame("l_gripper").getPose())
    for k in range(spheres):
        C.addFrame(f"sphere{k}").setShape(ry.ST.sphere, [0.06]).setContact(1).setPosition([0, 0, 5 + k])
    return C


def eight(t):
    return np.stack([0.2 * np.sin(1.5 * t), 0 * t, 0.1 * np.sin(3 * t)], axis=-1)


def sphere(k, t, aside):
    angle = t + k * 2 * np.pi / SPHERES
    return np.stack([0.35 * np.cos(angle), aside + 0.1 * np.sin(angle), 0.25 * np.sin(angle)], axis=-1)


def horizon(C):
    komo = ry.KOMO(C, SLICES * TAU, round(1 / TAU), 2, True)
    komo.addControlObjective([], 2, 1e-1)
    komo.addControlObjective([], 0, 1e-2)
    komo.addObjective([], ry.FS.accumulatedCollisions, [], ry.OT.eq)
    komo.addObjective([], ry.FS.jointLimits, [], ry.OT.ineq)
    komo.addObjective([], ry.FS.jointState, [], ry.OT.ineq, [1], VELOCITY, order=1)
    komo.addObjective([], ry.FS.jointState, [], ry.OT.ineq, [-1], -VELOCITY, order=1)
    komo.addObjective([], ry.FS.poseDiff, ["l_gripper", "target"], ry.OT.sos, [10])
    return komo


def least_distance(C, mpc, t, home, aside):
    least = np.inf
    for s in np.linspace(0.1, 1, 10) * TAU:
        for k in range(SPHERES):
            C.getFrame(f"sphere{k}").setPosition(home + sphere(k, t + s, aside))
        C.setJointState(mpc.at(s)[0])
        least = min(least, np.min(C.getNearestPoints()[0]))
    return least


def mpc_loop(steps, aside, looks, **options):
    """Returns seconds, results and errors (mm) of each call, the path, and the least distance (m) if `looks`."""
    C = panda(SPHERES)
    home = np.array(C.getFrame("l_gripper").getPosition())
    mpc = ry.Mpc(horizon(C), **options)
    q, velocity = np.array(C.getJointState()), np.zeros(7)
    ahead = TAU * np.arange(1, SLICES + 1)
    seconds, results, errors, path, least = [], [], [], [], np.inf
    for i in range(steps):
        t = i * TAU
        poses = {f"sphere{k}": home + sphere(k, t + ahead, aside) for k in range(SPHERES)}
        poses["target"] = home + eight(t + ahead)
        begun = time.thread_time_ns()
        for name, places in poses.items():
            mpc.setPoses(name, places)
        results.append(mpc.step(q, velocity))
        seconds.append(1e-9 * (time.thread_time_ns() - begun))
        if looks:
            least = min(least, least_distance(C, mpc, t, home, aside))
        q, before = mpc.getPath()[0], q
        velocity = (q - before) / TAU
        C.setJointState(q)
        path.append(q)
        errors.append(1e3 * np.linalg.norm(C.getFrame("l_gripper").getPosition() - home - eight(t + TAU)))
    return np.array(seconds), results, np.array(errors), np.array(path), least


def run_mpc(name, steps, aside, runs=5, **options):
    seconds, results, errors, path, least = mpc_loop(steps, aside, True, **options)
    for _ in range(runs - 1):
        again, _, _, same, _ = mpc_loop(steps, aside, False, **options)
        assert np.array_equal(path, same)
        seconds = np.minimum(seconds, again)
    us, evals = 1e6 * seconds[5:], np.mean([result.evals for result in results])
    infeasible = sum(not result.feasible for result in results)
    print(
        f"{name:44s} {np.median(us):7.0f} {np.quantile(us, 0.99):7.0f} {1e3 / np.median(us):6.2f} kHz"
        f" {evals:6.2f} evals  infeasible {infeasible:3d}  least distance {1e3 * least:6.2f} mm"
        f"  error {errors[40:].mean():6.2f} / {errors[40:].max():6.2f} mm"
    )


def diff_ik_loop(kind, steps):
    C = panda()
    frame = C.getFrame("target")
    home = np.array(frame.getPosition())
    ik = ry.DiffIk(C, velocity=VELOCITY)
    ik.addTask(ry.FS.poseDiff, ["l_gripper", "target"])
    seconds, path, dt = [], [], control_peers.DT
    for i in range(steps):
        position = control_peers.target(kind, home, (i + 1) * dt)
        begun = time.thread_time_ns()
        frame.setPosition(position)
        ik.step(dt)
        seconds.append(1e-9 * (time.thread_time_ns() - begun))
        path.append(np.array(C.getJointState()))
    return np.array(seconds), np.array(path)


def judge(name, kind, seconds, path, note=""):
    """Summarizes times and violations of a loop."""
    C = panda()
    home, start = np.array(C.getFrame("target").getPosition()), np.array(C.getJointState())
    poses = np.asarray(C.getFramePoses(path, ["l_gripper"])).reshape(len(path), 7)
    wanted = [control_peers.target(kind, home, (i + 1) * control_peers.DT) for i in range(len(path))]
    errors = 1e3 * np.linalg.norm(poses[:, :3] - wanted, axis=1)[200:]
    fastest = np.max(np.abs(np.diff(np.vstack([start, path]), axis=0)) / control_peers.DT / VELOCITY)
    lower, upper = C.getJointLimits()
    beyond = max(0.0, np.max(lower - path), np.max(path - upper))
    least = 1e3 * np.min(C.getNearestPoints(path)[0])
    us = 1e6 * np.asarray(seconds)[50:]
    print(
        f"{kind:5s} {name:12s} {np.median(us):8.2f} {np.quantile(us, 0.99):8.2f} {np.quantile(us, 0.999):8.2f}"
        f"  error {errors.mean():8.4f} / {errors.max():8.3f} mm  v/vmax {fastest:.4f}  beyond limits {beyond:.1e}"
        f"  distance {least:6.2f} mm{note}"
    )


def has(python, module):
    return subprocess.run([python, "-c", f"import {module}"], capture_output=True, check=False).returncode == 0


def run_diff_ik(steps, pythons, rounds=3):
    C = panda()
    scene = panda_peers.describe(ry, C, "l_gripper")
    C = panda()
    scene["q"], scene["home"] = list(C.getJointState()), list(C.getFrame("target").getPosition())
    scene["velocity"], scene["steps"] = VELOCITY.tolist(), steps
    peers = {name: python for name in control_peers.STEPS for python in pythons if has(python, name)}
    print(f"differential inverse kinematics, {steps} steps: median, 99 and 99.9 %, us a step")
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "scene.json"
        for kind in ("free", "dip", "far"):
            file.write_text(json.dumps({**scene, "loop": kind}))
            taken = {}
            for _ in range(rounds):
                taken.setdefault("kinegraph", []).append(diff_ik_loop(kind, steps))
                for name, python in peers.items():
                    script = str(Path(__file__).with_name("control_peers.py"))
                    done = subprocess.run([python, script, name, str(file)], capture_output=True, text=True, check=True)
                    answer = json.loads(done.stdout.splitlines()[-1])
                    taken.setdefault(name, []).append((np.array(answer["seconds"]), np.array(answer["path"])))
            for name, runs in taken.items():
                middle = sorted(runs, key=lambda run: np.median(run[0]))[rounds // 2]
                judge(name, kind, *middle)
            again = [diff_ik_loop(kind, steps) for _ in range(5)]
            assert all(np.array_equal(again[0][1], run[1]) for run in again)
            judge("least", kind, np.min([run[0] for run in again], axis=0), again[0][1])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("what", nargs="*", default=["mpc", "diffik"], choices=["mpc", "diffik"])
    parser.add_argument("--steps", type=int, default=400)
    parser.add_argument("--loop", type=int, default=4190, help="steps of diffik")
    parser.add_argument("--peers", nargs="*", default=[], metavar="PYTHON", help="Pythons with mink, pink or placo")
    arguments = parser.parse_args()
    if "mpc" in arguments.what:
        print("receding horizon: median and 99th percentile of the least time of each call in five runs, us")
        for place, aside in (("spheres beside the arm", 0.25), ("spheres that cross its way", 0.05)):
            run_mpc(f"{place}, to convergence", arguments.steps, aside)
            run_mpc(f"{place}, one step a call", arguments.steps, aside, evaluations=2)
    if "diffik" in arguments.what:
        run_diff_ik(arguments.loop, arguments.peers)


if __name__ == "__main__":
    main()
