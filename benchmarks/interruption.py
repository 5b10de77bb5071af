#!/usr/bin/env python3
"""Measures how soon Ctrl-C ends long calls, and checks their results.

    python benchmarks/interruption.py [--times 50] [--only solveIk]

Another process sends SIGINT at random times, 5 to 300 ms after the start. Each call must return a result with status
cancelled and finite numbers, or raise KeyboardInterrupt, as listed in the table. A further solve must work. `early`
counts calls that ended before the signal. For robots, the time runs until a moving robot receives the command to hold
(goal: 50 ms). Times are wall-clock times from the signal to the end, on a quiet machine. The goal is 0.1 s.
"""

import argparse
import signal
import subprocess
import sys
import threading
from time import perf_counter, sleep

import numpy as np

import kinegraph as ry

SENDER = """
import os, signal, sys, time
for line in sys.stdin:
    time.sleep(float(line))
    at = time.perf_counter()
    os.kill(os.getppid(), signal.SIGINT)
    print(at, flush=True)
"""


def panda() -> ry.Config:
    C = ry.Config()
    C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
    return C


def motion(slices: int, function=ry.FS.position) -> ry.KOMO:
    komo = ry.KOMO(panda(), 1, slices, 2, False)
    komo.addControlObjective([], 0, 1e-2)
    komo.addControlObjective([], 2, 1.0)
    komo.addObjective([], ry.FS.accumulatedCollisions, [], ry.OT.eq, [1.0])
    target = [0.3, 0.3, 1.1]
    komo.addObjective([1.0] if function == ry.FS.position else [], function, ["l_gripper"], ry.OT.eq, [10.0], target)
    return komo


def position(frame):
    return frame.getPosition(), frame.getPositionJacobian()


class Ripples:
    """A cost with many minima, evaluated slowly in Python."""

    dimension, types, bounds = 6, [ry.OT.sos, ry.OT.f], np.array([[-3.0] * 6, [3.0] * 6])

    def evaluate(self, x):
        y = np.sin(40 * x).sum()
        return np.array([y + 7, (x**2).sum()]), np.array([40 * np.cos(40 * x), 2 * x])


class Ring:
    dimension, types, bounds = 2, [ry.OT.ineq, ry.OT.ineq], np.array([[-2.0] * 2, [2.0] * 2])

    def evaluate(self, x):
        return np.array([x @ x - 1, 0.25 - x @ x]), np.array([2 * x, -2 * x])


def untilCancelled(once):
    def again():
        while True:
            ret = once()
            if ret.status.name == "cancelled":
                return ret

    return again


def ripples(method: str):
    def once():
        solver = ry.NLP_Solver().setPyProblem(Ripples()).setOptions(stopEvals=10**8, stopTolerance=1e-15, verbose=0)
        return solver.setSolver(getattr(ry.OptMethod, method)).setInitialization(np.full(6, 2.0)).solve(verbose=0)

    return untilCancelled(once)


def sampled(problem):
    nlp = problem if isinstance(problem, ry.NLP) else ry.NLP_Solver().setPyProblem(problem).getProblem()
    return lambda: ry.NLP_Sampler(nlp).setOptions(interiorSampleSteps=10**9).sample()


def solveFromRandom(komo: ry.KOMO) -> ry.SolverReturn:
    nlp = komo.nlp()
    return ry.NLP_Solver(nlp, verbose=0).setInitialization(nlp.getUniformSample()).solve()


def cases():
    C = panda()
    far = {"l_gripper": np.tile([5.0, 0.0, 0.0], (2000, 1))}
    Q = np.random.default_rng(0).uniform(-1, 1, (200000, 7))
    long = motion(4000)
    own = motion(30, position)
    many = [motion(4000) for _ in range(12)]
    short, impossible = motion(200), motion(200)
    impossible.addObjective([1.0], ry.FS.position, ["l_gripper"], ry.OT.eq, [10.0], [3.0, 0.0, 0.0])
    nowhere = np.tile(C.getJointState(), 200)
    yield "solve, 4000 slices", "result", untilCancelled(lambda: solveFromRandom(long))
    yield "solve, feature in Python", "result", untilCancelled(lambda: solveFromRandom(own))
    for method in ("augmentedLag", "LBFGS", "CMA", "NelderMead", "rprop"):
        yield f"solve in Python, {method}", "result", ripples(method)
    for threads in (1, 2):
        yield f"solveAll, {threads} threads", "result", lambda t=threads: ry.solveAll(many, threads=t)
        yield f"solveAll in Python, {threads}", "result", lambda t=threads: ry.solveAll([own, *many], threads=t)
        yield f"solveFromMany, {threads} threads", "result", lambda t=threads: many[0].solveFromMany(30, threads=t)
    yield "sampler", "result", sampled(ry.make_NLP_Problem("HalfCircle"))
    yield "sampler in Python", "result", sampled(Ring())
    yield "solveIk", "interrupt", lambda: ry.solveIk(C, {"l_gripper": [5.0, 0.0, 0.0]}, attempts=10**8)
    for threads in (1, 2):
        yield (
            f"solveIk, 2000 targets, {threads}",
            "interrupt",
            lambda t=threads: ry.solveIk(C, far, attempts=10**8, threads=t),
        )
        yield (
            f"getDistances, {threads} threads",
            "interrupt",
            lambda t=threads: [C.getDistances(Q, threads=t) for _ in range(9)],
        )
    yield "checkJacobian", "interrupt", lambda: short.nlp().checkJacobian(nowhere)
    yield "explain", "interrupt", lambda: [impossible.nlp().explain(nowhere) for _ in range(9)]
    yield "building a KOMO", "interrupt", lambda: [motion(10000).nlp() for _ in range(9)]


def heldAfter(realtime: bool, busy: bool, times: int, sender, rng) -> list[float]:
    """Returns the seconds from the signal until a moving robot is commanded to hold. `busy`: the script does other
    work.
    """
    C = panda()
    seconds = []
    for _ in range(times):
        bot = ry.BotOp(C, realtime=realtime)
        q = bot.get_qHome().copy()
        for _ in range(100):
            bot.move([q + 0.2 * np.eye(7)[0], q], [2.0])
        held = []

        def look(bot=bot, held=held):
            while bot.getMode() != ry.LoopMode.hold:
                sleep(0.0005)
            held.append(perf_counter())

        watcher = threading.Thread(target=look)
        watcher.start()
        sender.stdin.write(f"{rng.uniform(0.005, 0.3)}\n")
        sender.stdin.flush()
        try:
            while True:
                if busy:
                    sum(range(10**6))
                else:
                    bot.wait(C)
        except KeyboardInterrupt:
            pass
        at = float(sender.stdout.readline())
        watcher.join()
        seconds.append(held[0] - at)
        bot.close()
    return seconds


def isFinite(answer) -> bool:
    results = answer.results if isinstance(answer, ry.SolverReturns) else [answer]
    done = [ret for ret in results if ret.done]
    return bool(done) and all(len(ret.x) and np.isfinite(ret.x).all() for ret in done)


def wasCancelled(answer) -> bool:
    results = answer.results if isinstance(answer, ry.SolverReturns) else [answer]
    return any(ret.status.name == "cancelled" and ret.message == "interrupted by Ctrl-C" for ret in results) or not all(
        ret.done for ret in results
    )


def interrupted(call, sender, delay: float) -> tuple[str, float]:
    """Returns the kind of end, and its seconds after the signal."""
    sender.stdin.write(f"{delay}\n")
    sender.stdin.flush()
    try:
        answer = call()
        ended, how = perf_counter(), "early"
        if isinstance(answer, (ry.SolverReturn, ry.SolverReturns)) and wasCancelled(answer):
            how = "result" if isFinite(answer) else "numbers that are not finite"
    except KeyboardInterrupt:
        ended, how = perf_counter(), "interrupt"
    if how == "early":
        try:
            sleep(1)
        except KeyboardInterrupt:
            ended = perf_counter()
    return how, ended - float(sender.stdout.readline())


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--times", type=int, default=50)
    parser.add_argument("--only", default="")
    options = parser.parse_args()
    signal.signal(signal.SIGINT, signal.default_int_handler)  # also if a shell runs this in the background
    rng = np.random.default_rng(0)
    sender = subprocess.Popen([sys.executable, "-c", SENDER], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
    failed = False
    print(f"{'':32s} {'result':>7s} {'interrupt':>9s} {'early':>6s}   median    worst")
    for name, expected, call in cases():
        if not name.startswith(options.only):
            continue
        ways: dict[str, int] = {}
        seconds = []
        for _ in range(options.times):
            how, after = interrupted(call, sender, rng.uniform(0.005, 0.3))
            ways[how] = ways.get(how, 0) + 1
            if how != "early":
                seconds.append(after)
        wrong = set(ways) - {"result", "interrupt", "early"} or (expected == "interrupt" and "result" in ways)
        check = ry.NLP_Solver(motion(8).nlp(), verbose=0).solve()
        wrong = wrong or not check.feasible or not seconds
        failed = failed or bool(wrong)
        times = f"{1e3 * np.median(seconds):6.1f} ms {1e3 * max(seconds):6.1f} ms" if seconds else ""
        counts = " ".join(
            f"{ways.get(way, 0):{width}d}" for way, width in (("result", 7), ("interrupt", 9), ("early", 6))
        )
        print(f"{name:32s} {counts}   {times}{'   WRONG: ' + str(ways) if wrong else ''}", flush=True)
    for name, realtime, busy in (
        ("robot held, virtual time", False, False),
        ("robot held, real time", True, False),
        ("the same, script busy", True, True),
    ):
        if name.startswith(options.only):
            seconds = heldAfter(realtime, busy, options.times, sender, rng)
            print(f"{name:58s} {1e3 * np.median(seconds):6.1f} ms {1e3 * max(seconds):6.1f} ms", flush=True)
    sender.stdin.close()
    return int(failed)


if __name__ == "__main__":
    raise SystemExit(main())
