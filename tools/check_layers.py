#!/usr/bin/env python3
"""Checks who includes whom: every room of src/kinegraph may include only the rooms that this table allows it.

A room that has become a hall is divided into rooms of its own, such as geometry/distance. Where the table names `geometry`,
all of its rooms are meant.
"""

import re
import sys
from pathlib import Path

SOURCE = Path(__file__).parent.parent / "src" / "kinegraph"

EVERYTHING = ["base", "math", "geometry", "kinematics", "scene", "formats", "features", "nlp", "solvers", "ik", "komo"]
EVERYTHING += ["planning", "rendering", "viewer", "front"]

BELOW: dict[str, list[str]] = {
    "base": [],
    "math": ["base"],
    "gfile": ["base"],
    "geometry/shapes": ["base", "math"],
    "geometry/distance": ["base", "math", "geometry/shapes"],
    "geometry/files": ["base", "math", "geometry/shapes"],
    "nlp": ["base", "math"],
    "solvers/interface": ["base", "math", "nlp"],
    "solvers/problems": ["base", "math", "nlp", "solvers/interface"],
    "solvers/algebra": ["base", "math", "nlp"],
    "solvers/methods": ["base", "math", "nlp", "solvers/interface", "solvers/problems", "solvers/algebra"],
    "solvers": ["base", "math", "nlp", "solvers/interface", "solvers/problems", "solvers/algebra", "solvers/methods"],
    "solvers/sampling": ["base", "math", "nlp", "solvers"],
    "kinematics": ["base", "math", "geometry"],
    "scene": ["base", "math", "gfile", "geometry", "kinematics"],
    "formats": ["base", "math", "gfile", "geometry", "kinematics", "scene"],
    "features": ["base", "math", "geometry", "kinematics", "scene"],
    "ik": ["base", "math", "geometry", "kinematics", "scene"],
    "komo": ["base", "math", "geometry", "kinematics", "scene", "features", "nlp"],
    "planning": ["base", "math", "geometry", "kinematics", "scene", "features", "nlp", "komo", "solvers"],
    "rendering": ["base", "math", "geometry", "kinematics", "scene"],
    "viewer": ["base", "math", "gfile", "geometry", "kinematics", "scene", "formats"],
    "front": EVERYTHING,
    ".": EVERYTHING,
}


def allowed(room: str, other: str) -> bool:
    """Whether a file of `room` may include one of `other`."""
    return other == room or any(other == below or other.startswith(below + "/") for below in BELOW[room])


def main() -> int:
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
    print("\n".join(dict.fromkeys(problems)) if problems else f"layers: {len(BELOW)} rooms, all includes point down")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
