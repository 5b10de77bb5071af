#!/usr/bin/env python3
"""Counts the instructions of each kernel with valgrind and compares them with recorded counts.

    python benchmarks/instructions.py build/dev/benchmarks/kernels [--record]

Unlike times, the counts are the same on a busy machine. They depend on the compiler and on the processor features that
the C library uses. `instructions.json` therefore has the conditions of its counts; under other conditions, and without
valgrind, nothing is compared and the exit status is 77. It is 1 if a kernel needs over 5 % more than recorded. Then
make the kernel leaner, or record the new count with --record in the same commit if it is worth it.
"""

from __future__ import annotations

import argparse
import json
import re
import shutil
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).parent.parent
RECORD = Path(__file__).parent / "instructions.json"
COUNTS = {  # few and many calls: the difference excludes the setup
    "forward kinematics": (100, 2100),
    "Jacobian": (100, 2100),
    "position": (100, 2100),
    "Jacobian, batch": (256, 25856),
    "pose, batch": (256, 25856),
    "collisions": (16, 176),
    "chain of 100": (10, 210),
    "chain of 1000": (1, 21),  # linear: ten times those of 100
    "load": (2, 6),
    "inverse kinematics": (16, 176),
}


def count(model: str, kernel: str, calls: int) -> int:
    command = ["valgrind", "--tool=cachegrind", "--cache-sim=no", "--cachegrind-out-file=/dev/null"]
    run = subprocess.run([*command, model, ROOT / "models", kernel, str(calls)], capture_output=True, text=True)
    total = re.search(r"I +refs: +([\d,]+)", run.stderr)
    if run.returncode or not total:
        sys.exit(f"{kernel}: {run.stderr}")
    return int(total[1].replace(",", ""))


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("model", help="the compiled benchmarks/kernels.cpp")
    parser.add_argument("--record", action="store_true", help="record the counts for later comparisons")
    options = parser.parse_args()
    if not shutil.which("valgrind"):
        print("valgrind is not installed")
        return 77
    conditions = subprocess.check_output([options.model, "--conditions"], text=True).strip()
    recorded = json.loads(RECORD.read_text()) if RECORD.exists() else {"conditions": "", "kernels": {}}
    if not options.record and recorded["conditions"] != conditions:
        print(f"recorded under other conditions: {recorded['conditions']}; here: {conditions}")
        return 77
    kernels, grown = {}, []
    print(f"{'instructions per call':28}{'recorded':>12}{'now':>12}")
    for kernel, (few, many) in COUNTS.items():
        now = (count(options.model, kernel, many) - count(options.model, kernel, few)) // (many - few)
        before = recorded["kernels"].get(kernel, now)
        kernels[kernel] = now
        print(f"{kernel:28}{before:12d}{now:12d}  {100 * (now / before - 1):+.1f} %")
        if now > 1.05 * before:
            grown.append(kernel)
    if options.record:
        RECORD.write_text(json.dumps({"conditions": conditions, "kernels": kernels}, indent=2) + "\n")
        return 0
    if grown:
        print("over 5 % more than recorded:", ", ".join(grown))
    return 1 if grown else 0


if __name__ == "__main__":
    sys.exit(main())
