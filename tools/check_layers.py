#!/usr/bin/env python3
"""Checks who includes whom: every folder of src/kinegraph may include only the folders that this table allows it."""

import re
import sys
from pathlib import Path

SOURCE = Path(__file__).parent.parent / "src" / "kinegraph"

BELOW: dict[str, list[str]] = {
    "base": [],
    "math": ["base"],
    "gfile": ["base"],
    "geometry": ["base", "math"],
    "nlp": ["base", "math"],
    "solvers": ["base", "math", "nlp"],
    "kinematics": ["base", "math", "geometry"],
    "scene": ["base", "math", "gfile", "geometry", "kinematics"],
    "formats": ["base", "math", "gfile", "geometry", "kinematics", "scene"],
    "features": ["base", "math", "geometry", "kinematics", "scene"],
    "komo": ["base", "math", "geometry", "kinematics", "scene", "features", "nlp"],
    "planning": ["base", "math", "geometry", "kinematics", "scene", "features", "nlp", "komo", "solvers"],
    "rendering": ["base", "math", "geometry", "kinematics", "scene"],
    "viewer": ["base", "math", "gfile", "geometry", "kinematics", "scene", "formats"],
}


def main() -> int:
    problems = []
    for folder in sorted(path.name for path in SOURCE.iterdir() if path.is_dir()):
        if folder not in BELOW:
            problems.append(f"src/kinegraph/{folder}: unknown folder; add it to the table in tools/check_layers.py")
            continue
        for file in sorted((SOURCE / folder).rglob("*.[ch]*")):
            for number, line in enumerate(file.read_text().splitlines(), 1):
                match = re.match(r'#include "kinegraph/([^/"]+)/', line)
                if match and match[1] != folder and match[1] not in BELOW[folder]:
                    problems.append(
                        f"{file.relative_to(SOURCE.parent.parent)}:{number}: {folder} must not include {match[1]}"
                    )
    print("\n".join(problems) if problems else f"layers: {len(BELOW)} folders, all includes point down")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
