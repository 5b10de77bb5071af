"""The command `kinegraph toolpath`."""

from __future__ import annotations

import argparse
import math
from typing import Any

import numpy as np

from ._core import FS, Config, ToolPath, ToolPathPlan, planToolPath
from .film import saveFilm


def addToolPath(commands: Any) -> None:
    """Adds the arguments of the command to those of `kinegraph`."""
    tool = commands.add_parser(
        "toolpath", help="plan the motion of a tool along rows of points or poses; exit status 1 if there is none"
    )
    tool.add_argument("file")
    tool.add_argument("--frame", default="tool", help="the frame that moves along the path (default: tool)")
    tool.add_argument(
        "--points", required=True, nargs="+", metavar="FILE", help="a path each: rows x y z, with a normal, or with a "
        "quaternion; or a program of G-code"
    )  # fmt: skip
    tool.add_argument("--relative-to", metavar="FRAME", help="frame in whose coordinates rows are given")
    tool.add_argument("--free", choices=["x", "y", "z"], help="axis of the tool about which it may rotate")
    tool.add_argument("--travel", type=float, default=0.0, help="lean of the tool's z axis along the path, degrees")
    tool.add_argument("--work", type=float, default=0.0, help="lean of the tool's z axis to the left, degrees")
    tool.add_argument("--tilt", type=float, default=0.0, help="half angle of a cone around the free axis, degrees")
    tool.add_argument("--speed", type=float, default=0.1, help="m/s (default: 0.1)")
    tool.add_argument("--order", choices=["given", "free"], default="given", help="order of several paths")
    tool.add_argument("--tolerance", type=float, default=2e-5, help="distance from the path, m (default: 2e-5)")
    tool.add_argument("--margin", type=float, default=0.0, help="distance to obstacles, m (default: 0)")
    tool.add_argument("--touching", nargs="+", default=[], metavar="FRAME", help="frames that the tool may touch")
    tool.add_argument("--approach", type=float, default=0.0, help="length of an approach and a retract, m")
    tool.add_argument(
        "--flow", choices=["none", "approach", "path"], default="approach",
        help="where transfers end with a velocity (default: approach)",
    )  # fmt: skip
    tool.add_argument("--transfer", action="store_true", help="begin where the robot of the scene is")
    tool.add_argument("--velocity", type=float, help="limit of all joints, rad/s or m/s (default: the model's)")
    tool.add_argument("--acceleration", type=float, help="limit of all joints, rad/s^2 or m/s^2")
    tool.add_argument("--jerk", type=float, help="limit of all joints, rad/s^3 or m/s^3 (default: none)")
    tool.add_argument("--seed", type=int, default=0, help="seed of transfers (default: 0)")
    tool.add_argument("--time-limit", type=float, help="s (default: none)")
    tool.add_argument(
        "-o", "--output", metavar="CSV", help="output file: rows of time, joint values, velocities, accelerations"
    )
    tool.add_argument("--rate", type=float, default=100.0, help="rows of the output file per second (default: 100)")
    tool.add_argument("--picture", metavar="PNG", help="picture of the scene with the path, colored by speed")
    tool.add_argument("--film", metavar="FILE", help="film of the motion: .mp4 or .webm")
    tool.add_argument("--no-view", action="store_true", help="print only")


def toolPathCommand(config: Config, options: argparse.Namespace) -> int:
    """Plans, prints, writes and shows the motion; returns the exit status."""
    plan = _planned(config, options)
    if not plan:
        print(f"{plan.status.name}: {plan.message}")
        return 1
    _printPlan(plan)
    if options.output:
        plan.writeCsv(options.output, options.rate, config.getJointNames()[: config.getJointDimension()])
    rows = plan.sample(50.0)[1]
    _addCurve(config, plan, rows, options.frame)
    if options.picture:
        config.setJointState(rows[0])
        config.viewer().fit()
        print(config.viewer().savePng(options.picture))
    if options.film:
        print(saveFilm(options.film, config, rows, max(1.0, plan.duration)))
    if not options.no_view:
        config.view_path(rows, max(1.0, plan.duration), True, "the motion")
    return 0


def _path(file: str, options: argparse.Namespace) -> ToolPath:
    path = ToolPath.read(file, frame=options.frame, relativeTo=options.relative_to)
    if options.free:
        path.free(options.free)
    if options.travel or options.work:
        path.lean(math.radians(options.travel), math.radians(options.work))
    if options.tilt:
        path.tilt(math.radians(options.tilt))
    return path


def _planned(config: Config, options: argparse.Namespace) -> ToolPathPlan:
    return planToolPath(
        config,
        [_path(file, options) for file in options.points],
        speed=options.speed,
        order=options.order,
        tolerance=options.tolerance,
        margin=options.margin,
        touching=options.touching,
        approach=options.approach,
        retract=options.approach,
        flow=options.flow,
        transfer_from=config.getJointState() if options.transfer else None,
        velocity=options.velocity,
        acceleration=options.acceleration,
        jerk=options.jerk,
        seed=options.seed,
        time_limit=options.time_limit,
    )


def _printPlan(plan: ToolPathPlan) -> None:
    print(f"solved: {plan.duration:.2f} s, within {1e3 * plan.deviation[0]:.4f} mm of the path")
    for warning in plan.warnings:
        print(f"warning: {warning}")
    paths = len({path for _, path, *_ in plan.segments})
    for path, begin, end, speed, cause in plan.slow:
        which = f"path {path}, " if paths > 1 else ""
        print(f"{which}{begin:.3f} to {end:.3f} m: down to {speed:.4f} m/s, {cause}")


def _addCurve(config: Config, plan: ToolPathPlan, rows: np.ndarray, frame: str) -> None:
    """Adds the curve of the tool: green at its largest speed, over yellow to red at rest; gray on transfers."""
    points = config.evalBatch(FS.position, [frame], rows)[0]
    times = np.linspace(0.0, plan.duration, len(rows))
    share = np.array([plan.speed(t) for t in times])
    share = np.clip(share / max(share.max(), 1e-9), 0.0, 1.0)
    colors = 255.0 * np.stack([np.minimum(1, 2 - 2 * share), np.minimum(1, 2 * share), 0 * share], axis=1)
    colors[[plan.way(t)[0] < 0 for t in times]] = 128.0
    config.addFrame("tool_path_curve").setLines(points, colors, True)
