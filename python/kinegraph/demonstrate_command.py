"""The command `kinegraph demonstrate`."""

from __future__ import annotations

import argparse
from typing import Any


def addDemonstrate(commands: Any) -> None:
    """Adds the arguments of the command to those of `kinegraph`."""
    parser = commands.add_parser(
        "demonstrate", help="make a data set of LeRobot: plan a task in variations of a scene, and simulate it"
    )
    parser.add_argument("file", help="scene whose objects have a mass")
    parser.add_argument("--goal", required=True, help='goal of the task: "(on tray box)"')
    parser.add_argument("--episodes", type=int, default=100, help="number of episodes (default: 100)")
    parser.add_argument("-o", "--output", required=True, metavar="FOLDER", help="folder; a data set in it is continued")
    parser.add_argument("--cameras", default="", metavar="A,B", help="camera frames")
    parser.add_argument("--size", type=int, default=128, help="height and width of images, pixels (default: 128)")
    parser.add_argument("--fps", type=int, default=20, help="frames per second, a divisor of 100 (default: 20)")
    parser.add_argument("--seed", type=int, default=0, help="seed of all random numbers (default: 0)")
    parser.add_argument("--engine", choices=("threads", "processes", "ray"), default="processes")
    parser.add_argument("--workers", type=int, help="number of workers (default: number of processors)")
    parser.add_argument("--keep", choices=("success", "clean", "all"), default="success", help="episodes that are kept")
    parser.add_argument("--task", help="the task as a sentence (default: from the goal)")


def demonstrateCommand(options: argparse.Namespace) -> None:
    """Makes the data set, and prints its numbers."""
    from ._core import Config
    from .lerobot import demonstrate

    C = Config()
    C.addFile(options.file)
    made = demonstrate(
        C,
        options.goal,
        options.episodes,
        options.output,
        cameras=[name for name in options.cameras.split(",") if name],
        size=options.size,
        fps=options.fps,
        seed=options.seed,
        engine=options.engine,
        workers=options.workers,
        keep=options.keep,
        task=options.task,
    )
    print(made)
    for reason, count in sorted(made.failures.items(), key=lambda item: -item[1]):
        print(f"  {count} x {reason}")
