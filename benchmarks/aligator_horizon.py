"""Compares a receding horizon by Kinegraph's Mpc with aligator, in turns: times, and costs of the solutions.

    pip install libaligator==0.19.1 cmeel-eigen     (in an environment of its own; P is its cmeel.prefix)
    g++ -std=c++20 -O2 -DNDEBUG -DBOOST_MPL_LIMIT_LIST_SIZE=30 -DBOOST_MPL_CFG_NO_PREPROCESSED_HEADERS \
        -DPINOCCHIO_ENABLE_TEMPLATE_INSTANTIATION -DALIGATOR_ENABLE_TEMPLATE_INSTANTIATION \
        -DALIGATOR_MULTITHREADING_OFF \
        -IP/include -IP/include/pinocchio/deprecated -IP/include/eigen3 benchmarks/aligator_horizon.cpp -o horizon \
        -LP/lib -Wl,-rpath,P/lib -laligator -lpinocchio_default -lfmt -lmimalloc
    python benchmarks/aligator_horizon.py ./horizon

A Panda follows a figure of eight: 20 slices of 50 ms, least squares of accelerations and of the gripper's distance,
limits of joints and velocities, no collisions. Both solve the same problems, each from its own previous solution,
shifted. Times are processor times, from Python and from C++, of the fastest of three rounds per problem.
"""

import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

import kinegraph as ry
from control import SLICES, TAU, VELOCITY, eight, panda

STEPS, OF_TARGET = 400, 100.0


def horizon(C):
    komo = ry.KOMO(C, SLICES * TAU, round(1 / TAU), 2, False)
    komo.addControlObjective([], 2, 1e-1)
    komo.addObjective([], ry.FS.jointLimits, [], ry.OT.ineq)
    komo.addObjective([], ry.FS.jointState, [], ry.OT.ineq, [1], VELOCITY, order=1)
    komo.addObjective([], ry.FS.jointState, [], ry.OT.ineq, [-1], -VELOCITY, order=1)
    komo.addObjective([], ry.FS.positionDiff, ["l_gripper", "target"], ry.OT.sos, [np.sqrt(OF_TARGET)])
    return komo


def of_motion(C):
    """Returns the cost of the squared accelerations in a slice."""
    komo = ry.KOMO(C, SLICES * TAU, round(1 / TAU), 2, False)
    komo.addControlObjective([], 2, 1e-1)
    path = np.tile(C.getJointState(), (SLICES, 1))
    path[-1, 0] += TAU**2  # an acceleration of 1 rad/s^2 in the last slice
    return float(np.sum(np.array(komo.nlp().evaluate(path.ravel())[0]) ** 2))


def cost(C, weight, q, velocity, path, targets):
    rows = np.vstack([q - TAU * velocity, q, path])
    accelerations = np.diff(rows, 2, axis=0) / TAU**2
    places = C.evalBatch(ry.FS.position, ["l_gripper"], path)[0]
    return weight * np.sum(accelerations**2) + OF_TARGET * np.sum((places - targets) ** 2)


def run(evaluations, problems=None):
    """Returns microseconds, paths and problems (q, velocity, targets); solves `problems` if they are given."""
    C = panda()
    home = np.array(C.getFrame("l_gripper").getPosition())
    mpc = ry.Mpc(horizon(C), evaluations=evaluations)
    q, velocity = np.array(C.getJointState()), np.zeros(7)
    ahead = TAU * np.arange(1, SLICES + 1)
    spent, paths, solved = [], [], []
    for i in range(STEPS):
        targets = home + eight(i * TAU + ahead)
        if problems:
            q, velocity, targets = problems[i]
        begun = time.thread_time_ns()
        mpc.setPoses("target", targets)
        mpc.step(q, velocity)
        spent.append(1e-3 * (time.thread_time_ns() - begun))
        solved.append((q, velocity, targets))
        paths.append(np.array(mpc.getPath()))
        q, velocity = paths[-1][0], (paths[-1][0] - q) / TAU
    return np.array(spent), paths, solved


def numbers(values):
    return " ".join(f"{value:.17g}" for value in np.ravel(values)) + "\n"


def scene(C):
    """Describes the chain for aligator's program: axes and positions of joints, position of the gripper."""
    C.setJointState(np.zeros(7))
    frames = [C.getFrame(name) for name in C.getJointNames()] + [C.getFrame("l_gripper")]
    lines, before = "7\n", None
    for frame in frames:
        R, p = frame.getRotationMatrix(), frame.getPosition()
        Rb, pb = before or (np.eye(3), np.zeros(3))
        relative = C.addFrame("").setPosition(Rb.T @ (p - pb)).setRotationMatrix(Rb.T @ R)
        if frame is not frames[-1]:
            lines += str(frame.getJointType()).removeprefix("JT.hinge") + " "
        lines += numbers([*relative.getPosition(), *relative.getQuaternion()])
        before = (R, p)
    return lines


def aligator(model, problems, weight, tolerance):
    lower, upper = panda().getJointLimits()
    text = scene(panda()) + f"{len(problems)} {SLICES} {TAU} {weight:.17g} {OF_TARGET}\n"
    text += numbers([*lower, *-VELOCITY, *upper, *VELOCITY])
    for q, velocity, targets in problems:
        text += numbers([*q, *velocity]) + numbers(targets)
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "problems"
        file.write_text(text)
        out = subprocess.run([model, str(file), str(tolerance)], capture_output=True, text=True, check=True).stdout
    rows = np.array([line.split() for line in out.splitlines()], dtype=float)
    return rows[:, 0], list(rows[:, 2:].reshape(len(rows), SLICES, 7))


def main():
    C = panda()
    weight = of_motion(C)
    _, _, problems = run(20)
    solvers = {
        "Kinegraph, to convergence": lambda: run(20, problems)[:2],
        "Kinegraph, one step": lambda: run(2, problems)[:2],
        "aligator, to 1e-3": lambda: aligator(sys.argv[1], problems, weight, 1e-3),
        "aligator, to 1e-4": lambda: aligator(sys.argv[1], problems, weight, 1e-4),
    }
    least = dict.fromkeys(solvers, np.inf)
    costs = {}
    for _ in range(3):
        for name, solve in solvers.items():
            spent, paths = solve()
            least[name] = np.minimum(least[name], spent)
            costs[name] = np.array(
                [cost(C, weight, *problem[:2], path, problem[2]) for problem, path in zip(problems, paths, strict=True)]
            )
    best = np.min(list(costs.values()), axis=0)[5:]
    for name, spent in least.items():
        more = costs[name][5:] / best - 1
        print(
            f"{name:28s} median {np.median(spent[5:]):7.0f} us, 99 % {np.quantile(spent[5:], 0.99):7.0f} us,"
            f" cost above the least: median {np.median(more):.1e}, most {more.max():.1e}"
        )


if __name__ == "__main__":
    main()
