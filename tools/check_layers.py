#!/usr/bin/env python3
"""Checks the layers of src/kinegraph: every room includes, and links to, only the rooms that BELOW allows it.

    check_layers.py                reads the includes of all sources, the members that a room defines for a class of
                                   another one, names of types, and the table in docs/architecture.md
    check_layers.py BUILD          also reads the undefined symbols of the objects in a build folder, because a function
                                   that is declared in a room but defined above it is an upward dependency, too
    check_layers.py --write-docs   writes the table in docs/architecture.md

A room of more than 40 files is divided into rooms of its own, such as geometry/distance. An entry `geometry` allows all
of its rooms.
"""

import json
import re
import subprocess
import sys
from collections import defaultdict
from pathlib import Path

from public_headers import publicHeaders

SOURCE = Path(__file__).resolve().parent.parent / "src" / "kinegraph"

_CORE = ["common", "math"]
_MODEL = [*_CORE, "geometry", "kinematics", "collision"]
_SCENE = [*_MODEL, "gfile", "parsers", "scene"]
_PROBLEMS = [*_SCENE, "features", "nlp", "komo", "solvers"]
_PLANNING = [*_PROBLEMS, "ik", "trajectories", "rrt"]

EVERYTHING = [*_PLANNING, "control", "exporters", "trajectory_optimization", "planning", "tool_paths"]
EVERYTHING += ["logic", "task_planning", "rendering", "perception", "simulation", "robot", "viewer", "api"]

BELOW: dict[str, list[str]] = {
    "common": [],
    "math": ["common"],
    "gfile": ["common"],
    "geometry/shapes": _CORE,
    "geometry/distance/closed_form": [*_CORE, "geometry/shapes"],
    "geometry/distance": [*_CORE, "geometry/shapes", "geometry/distance/closed_form"],
    "geometry/files": [*_CORE, "geometry/shapes"],
    "trajectories": _CORE,
    "nlp": _CORE,
    "solvers/interface": [*_CORE, "nlp"],
    "solvers/problems": [*_CORE, "nlp", "solvers/interface"],
    "solvers/algebra": [*_CORE, "nlp"],
    "solvers/methods": [*_CORE, "nlp", "solvers/interface", "solvers/problems", "solvers/algebra"],
    "solvers": [*_CORE, "nlp", "solvers/interface", "solvers/problems", "solvers/algebra", "solvers/methods"],
    "solvers/sampling": [*_CORE, "nlp", "solvers"],
    "solvers/sensitivity": [*_CORE, "nlp", "solvers"],
    "rrt": _CORE,
    "kinematics": [*_CORE, "geometry"],
    "collision": [*_CORE, "geometry", "kinematics"],
    "parsers/xml": [*_CORE, "gfile", "geometry"],
    "parsers/mjcf": [*_CORE, "gfile", "geometry", "parsers/xml"],
    "parsers/urdf": [*_CORE, "gfile", "geometry", "parsers/xml"],
    "parsers": [*_CORE, "gfile", "geometry", "parsers/xml", "parsers/mjcf", "parsers/urdf"],
    "scene/tree": [*_MODEL, "gfile", "parsers"],
    "scene/loading": [*_MODEL, "gfile", "parsers", "scene/tree"],
    "scene": [*_MODEL, "gfile", "parsers", "scene/tree", "scene/loading"],
    "exporters": _SCENE,
    "compatibility": _SCENE,
    "features": _SCENE,
    "ik": [*_SCENE, "features", "nlp"],
    "komo/path": [*_SCENE, "features", "nlp"],
    "komo/collision": [*_SCENE, "features", "nlp", "rrt", "komo/path"],
    "komo": [*_SCENE, "features", "nlp", "komo/path", "komo/collision"],
    "control": [*_PROBLEMS, "trajectories"],
    "trajectory_optimization": [*_PROBLEMS, "trajectories"],
    "planning/steering": [*_SCENE, "features", "nlp", "rrt"],
    "planning/search": [*_SCENE, "features", "nlp", "rrt", "planning/steering"],
    "planning/smoothing": [*_PLANNING, "planning/steering", "planning/search"],
    "planning/dynamic_obstacles": [*_PLANNING, "planning/steering", "planning/search"],
    "planning": [
        *_PLANNING,
        *(f"planning/{room}" for room in ("steering", "search", "smoothing", "dynamic_obstacles")),
    ],
    "tool_paths": [*_PLANNING, "ik", "planning"],
    "logic": ["common", "gfile"],
    "task_planning": [*_PROBLEMS, "ik", "logic"],
    "task_planning/lgp": [*_PROBLEMS, "logic", "task_planning"],
    "task_planning/motions": [*_PLANNING, "logic", "planning", "task_planning"],
    "task_planning/search": [*_PLANNING, "logic", "planning", "task_planning"],
    "rendering/gl": ["common"],
    "rendering": [*_SCENE, "rendering/gl"],
    "perception": [*_SCENE, "rendering"],
    "simulation": [*_SCENE, "trajectories", "rendering"],
    "robot": [*_SCENE, "trajectories", "simulation"],
    "viewer/messages": _SCENE,
    "viewer": [*_SCENE, "exporters", "viewer/messages"],
    "api/execution": EVERYTHING,
    "api": EVERYTHING,
    ".": EVERYTHING,
}
# Members that a class declares in its room and that another room defines, because they need rooms above the class:
# (room of the class, room of the definition) -> members. No other member may be defined outside of its room.
DOORS: dict[tuple[str, str], set[str]] = {
    ("komo", "api"): {
        "Komo::nlp",
        "Komo::solve",
        "Komo::solveFromMany",
        "Komo::view",
        "Komo::viewPlay",
        "Komo::viewer",
    },
    ("planning", "api"): {"MotionPlan::view", "PathFinder::view"},
    ("robot", "api"): {
        *{"BotOp::BotOp", "BotOp::cameras", "BotOp::getCameraFxycxy", "BotOp::getImageAndDepth"},
        *{"BotOp::getImageDepthPcl", "BotOp::moveAlong", "BotOp::moveCircular", "BotOp::moveLinear"},
        *{"BotOp::moveSequence"},
    },
    ("scene", "api"): {"Config::eval", "Config::view", "Config::viewPath", "Config::viewer", "Config::watchFile"},
    ("simulation", "api"): {"Recording::saveHtml", "Simulation::run", "Simulation::view"},
    ("tool_paths", "api"): {"ToolPathPlan::view"},
    ("viewer", "api"): {
        *{"ConfigViewer::camera", "ConfigViewer::fit", "ConfigViewer::focus", "ConfigViewer::getDepth"},
        *{"ConfigViewer::getRgb", "ConfigViewer::pictures", "ConfigViewer::savePng", "ConfigViewer::setCamera"},
        "ConfigViewer::setWindow",
    },
    ("task_planning/lgp", "api"): {"LgpTool::view_close", "LgpTool::view_solved"},
    ("task_planning/search", "api/execution"): {"TaskPlan::execute"},
    ("task_planning/search", "api"): {
        *{"TaskPlan::failedConfiguration", "TaskPlan::frames", "TaskPlan::play", "TaskPlan::view"},
    },
}
GROUPS = {
    "core": _CORE,
    "model": _MODEL,
    "scene stack": _SCENE,
    "problem stack": _PROBLEMS,
    "planning stack": _PLANNING,
}
CONTENTS = {
    "common": "errors, text, random numbers, option tables, cancellation, threads",
    "math": "poses, rotations, SIMD lanes, banded factorizations",
    "gfile": "the `.g` text format: lexer, parser, value tree, writer; no robotics",
    "geometry/shapes": "shapes, meshes, hulls, masses, as values",
    "geometry/distance/closed_form": "distances of boxes, cylinders and points by formulas",
    "geometry/distance": "collision bodies and the signed distance between two of them",
    "geometry/files": "meshes, grids and images read from files",
    "trajectories": "B-splines, the abstract `Trajectory`, time parameterization within limits; no robots",
    "nlp": "the optimization problem as a solver sees it, derivative checks, test problems",
    "solvers/interface": "options, results, evaluation hook: common to all methods",
    "solvers/problems": "views of a problem: penalties, relaxed constraints, a single cost",
    "solvers/algebra": "local models and their linear algebra, quadratic programs",
    "solvers/methods": "one file per method",
    "solvers": "`NlpSolver`, many problems at once, explanations of infeasibility",
    "solvers/sampling": "samples of the feasible set",
    "solvers/sensitivity": "derivatives of solutions with respect to problem parameters",
    "rrt": "RRT-Connect, search trees and shortcuts over an abstract search space",
    "kinematics": "joints, `KinematicModel`, `State`, Jacobians, dynamics, SIMD kernels",
    "collision": "near pairs of bodies, collision checks of configurations, edges and motions",
    "parsers/xml": "XML documents, findings in files, attributes of frames",
    "parsers/mjcf": "MJCF, translated to the value tree of a `.g` file",
    "parsers/urdf": "URDF and SRDF, translated likewise",
    "parsers": "which parser reads a file",
    "scene/tree": "the frames of a scene as data, compilation to a `KinematicModel`, edits of whole trees",
    "scene/loading": "value trees to frames, joints and shapes",
    "scene": "`Config` and `Frame`, the scene that people edit",
    "exporters": "scenes written as `.g`, YAML, dict, URDF, MJCF, glTF; surfaces as PLY, STL, COLLADA",
    "compatibility": "methods of earlier versions of the reference package",
    "features": "differentiable functions of frames, their registry, batches of configurations",
    "ik": "inverse kinematics in one call: restarts, lanes, threads",
    "komo/path": "time grid, modes, the State of every slice, contacts",
    "komo/collision": "continuous-collision constraints between slices",
    "komo": "objectives on a time grid; a `Config` becomes an `Nlp`",
    "control": "differential inverse kinematics, model predictive control",
    "trajectory_optimization": "multi-start, motions with B-spline control points as variables, skeletons",
    "planning/steering": "joint space, constraints, collision checks of edges, per-thread contexts",
    "planning/search": "path search: straight edges, RRT-Connect with restarts",
    "planning/smoothing": "shortcuts, rope shortcuts, repeated searches for shorter paths",
    "planning/dynamic_obstacles": "obstacles with known trajectories, timing among them",
    "planning": "`planMotion`, replanning, roadmaps, proofs of infeasibility",
    "tool_paths": "straight, circular and dense curves of a tool, `planToolPath`",
    "logic": "facts, rules, `.fol` and PDDL files, grounding, plan search; no geometry",
    "task_planning": "manipulation helpers, facts of a scene, task rules, waypoint problems",
    "task_planning/lgp": "`LGP_Tool` and its abstraction of actions",
    "task_planning/motions": "motions of the actions of a plan, and their contacts",
    "task_planning/search": "`planTask`, `checkTaskPlan`",
    "rendering/gl": "OpenGL: context, functions, programs, images",
    "rendering": "camera images without a display",
    "perception": "poses of known shapes from depth images",
    "simulation": "a scene in time: MuJoCo, motors, grippers, simulation state",
    "robot": "`BotOp`, robot drivers, rate limiter and safety limits",
    "viewer/messages": "messages between the server and the page",
    "viewer": "the web server of the page, the shown scene, edits made in a browser",
    "api/execution": "`plan.execute`: motions, observations, events, repairs",
    "api": "calls that combine rooms, short names for C++ programs",
    ".": "`kinegraph.h`, the header for users",
}
MOST_FILES = 40  # of a room without rooms
PAGE = "client_page.cpp"  # written by the build, for the viewer
DOCS = SOURCE.parent.parent / "docs" / "architecture.md"
TABLE = re.compile(r"(?<=<!-- written by tools/check_layers.py --write-docs -->\n).*?(?=<!-- end -->)", re.DOTALL)


def allowed(room: str, other: str) -> bool:
    """Returns whether a file of `room` may include one of `other`."""
    return other == room or any(other == below or other.startswith(below + "/") for below in BELOW[room])


def include_problems() -> list[str]:
    """Returns the rooms that are missing from BELOW, and the includes that it does not allow."""
    problems = []
    for folder in [SOURCE / room for room in BELOW]:
        if len(files := list(folder.glob("*.*"))) > MOST_FILES and not any(f.is_dir() for f in folder.iterdir()):
            problems.append(f"{folder.name}: {len(files)} files; divide it into rooms of at most {MOST_FILES}")
    for file in sorted(SOURCE.rglob("*.[ch]*")):
        room = file.parent.relative_to(SOURCE).as_posix()
        if room not in BELOW:
            problems.append(
                f"src/kinegraph/{room}: unknown room; add it to BELOW and CONTENTS in tools/check_layers.py"
            )
            continue
        for number, line in enumerate(file.read_text().splitlines(), 1):
            match = re.match(r'#include "kinegraph/(.+)/[^/]+"', line)
            if match and not allowed(room, match[1]):
                place = file.relative_to(SOURCE.parent.parent)
                problems.append(f"{place}:{number}: {room} must not include {match[1]}")
    return list(dict.fromkeys(problems))


def door_problems() -> list[str]:
    """Returns the members that are defined outside of their class's room and missing from DOORS, and the reverse."""
    rooms = defaultdict(set)
    for header in SOURCE.rglob("*.h"):
        for name in re.findall(r"^(?:class|struct) (\w+)[^;]*?\{", header.read_text(), re.MULTILINE):
            rooms[name].add(header.parent.relative_to(SOURCE).as_posix())
    found: dict[tuple[str, str], set[str]] = defaultdict(set)
    for file in SOURCE.rglob("*.cpp"):
        room, text = file.parent.relative_to(SOURCE).as_posix(), file.read_text()
        local = set(re.findall(r"^\s*(?:class|struct) (\w+)", text, re.MULTILINE))
        for name, member in re.findall(r"^(?!using|return|\s)[^\n;=]*?\b(\w+)::(~?\w+)\(", text, re.MULTILINE):
            if name in rooms and name not in local and room not in rooms[name]:
                found[min(rooms[name]), room].add(f"{name}::{member}")
    problems = []
    for (home, room), members in sorted(found.items()):
        for member in sorted(members - DOORS.get((home, room), set())):
            problems.append(f"{room} defines {member} of {home}; define it there, or add it to DOORS")
    for (home, room), members in DOORS.items():
        for member in sorted(members - found.get((home, room), set())):
            problems.append(f"tools/check_layers.py: {room} does not define {member} of {home}; remove it from DOORS")
    return problems


def namespace_of(file: Path, public: set[str]) -> str:
    """Returns the inner namespace of what a header declares: none for the public face, else the one of its room."""
    room = file.relative_to(SOURCE).parts[0]
    is_public = file.relative_to(SOURCE.parent).as_posix() in public or room == file.name
    return "" if is_public else f"{room}_internal"


def blocks(text: str) -> list[tuple[str, str]]:
    """Returns the parts of a file in namespace kinegraph, each with its inner namespace."""
    parts = re.split(r"^namespace kinegraph(?:::inline (\w+))? \{$", text, flags=re.MULTILINE)
    ends = (
        re.split(r"^\}(?: +// namespace kinegraph.*)?$", part, maxsplit=1, flags=re.MULTILINE)[0]
        for part in parts[2::2]
    )
    return list(zip([inner or "" for inner in parts[1::2]], ends, strict=True))


def name_problems() -> list[str]:
    """Returns what is not in the namespace of its file, and declarations of types outside of their namespaces. Returns
    types of one name in one room, or in a room and on the public face, too. CMake compiles the files of a room
    together, so that types of unnamed namespaces count."""
    public = set(publicHeaders(SOURCE.parent))
    problems = []
    shared: dict[tuple[str, str], set[str]] = defaultdict(set)
    local: dict[tuple[str, str], set[str]] = defaultdict(set)
    declared: list[tuple[str, str, str]] = []
    for file in sorted(SOURCE.rglob("*.[ch]*")):
        place, own = file.relative_to(SOURCE.parent.parent).as_posix(), namespace_of(file, public)
        for inner, text in blocks(file.read_text()):
            forward = re.findall(r"^(?:class|struct) (\w+);$", text, re.MULTILINE)
            declared += [(place, inner, name) for name in forward]
            if len(forward) == len(text.strip().splitlines()):
                continue
            of_public = re.search(r"^(?:struct|class|enum class) \w+::\w+", text, re.MULTILINE)
            if inner != own and (inner or (file.suffix == ".h" and not of_public)):
                where = f"kinegraph::inline {own}" if own else "kinegraph"
                problems.append(f"{place}: declares things outside of namespace {where}")
            unnamed = False
            for line in text.splitlines():
                unnamed = (unnamed or line == "namespace {") and line != "}  // namespace"
                if match := re.match(r"(?:struct|class|enum(?: class)?) (\w+)(?: final)?(?: : [^:].*)? \{", line):
                    (local if unnamed else shared)[inner, match[1]].add(place)
    homes: dict[str, set[str]] = defaultdict(set)
    for inner, name in shared:
        homes[name].add(inner)
    for (inner, name), files in [*shared.items(), *local.items()]:
        both = files | shared.get((inner, name), set()) | shared.get(("", name), set())
        if len(both) > len(files) or ((inner, name) in shared and len(files) > 1):
            problems.append(f"{name}: types in {' and '.join(sorted(both))}; rename one")
    for place, inner, name in declared:
        if name in homes and inner not in homes[name]:
            problems.append(f"{place}: declares {name} outside of namespace kinegraph::inline {min(homes[name])}")
    return problems


def room_list(rooms: list[str]) -> str:
    """Returns a list of rooms for people: the largest group of GROUPS that is contained, and the rooms beyond it."""
    if rooms == EVERYTHING:
        return "everything"
    for name, group in reversed(GROUPS.items()):
        if set(group) <= set(rooms):
            return ", ".join([name, *(room for room in rooms if room not in group)])
    return ", ".join(rooms) or "nothing"


def docs_table() -> str:
    """Returns the table of docs/architecture.md: the groups of rooms, then every room."""
    lines, before = [], []
    for name, group in GROUPS.items():
        inner = next((n for n, g in reversed(GROUPS.items()) if set(g) < set(group)), None)
        lines.append(f"- *{name}*: {', '.join([*([inner] if inner else []), *(r for r in group if r not in before)])}")
        before = group
    lines += ["", "| room | contents | may include |", "|---|---|---|"]
    lines += [f"| {room} | {CONTENTS[room]} | {room_list(below)} |" for room, below in BELOW.items()]
    return "\n".join(["", *lines, "", ""])


def docs_problems(write: bool = False) -> list[str]:
    """Compares the table in docs/architecture.md with this one, or writes it."""
    if BELOW.keys() != CONTENTS.keys():
        return [f"tools/check_layers.py: BELOW and CONTENTS differ in {sorted(BELOW.keys() ^ CONTENTS.keys())}"]
    text = DOCS.read_text()
    written = TABLE.sub(lambda _: docs_table(), text)
    if write:
        DOCS.write_text(written)
    elif written != text or not TABLE.search(text):
        return ["docs/architecture.md: the table of rooms is out of date; run tools/check_layers.py --write-docs"]
    return []


def room_of_object(source: Path) -> str | None:
    """Returns the room of a compiled file, or None if it does not belong to the library. Files that CMake compiles
    together are named after their room: Unity/unity_geometry.distance.0_cxx.cxx."""
    if unity := re.fullmatch(r"unity_(.+)\.\d+_cxx\.cxx", source.name):
        return unity[1].replace(".", "/")
    if source.name == PAGE:
        return "viewer"
    return source.parent.relative_to(SOURCE).as_posix() if source.is_relative_to(SOURCE) else None


def objects(build: Path) -> dict[Path, str]:
    """Returns the object files of the library in a build folder, each with its room."""
    found = {}
    for entry in json.loads((build / "compile_commands.json").read_text()):
        room = room_of_object(Path(entry["file"]))
        # Older versions of CMake give no "output".
        output = entry.get("output") or entry["command"].split(" -o ")[1].split()[0]
        if room and "/kinegraph.dir/" in output:
            found[build / output] = room
    return found


def symbol_problems(build: Path) -> tuple[list[str], int]:
    """Returns the symbols that are defined only in rooms which their users must not know, and the number of objects."""
    rooms = objects(build)
    missing = [file.name for file in rooms if not file.exists()]
    if missing or not rooms:
        return [f"{build}: {len(missing)} of {len(rooms)} objects of the library are missing; build it first"], 0
    listing = subprocess.run(
        ["nm", "-A", "--format=posix", *map(str, rooms)], check=True, capture_output=True, text=True
    )
    defined: dict[str, set[str]] = defaultdict(set)
    needed: dict[str, dict[str, str]] = defaultdict(dict)
    for line in listing.stdout.splitlines():
        file, _, rest = line.partition(": ")
        symbol, kind = rest.split()[:2]
        if kind in "Uwv":
            needed[symbol][rooms[Path(file)]] = Path(file).name
        elif kind.isupper() or kind == "u":
            defined[symbol].add(rooms[Path(file)])
    problems = []
    for symbol in sorted(needed.keys() & defined.keys()):
        for room, file in needed[symbol].items():
            if not any(allowed(room, other) for other in defined[symbol]):
                others = ", ".join(sorted(defined[symbol]))
                name = subprocess.run(["c++filt", symbol], check=True, capture_output=True, text=True).stdout.strip()
                problems.append(f"{file}: {room} must not need '{name}', which {others} defines")
    return problems, len(rooms)


def main() -> int:
    arguments = sys.argv[1:]
    problems = include_problems() + door_problems() + name_problems() + docs_problems(write="--write-docs" in arguments)
    doors = sum(map(len, DOORS.values()))
    done = f"layers: {len(BELOW)} rooms, all includes point down, {doors} members defined above their class"
    for build in (a for a in arguments if not a.startswith("--")):
        more, count = symbol_problems(Path(build).resolve())
        problems += more
        done += f", and so do the symbols that {count} objects need"
    print("\n".join(problems) if problems else done)
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
