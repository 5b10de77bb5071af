"""Measures the processor time of pictures that the program draws without a browser.

    python benchmarks/pictures.py                  a Panda at a table, a shelf, a hall, small parts, glass and points
    python benchmarks/pictures.py --other FOLDER   also another build: a folder with its package, in turns

`first` is the first picture of the scene, `still` a repeated one, `moved` one after a motion of the robot, `depth` a
depth image. Each is the least of seven, then the median over the rounds, in ms of processor time over all threads.
The first scene's first picture also creates the OpenGL context. Figures are worse on a busy machine.
"""

from __future__ import annotations

import argparse
import json
import os
import statistics
import subprocess
import sys
import time
from collections.abc import Callable
from functools import partial
from pathlib import Path

import kinegraph as kg

ROOT = Path(__file__).resolve().parent.parent
SIZES = (640, 480), (128, 128)
REPEATS = 7


def least(draw: Callable[[], object]) -> float:
    """Returns the least processor time of a call, ms."""
    times = []
    for _ in range(REPEATS):
        began = time.process_time()
        draw()
        times.append(time.process_time() - began)
    return 1e3 * min(times)


def drawMoved(C: kg.Config) -> None:
    """Turns the first joint, and renders a picture."""
    q = C.getJointState()
    q[0] += 0.01
    C.setJointState(q)
    C.viewer().getRgb()


def measure() -> dict[str, float]:
    """Returns the times of all scenes."""
    from tests.viewer.five_scenes import SCENES

    rows = {}
    for name, make in SCENES.items():
        C, place, target = make()
        C.view(offscreen=True)
        viewer = C.viewer()
        for width, height in SIZES:
            viewer.setWindow("", width, height)
            viewer.setCamera(place, target)
            label = f"{name}, {width}x{height}"
            began = time.process_time()
            viewer.getRgb()
            rows[f"{label}, first"] = 1e3 * (time.process_time() - began)
            rows[f"{label}, still"] = least(viewer.getRgb)
            if C.getJointDimension() > 0:
                rows[f"{label}, moved"] = least(partial(drawMoved, C))
            rows[f"{label}, depth"] = least(viewer.getDepth)
    return rows


def inTurns(folders: list[str], rounds: int) -> list[dict[str, float]]:
    """Returns the medians of each build, whose processes run in turns."""
    runs: list[list[dict[str, float]]] = [[] for _ in folders]
    for _ in range(rounds):
        for folder, of_build in zip(folders, runs, strict=True):
            paths = [folder, str(ROOT)] if folder else [str(ROOT)]
            environment = {**os.environ, "PYTHONPATH": os.pathsep.join([*paths, os.environ.get("PYTHONPATH", "")])}
            command = [sys.executable, __file__, "--measure"]
            of_build.append(
                json.loads(subprocess.run(command, env=environment, check=True, stdout=subprocess.PIPE).stdout)
            )
    return [{key: statistics.median(run[key] for run in of_build) for key in of_build[0]} for of_build in runs]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--other")
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--measure", action="store_true", help=argparse.SUPPRESS)
    options = parser.parse_args()
    if options.measure:
        print(json.dumps(measure()))
        return
    results = inTurns([""] + ([options.other] if options.other else []), options.rounds)
    print("picture, ms of processor time" + ("    this   other   ratio" if options.other else ""))
    for label, value in results[0].items():
        others = "".join(f"{other[label]:8.1f}{other[label] / value:8.1f}" for other in results[1:])
        print(f"{label:28}{value:8.1f}{others}")


if __name__ == "__main__":
    main()
