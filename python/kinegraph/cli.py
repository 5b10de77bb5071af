"""The command `kinegraph`."""

from __future__ import annotations

import argparse
import logging
import re
import sys
import warnings
from collections.abc import Callable
from pathlib import Path
from typing import Any

from . import __version__
from ._core import (
    Config,
    ConfigurationViewer,
    Trajectory,
    checkFile,
    planMotion,
)
from .compatibility.parameters import params_get
from .demonstrate_command import addDemonstrate, demonstrateCommand
from .errors import ArgumentError, Error, FileError
from .model_paths import raiPath, similarModels
from .robot_files import robotNames, robotPath
from .run_player import playRuns
from .scene_overview import describeActuators, describeScene
from .tool_path_command import addToolPath, toolPathCommand

_MESHES = (".h5", ".ply", ".obj", ".stl", ".dae", ".glb")


class _CmakeDir(argparse.Action):
    """Prints where CMake finds the C++ package, and ends the program."""

    def __call__(self, parser: argparse.ArgumentParser, *_: object) -> None:
        try:
            from kinegraph_dev import cmakeDir
        except ImportError:
            parser.error("the C++ package is not installed: pip install kinegraph-dev")
        print(cmakeDir())
        parser.exit()


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="kinegraph",
        description="Robot scenes, inverse kinematics, motion planning and optimization.",
        epilog="A missing FILE is searched among the models of the package (panda/panda.g, scenarios/pandaSingle.g) and "
        "among the robots of installed packages (kinegraph robots).",
    )
    parser.add_argument("--version", action="version", version=f"kinegraph {__version__}")
    parser.add_argument(
        "--cmake-dir", action=_CmakeDir, nargs=0, help="print the folder for kinegraph_DIR (package kinegraph-dev)"
    )
    commands = parser.add_subparsers(dest="command", required=True, metavar="COMMAND")

    demo = commands.add_parser("demo", help="a Franka Panda follows a wandering target, live in the browser")
    demo.add_argument("--forever", action="store_true", help="run until Ctrl-C")
    demo.add_argument("--seconds", type=float, default=20.0, help="duration (default: 20)")
    demo.add_argument(
        "--rate", type=float, default=60.0, help="targets per second; 0: as many as possible (default: 60)"
    )
    demo.add_argument("--seed", type=int, default=0, help="seed of the target's path (default: 0)")
    demo.add_argument("--no-view", action="store_true", help="compute only")

    view = commands.add_parser("view", help="show a scene or mesh file in the browser until a key is pressed")
    view.add_argument("file", help="scene, mesh, or recorded run (.kgr)")
    view.add_argument("other", nargs="?", help="another recorded run, played beside the first in step")
    view.add_argument("--html", metavar="HTML", help="write a page of recorded runs instead of showing it")
    view.add_argument("--watch", action="store_true", help="reload the scene whenever the file changes")

    render = commands.add_parser("render", help="render a picture of a scene file, without a display")
    render.add_argument("file")
    render.add_argument("-o", "--output", default="out.png", metavar="PNG", help="output file (default: out.png)")
    render.add_argument("--camera", metavar="FRAME", help="camera frame (default: an outside view of the whole scene)")
    render.add_argument("--pos", type=_numbers(3), metavar="X,Y,Z", help="position of the camera, m")
    render.add_argument(
        "--target", type=_numbers(3), metavar="X,Y,Z", help="point at the picture's center, m (default: the scene's)"
    )
    render.add_argument("--joints", metavar="Q", help="joint values, rad or m: 0,0.5,...; or the name of a state")
    render.add_argument("--size", metavar="WIDTHxHEIGHT", help="pixels (default: those of the camera)")

    info = commands.add_parser("info", help="describe the content of a scene file")
    info.add_argument("file")
    info.add_argument("--frames", action="store_true", help="one line per frame, not only per moving part")

    commands.add_parser("robots", help="list the robots of installed packages")

    plan = commands.add_parser("plan", help="plan a collision-free motion to a goal; exit status 1 if none is found")
    plan.add_argument("file")
    plan.add_argument(
        "--goal",
        required=True,
        nargs="+",
        metavar="GOAL",
        help="name of a joint state, a number per joint, or FRAME=X,Y,Z (or X,Y,Z,QW,QX,QY,QZ, or another frame)",
    )
    plan.add_argument(
        "--start", nargs="+", metavar="START", help="name of a joint state, or numbers (default: the scene's)"
    )
    plan.add_argument("--margin", type=float, default=0.0, help="distance to obstacles, m (default: 0)")
    plan.add_argument("--optimize", default="time", choices=["time", "length", "clearance"], help="(default: time)")
    plan.add_argument("--seed", type=int, default=0, help="seed of random configurations (default: 0)")
    plan.add_argument("--time-limit", type=float, default=float("inf"), help="s (default: none)")
    plan.add_argument(
        "-o", "--output", metavar="CSV", help="output file: rows of time, joint values, velocities, accelerations"
    )
    plan.add_argument("--rate", type=float, default=100.0, help="rows of the output file per second (default: 100)")
    plan.add_argument("--no-view", action="store_true", help="print only")

    addToolPath(commands)

    reach = commands.add_parser(
        "reachability", help="compute the reachable cells of a robot, within limits and without collisions"
    )
    reach.add_argument("file", help="a scene: .g, .urdf, .xml, .xacro")
    reach.add_argument("--frame", help="the reaching frame (default: the last frame moved by a joint)")
    reach.add_argument("--spacing", type=float, default=0.1, help="spacing of the grid, m (default: 0.1)")
    reach.add_argument(
        "--directions",
        type=int,
        default=0,
        help="number of directions of the frame's z axis, tried at each cell (default: 0, any orientation)",
    )
    reach.add_argument("--workers", type=int, help="threads (default: one per processor)")
    reach.add_argument("-o", "--output", metavar="FILE", help="output file with a row per cell: .csv or .parquet")
    reach.add_argument("--picture", metavar="PNG", help="picture of the scene with the reached cells")
    reach.add_argument("--no-view", action="store_true", help="print only")

    pairs = commands.add_parser(
        "selfcollisions", help="find the pairs of a robot's parts that can collide, in random configurations"
    )
    pairs.add_argument("file")
    pairs.add_argument("--root", metavar="FRAME", help="the robot's first frame (default: the file's first one)")
    pairs.add_argument("--samples", type=int, default=10000, help="number of configurations (default: 10000)")
    pairs.add_argument("--seed", type=int, default=0, help="seed of the configurations (default: 0)")
    pairs.add_argument("--margin", type=float, default=0.0, help="smaller distances are collisions, m (default: 0)")
    pairs.add_argument(
        "-o", "--output", metavar="SRDF", help="output file with the pairs to be ignored, for a URDF of the same robot"
    )

    addDemonstrate(commands)

    check = commands.add_parser("check", help="report errors and warnings in scene files; exit status 1 with an error")
    check.add_argument("files", nargs="+", metavar="FILE")
    check.add_argument("--strict", action="store_true", help="warnings count as errors")
    return parser


def _check(files: list[str], strict: bool) -> int:
    errors = warnings = 0
    for file in files:
        try:
            found = checkFile(file)
        except Error as error:
            print(f"{file}: error: {error}")
            errors += 1
            continue
        for message in found["messages"]:
            print(message)
        errors += found["errors"]
        warnings += found["warnings"]
    print(f"{len(files)} checked: {errors} errors, {warnings} warnings")
    return 1 if errors or (strict and warnings) else 0


def _find(file: str) -> str:
    """Returns the path of a file, of the package's model, or of the installed robot of that name."""
    path = Path(file)
    if path.exists() or path.is_absolute():
        return file
    try:
        return raiPath(file)
    except FileError:
        if not path.suffix:
            return robotPath(file)
        if path.parent.is_dir() or not (near := similarModels(file)):
            return file  # the reader's error lists similar names
        raise FileError(f"no file or model '{file}'; similar names: {', '.join(near)}") from None


def _load(file: str) -> Config:
    """Loads a scene, or a mesh as a single frame."""
    config, file = Config(), _find(file)
    if Path(file).suffix.lower() in _MESHES:
        config.addFrame(Path(file).stem, "", f"mesh: <{Path(file).resolve()}>")
    else:
        config.addFile(file)
    return config


def _view(file: str, watch: bool) -> None:
    if watch:
        file = _find(file)
        if not Path(file).exists():
            raise FileError(f"scene file '{file}' does not exist")
        Config().watchFile(file)
    else:
        _load(file).view(True, file)


def _target(text: str) -> tuple[str, object]:
    """Parses FRAME=X,Y,Z as a target of inverse kinematics."""
    frame, _, place = text.partition("=")
    try:
        return frame, [float(number) for number in place.split(",")]
    except ValueError:
        return frame, place  # another frame


def _jointValues(config: Config, words: list[str], option: str) -> Any:
    """Parses numbers, or the name of a joint state."""
    if len(words) == 1 and words[0] in config.getStateNames():
        return config.getNamedState(words[0])
    try:
        return [float(number) for word in words for number in word.replace(",", " ").split()]
    except ValueError:
        known = ", ".join(config.getStateNames()) or "none"
        raise ArgumentError(
            f"{option} is {' '.join(words)!r}; expected numbers, or a joint state of the scene: {known}"
        ) from None


def _saveMotion(config: Config, motion: Trajectory, path: str, rate: float) -> None:
    motion.writeCsv(path, rate, config.getJointNames()[: config.getJointDimension()])


def _plan(options: argparse.Namespace) -> int:
    config = _load(options.file)
    words = options.goal
    goal = dict(_target(word) for word in words) if "=" in words[0] else _jointValues(config, words, "--goal")
    start = _jointValues(config, options.start, "--start") if options.start else None
    motion = planMotion(
        config,
        goal,
        start,
        margin=options.margin,
        optimize=options.optimize,
        seed=options.seed,
        time_limit=options.time_limit,
    )
    print(motion.explain())
    if not motion.feasible:
        return 1
    if options.output:
        _saveMotion(config, motion, options.output, options.rate)
    if not options.no_view:
        config.view_path(motion.path, max(1.0, motion.duration), True, "the motion")
    return 0


def _reachability(options: argparse.Namespace) -> None:
    from .reachable import reachability

    config = _load(options.file)
    found = reachability(config, options.frame, options.spacing, options.directions, workers=options.workers)
    print(found)
    if options.output:
        print(found.save(options.output))
    found.addTo(config)
    if options.picture:
        config.viewer().fit()
        print(config.viewer().savePng(options.picture))
    if not options.no_view:
        config.view(True, str(found))


def _info(file: str, frames: bool) -> None:
    config = _load(file)
    print(config.report())
    if frames:
        for frame in config:
            print(" ", frame)
        return
    print(describeScene(config))
    if actuators := describeActuators(config):
        print(actuators)
    if any(frame.asDict().get("contact", 0) < 0 for frame in config):
        print(
            "A shape with contact -k does not collide with links up to k joints above it; an SRDF file lists pairs instead."
        )


def _selfCollisions(options: argparse.Namespace) -> None:
    config = _load(options.file)
    root = options.root or config.getFrameNames()[0]
    matrix = config.selfCollisionMatrix(
        samples=options.samples, seed=options.seed, margin=options.margin, root=root, apply=True
    )
    width = max(len(name) for pair in matrix.pairs for name in pair[:2])
    for first, second, reason, share in matrix.pairs:
        print(f"{first:{width}}  {second:{width}}  {reason:9}  {100 * share:6.2f} %")
    print(matrix)
    if options.output:
        Path(options.output).write_text(config.asSRDF())


def _numbers(count: int) -> Callable[[str], list[float]]:
    """Returns a parser of arguments such as 1,2,3 or "1 2 3"."""

    def read(text: str) -> list[float]:
        words = text.replace(",", " ").split()
        if len(words) != count:
            raise argparse.ArgumentTypeError(f"{text!r} has {len(words)} numbers; expected {count}")
        try:
            return [float(word) for word in words]
        except ValueError:
            raise argparse.ArgumentTypeError(f"{text!r}; expected {count} numbers") from None

    return read


def _setJoints(config: Config, joints: str) -> None:
    """Sets the joints to a list of numbers, or to a named state."""
    words = joints.replace(",", " ").split()
    try:
        q = [float(word) for word in words]
    except ValueError:
        config.setJointState(config.getNamedState(joints))
        return
    if len(q) != config.getJointDimension():
        raise ArgumentError(f"--joints has {len(q)} numbers; the scene has {config.getJointDimension()} dofs")
    config.setJointState(q)


def _aim(viewer: ConfigurationViewer, pos: list[float] | None, target: list[float] | None) -> None:
    middle = viewer.fit()
    if pos or target:
        viewer.setCamera(pos or viewer.getCamera_pose()[:3], target or middle)


def _render(options: argparse.Namespace) -> None:
    output, size = options.output, options.size
    config = _load(options.file)
    if options.joints:
        _setJoints(config, options.joints)
    viewer = config.viewer()
    if options.camera:
        viewer.setCamera(options.camera)
    if size:
        numbers = re.fullmatch(r"(\d{1,6})x(\d{1,6})", size)
        if not numbers:
            raise ArgumentError(f"--size is {size!r}; expected pixels as in 640x360")
        viewer.setWindow("", int(numbers[1]), int(numbers[2]))
    if not output.endswith(".png"):
        raise ArgumentError(f"--output is {output!r}; expected a name that ends in .png")
    if not options.camera:
        _aim(viewer, options.pos, options.target)
    print(viewer.savePng(output))


def _printWarning(message: Warning | str, *_: object, **__: object) -> None:
    """Prints a warning without the line of this file that called the library."""
    print(f"kinegraph: warning: {message}", file=sys.stderr)


def main(arguments: list[str] | None = None) -> int:
    """Runs the command. Returns its exit status: 0, 1 for an error in a file, 2 for one in the arguments."""
    options = _parser().parse_args(arguments)
    with warnings.catch_warnings():
        warnings.showwarning = _printWarning
        return _run(options)


def _run(options: argparse.Namespace) -> int:
    logging.basicConfig(level=logging.INFO, format="%(message)s", stream=sys.stdout)
    try:
        if options.command == "demo":
            from .demo import followTarget

            seconds = float("inf") if options.forever else options.seconds
            return 0 if followTarget(seconds, options.rate, options.seed, not options.no_view).worst_error < 1e-3 else 1
        if options.command == "view":
            if Path(options.file).suffix == ".kgr":
                playRuns([options.file, *([options.other] if options.other else [])], options.html)
            else:
                _view(options.file, options.watch)
        if options.command == "render":
            _render(options)
        if options.command == "info":
            _info(options.file, options.frames)
        if options.command == "robots":
            print("\n".join(robotNames()))
        if options.command == "plan":
            return _plan(options)
        if options.command == "toolpath":
            return toolPathCommand(_load(options.file), options)
        if options.command == "reachability":
            _reachability(options)
        if options.command == "selfcollisions":
            _selfCollisions(options)
        if options.command == "demonstrate":
            demonstrateCommand(options)
        if options.command == "check":
            return _check(options.files, options.strict)
    except KeyboardInterrupt:
        print()
    except Error as error:
        print(f"kinegraph: {error}", file=sys.stderr)
        return 1
    except OSError as error:  # a file that cannot be written
        print(f"kinegraph: {error.filename}: {error.strerror}", file=sys.stderr)
        return 1
    return 0


def ry_view() -> int:
    """Runs the command `ry-view FILE` of the package robotic, which reloads scenes when they are edited."""
    parser = argparse.ArgumentParser(prog="ry-view", description="Shows a scene, reloaded after changes, or a mesh.")
    parser.add_argument("file", metavar="FILE")
    parser.add_argument("-v", "--version", action="version", version=__version__)
    file = parser.parse_args().file
    is_mesh = Path(file).suffix.lower() in _MESHES
    print(f"{file}: {'a mesh' if is_mesh else 'a scene'}")
    return main(["view", file, *([] if is_mesh else ["--watch"])])


def ry_info() -> int:
    """Runs the command `ry-info` of the package robotic: prints the version and the parameters."""
    argparse.ArgumentParser(prog="ry-info", description=ry_info.__doc__).parse_args()
    print(f"kinegraph {__version__}, in place of robotic\nraiPath: {raiPath()}\nparameters: {params_get()}")
    return 0
