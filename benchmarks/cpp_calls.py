#!/usr/bin/env python3
"""Measures the kinematics of a Panda in a C++ program: a new joint vector, the gripper's position and its Jacobian.

    python benchmarks/cpp_calls.py PROGRAM [--reference PATH_TO_REFERENCE_PYTHON] [--peers PATH_TO_PYTHON] [--rounds 11]

PROGRAM is Kinegraph's program of the build (build/dev/benchmarks/kinegraph_calls). For the package `robotic`
(--reference) and for Pinocchio (--peers) a small program is compiled by g++ with the headers and libraries of their
wheels, and Pinocchio's for this processor. All write 6 rows of Jacobian into an existing matrix, and use the same joint
vectors within the limits. `robotic` loads its own scenarios/pandaSingle.g, Pinocchio a chain of joints about z derived
from Kinegraph's. Positions and Jacobians are compared first.

Each round starts every program once, in turns. The time of a program in a round is the median of 100 samples, in
processor time.
"""

import argparse
import json
import os
import random
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

from tutorial_ratio import machine

SOURCES = Path(__file__).resolve().parent / "cpp_calls"
MODELS = Path(__file__).resolve().parent.parent / "models"
FRAME = "l_gripper"


def askPython(python, code):
    environment = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    with tempfile.TemporaryDirectory() as folder:  # the reference writes a log file to its working directory
        done = subprocess.run([python, "-c", code], env=environment, cwd=folder, capture_output=True, text=True)
    if done.returncode:
        sys.exit(f"{python}: {done.stderr[-1000:]}")
    return done.stdout.splitlines()[-1]


def compiled(folder, name, flags):
    out = str(Path(folder) / f"{name}_calls")
    command = ["g++", "-std=c++20", "-O3", "-DNDEBUG", "-march=native", "-w", str(SOURCES / f"{name}.cpp"), "-o", out]
    done = subprocess.run([*command, *flags], capture_output=True, text=True)
    if done.returncode:
        sys.exit(f"{name}: its program does not compile:\n{done.stderr[:3000]}")
    return out


def compileReference(folder, python):
    """Returns the command, without joint vectors, and the version."""
    code = "import json, os, robotic as r; print(json.dumps([os.path.dirname(r.__file__), r.raiPath('scenarios/pandaSingle.g'), r.version()]))"
    package, scene, version = json.loads(askPython(python, code))
    flags = [f"-I{package}/include/rai", f"-L{package}", "-lrai", f"-Wl,-rpath,{package}"]
    return [compiled(folder, "robotic", flags), scene, FRAME], version


def compilePinocchio(folder, python, chain):
    code = "import cmeel, pathlib; print(pathlib.Path(cmeel.__file__).parent.parent / 'cmeel.prefix')"
    prefix = Path(askPython(python, code))
    eigen = prefix / "include" / "eigen3"
    if not eigen.is_dir():
        prefixes = [Path(p) / "cmeel.prefix/include/eigen3" for p in sys.path if p]
        eigen = next((p for p in [*prefixes, Path("/usr/include/eigen3")] if p.is_dir()), None)
        if eigen is None:
            sys.exit("Pinocchio's headers need those of Eigen: pip install cmeel-eigen")
    flags = [
        "-DBOOST_MPL_LIMIT_LIST_SIZE=30",
        "-DBOOST_MPL_CFG_NO_PREPROCESSED_HEADERS",
        f"-I{prefix}/include",
        f"-I{eigen}",
    ]
    flags += [f"-L{prefix}/lib", "-lboost_serialization", f"-Wl,-rpath,{prefix}/lib"]
    return [compiled(folder, "pinocchio", flags), str(chain)]


def writeJointVectors(path, lower, upper, count=64):
    rng = random.Random(1)
    rows = [[low + rng.random() * (high - low) for low, high in zip(lower, upper)] for _ in range(count)]
    path.write_text("".join(f"{len(row)} {' '.join(map(repr, row))}\n" for row in rows))


def run(command, folder):
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, timeout=120)
    if done.returncode:
        sys.exit(f"{command[0]}: status {done.returncode}: {done.stderr[-1000:]}")
    return done.stdout


def compareAnswers(reports):
    """Exits unless all programs agree; the quaternions in the reference's file are rounded."""
    for name, runs in reports.items():
        rows = zip(reports["kinegraph"][0]["answers"], runs[0]["answers"])
        error = max(abs(a - b) for ours, theirs in rows for a, b in zip(ours, theirs, strict=True))
        print(f"{name + ':':12}{runs[0]['version']}, differs from Kinegraph by at most {error:.1e} (m, m/rad)")
        if not error < 1e-6:
            sys.exit(f"{name} has another robot")


def printTable(reports):
    print(f"{'µs per call':12}{'least':>9}{'median':>9}{'ratio':>9}{'over the rounds':>20}")
    middle = {name: [statistics.median(r["us"]) for r in runs] for name, runs in reports.items()}
    for name, runs in reports.items():
        least = min(min(r["us"]) for r in runs)
        ratios = [theirs / ours for theirs, ours in zip(middle[name], middle["kinegraph"])]
        spread = f"{min(ratios):.2f} - {max(ratios):.2f}"
        print(
            f"{name:12}{least:9.4f}{statistics.median(middle[name]):9.4f}{statistics.median(ratios):9.2f}{spread:>20}"
        )


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("model", help="the compiled benchmarks/cpp_calls/kinegraph.cpp")
    parser.add_argument("--reference", help="a Python with the reference package as `robotic`")
    parser.add_argument("--peers", help="a Python with Pinocchio")
    parser.add_argument("--rounds", type=int, default=11)
    options = parser.parse_args()
    if options.rounds < 1:
        parser.error("--rounds must be at least 1")
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        ours = [os.path.abspath(options.model), str(MODELS / "scenarios/pandaSingle.g"), FRAME]
        chain, vectors = folder / "chain.txt", folder / "joint_vectors.txt"
        chain.write_text(run(ours, folder))
        lower, upper = ([float(number) for number in line.split()[1:]] for line in chain.read_text().splitlines()[-2:])
        writeJointVectors(vectors, lower, upper)
        commands, versions = {"kinegraph": ours}, {"kinegraph": "this build"}
        if options.reference:
            commands["robotic"], versions["robotic"] = compileReference(folder, os.path.abspath(options.reference))
        if options.peers:
            commands["pinocchio"] = compilePinocchio(folder, os.path.abspath(options.peers), chain)
        reports = {name: [] for name in commands}
        for round_index in range(options.rounds):
            for name in list(commands)[:: 1 if round_index % 2 == 0 else -1]:
                lines = run([*commands[name], str(vectors)], folder).splitlines()
                report = json.loads(next(line for line in reversed(lines) if line.startswith('{"version"')))
                report["version"] = report["version"] or versions[name]
                reports[name].append(report)
    print("command: ", " ".join(["python", *sys.argv]))
    print("machine: ", machine())
    print("rounds:  ", options.rounds)
    compareAnswers(reports)
    print()
    printTable(reports)


if __name__ == "__main__":
    main()
