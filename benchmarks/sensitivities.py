"""Measures derivatives of solutions, in comparison with the solutions themselves.

    python benchmarks/sensitivities.py

Prints processor times from Python in microseconds, of solving and differentiating in turns, medians of many rounds.
Also prints the deviation of dx/dp from differences of solutions that were converged to rounding (h = 1e-5).
"""

import time

import numpy as np

import kinegraph as ry

H = 1e-5


def reach(slices=20, collisions=False):
    """Returns a Panda's path to a box: 20 slices, order 2."""
    C = ry.Config()
    C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
    C.addFrame("box").setPosition([0.3, 0.3, 1.0]).setShape(ry.ST.marker, [0.1])
    komo = ry.KOMO(C, 1, slices, 2, collisions)
    komo.addControlObjective([], 2)
    if collisions:
        komo.addObjective([], ry.FS.accumulatedCollisions, [], ry.OT.eq)
    komo.addObjective([1], ry.FS.positionDiff, ["l_gripper", "box"], ry.OT.eq, [10])
    return C, komo


def timed(function, *arguments):
    start = time.process_time()
    result = function(*arguments)
    return 1e6 * (time.process_time() - start), result


def differentiated(result, parameters, v):
    s = result.sensitivity(*parameters)
    s.gradient(v)
    return s


def path(rounds, collisions):
    _, komo = reach(collisions=collisions)
    start = np.array(komo.getPath()).ravel()
    times = {"solve": [], "first gradient": [], "further gradient": []}
    for _ in range(rounds):
        komo.initWithPath(start.reshape(20, -1))
        solver = ry.NLP_Solver(komo.nlp())
        solver.setOptions(verbose=0)
        spent, result = timed(solver.solve)
        times["solve"].append(spent)
        v = np.ones(len(result.x))
        spent, s = timed(differentiated, result, ["box"], v)
        times["first gradient"].append(spent)
        times["further gradient"].append(timed(s.gradient, v)[0])
    return {what: np.median(spent) for what, spent in times.items()}, result.evals, s.evals


def inverse_kinematics(rounds):
    C = ry.Config()
    C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
    rng = np.random.default_rng(0)
    times = {"solve": [], "first gradient": [], "further gradient": []}
    v = np.ones(7)
    for _ in range(rounds):
        target = rng.uniform([-0.2, 0.2, 0.9], [0.3, 0.4, 1.1])
        spent, result = timed(ry.solveIk, C, {"l_gripper": target})
        if not result.feasible:
            continue
        times["solve"].append(spent)
        spent, s = timed(differentiated, result, [], v)
        times["first gradient"].append(spent)
        times["further gradient"].append(timed(s.gradient, v)[0])
    return {what: np.median(spent) for what, spent in times.items()}


def accuracy(collisions):
    """Returns the largest deviation from displaced solutions, relative to the largest entry."""

    def solved(moved):
        C, komo = reach(collisions=collisions)
        C.getFrame("box").setPosition(np.array([0.3, 0.3, 1.0]) + moved)
        komo.updateRootObjects(C)
        result = ry.NLP_Solver(komo.nlp()).setOptions(verbose=0).solve()
        return result.sensitivity("box")

    s = solved(np.zeros(3))
    differences = np.stack([(solved(H * e).x - solved(-H * e).x) / (2 * H) for e in np.eye(3)], axis=1)
    return np.abs(s.jacobian - differences).max() / np.abs(differences).max()


def show(name, times, more=""):
    solve = times["solve"]
    words = ", ".join(f"{what} {spent:.1f} ({spent / solve:.2f})" for what, spent in times.items())
    print(f"{name}: {words}{more}", flush=True)


def main():
    for collisions in (False, True):
        times, evals, polished = path(60, collisions)
        name = "path with collisions" if collisions else "path"
        show(name, times, f"; evaluations {evals} and {polished}; off by {accuracy(collisions):.1e}")
    show("solveIk", inverse_kinematics(2000))


if __name__ == "__main__":
    main()
