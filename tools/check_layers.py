#!/usr/bin/env python3
"""Checks who knows whom: every room of src/kinegraph may include, and link to, only the rooms that this table allows it.

    check_layers.py            reads the includes of all sources
    check_layers.py BUILD      and what the objects of a build folder leave undefined: a function that is declared in a
                               room and defined in one above it is an arrow upwards, too

A room that has become a hall is divided into rooms of its own, such as geometry/distance. Where the table names `geometry`,
all of its rooms are meant.
"""

import json
import re
import subprocess
import sys
from collections import defaultdict
from pathlib import Path

SOURCE = Path(__file__).resolve().parent.parent / "src" / "kinegraph"

_CORE = ["common", "math"]
_MODEL = [*_CORE, "geometry", "kinematics", "collision"]
_SCENE = [*_MODEL, "gfile", "parsers", "scene"]
_PROBLEMS = [*_SCENE, "features", "nlp", "komo", "solvers"]
_PLANNING = [*_PROBLEMS, "ik", "trajectories", "rrt"]

EVERYTHING = [*_PLANNING, "control", "exporters", "trajectory_optimization", "planning", "logic", "task_planning"]
EVERYTHING += ["rendering", "simulation", "robot", "viewer", "api"]

BELOW: dict[str, list[str]] = {
    "common": [],
    "math": ["common"],
    "gfile": ["common"],
    "geometry/shapes": _CORE,
    "geometry/distance": [*_CORE, "geometry/shapes"],
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
    "parsers": [*_CORE, "gfile", "geometry"],
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
    "control": _PROBLEMS,
    "trajectory_optimization": [*_PROBLEMS, "trajectories"],
    "planning/steering": [*_SCENE, "features", "nlp", "rrt"],
    "planning/search": [*_SCENE, "features", "nlp", "rrt", "planning/steering"],
    "planning/smoothing": [*_PLANNING, "planning/steering", "planning/search"],
    "planning/dynamic_obstacles": [*_PLANNING, "planning/steering", "planning/search"],
    "planning": [
        *_PLANNING,
        *(f"planning/{room}" for room in ("steering", "search", "smoothing", "dynamic_obstacles")),
    ],
    "logic": ["common", "gfile"],
    "task_planning": [*_PROBLEMS, "ik", "logic"],
    "task_planning/lgp": [*_PROBLEMS, "logic", "task_planning"],
    "task_planning/search": [*_PLANNING, "logic", "planning", "task_planning"],
    "rendering": _SCENE,
    "simulation": [*_SCENE, "trajectories", "rendering"],
    "robot": [*_SCENE, "trajectories", "simulation"],
    "viewer/messages": _SCENE,
    "viewer": [*_SCENE, "exporters", "viewer/messages"],
    "api": EVERYTHING,
    ".": EVERYTHING,
}
PAGE = "client_page.cpp"  # written by the build, for the viewer


def allowed(room: str, other: str) -> bool:
    """Whether a file of `room` may include one of `other`."""
    return other == room or any(other == below or other.startswith(below + "/") for below in BELOW[room])


def include_problems() -> list[str]:
    """Rooms that the table does not name, and includes that it does not allow."""
    problems = []
    for file in sorted(SOURCE.rglob("*.[ch]*")):
        room = file.parent.relative_to(SOURCE).as_posix()
        if room not in BELOW:
            problems.append(f"src/kinegraph/{room}: unknown room; add it to the table in tools/check_layers.py")
            continue
        for number, line in enumerate(file.read_text().splitlines(), 1):
            match = re.match(r'#include "kinegraph/(.+)/[^/]+"', line)
            if match and not allowed(room, match[1]):
                place = file.relative_to(SOURCE.parent.parent)
                problems.append(f"{place}:{number}: {room} must not include {match[1]}")
    return list(dict.fromkeys(problems))


def room_of_object(source: Path) -> str | None:
    """The room that a compiled file belongs to; None if it is none of the library's. Files that CMake compiles at once
    are named after theirs: Unity/unity_geometry.distance.0_cxx.cxx."""
    if unity := re.fullmatch(r"unity_(.+)\.\d+_cxx\.cxx", source.name):
        return unity[1].replace(".", "/")
    if source.name == PAGE:
        return "viewer"
    return source.parent.relative_to(SOURCE).as_posix() if source.is_relative_to(SOURCE) else None


def objects(build: Path) -> dict[Path, str]:
    """The object files of the library in a build folder, each with its room."""
    found = {}
    for entry in json.loads((build / "compile_commands.json").read_text()):
        room = room_of_object(Path(entry["file"]))
        output = (
            entry.get("output") or entry["command"].split(" -o ")[1].split()[0]
        )  # older versions of CMake tell none
        if room and "/kinegraph.dir/" in output:
            found[build / output] = room
    return found


def symbol_problems(build: Path) -> tuple[list[str], int]:
    """Symbols that an object of a room needs and that only rooms which it must not know define; and how many objects
    were read."""
    rooms = objects(build)
    missing = [file.name for file in rooms if not file.exists()]
    if missing or not rooms:
        return [f"{build}: {len(missing)} of {len(rooms)} objects of the library are not there; build it before"], 0
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
    problems = include_problems()
    done = f"layers: {len(BELOW)} rooms, all includes point down"
    if len(sys.argv) > 1:
        more, count = symbol_problems(Path(sys.argv[1]).resolve())
        problems += more
        done += f", and so do the symbols that {count} objects need"
    print("\n".join(problems) if problems else done)
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
