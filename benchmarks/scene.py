"""Measures how long a scene takes to copy, load and move.

    python benchmarks/scene.py                            this package alone
    python benchmarks/scene.py --reference ENV/bin/python   and the package `robotic` of another environment

The same three jobs on scenes of growing size, with the same numbers in both packages: a copy of a configuration of 50
frames (in the reference addConfigurationCopy into an empty one, as it has no copy), loading a file of 10,000 frames,
and setJointState followed by all world poses. Times are processor times. Prints the median of the repetitions, the
fastest, and ratios of medians.
"""

import argparse
import json
import os
import platform
import subprocess
import sys

JOBS = """
import json, os, statistics, sys, tempfile, time
import numpy as np
{package}
work = tempfile.mkdtemp(); os.chdir(work)

def timed(job, repetitions):
    times = []
    for _ in range(repetitions):
        start = time.process_time(); job(); times.append(time.process_time() - start)
    return statistics.median(times), min(times)

def chain(n, every):
    lines = ["a0: {{}}"]
    lines += [f"a{{i}} (a{{i // 3}}): {{{{ {{'joint: hingeX' if i % every == 0 else 'Q: [0 0 .1]'}}, shape: sphere, size: [.1] }}}}" for i in range(1, n)]
    name = f"chain{{n}}.g"; open(name, "w").write("\\n".join(lines)); return name

def load(name):
    C = ry.Config(); C.addFile(name); return C

def copied(C):
    D = ry.Config(); D.addConfigurationCopy(C)

result = {{}}
small = load(chain(50, 5))
result["copy of 50 frames"] = timed(lambda: {copy}, 300)
big = chain(10000, 5)
result["load 10,000 frames"] = timed(lambda: load(big), 5)
for n in (100, 1000, 10000):
    C = load(chain(n, 5)); q = np.zeros(C.getJointDimension())
    def move():
        C.setJointState(q); C.getFrameState()
    move()
    result[f"move {{n}} frames"] = timed(move, 30)
print("RESULT" + json.dumps(result))
"""


def measure(python: str, package: str, copy: str) -> dict[str, tuple[float, float]]:
    """Returns the median and the fastest time of each job, s, from a process of its own."""
    environment = dict(os.environ)
    if python != sys.executable:
        environment.pop("PYTHONPATH", None)  # it would give this package under the other's name
    code = JOBS.format(package=package, copy=copy)
    done = subprocess.run([python, "-c", code], capture_output=True, text=True, check=True, env=environment)
    line = next(line for line in done.stdout.splitlines() if line.startswith("RESULT"))
    return json.loads(line.removeprefix("RESULT"))


def main() -> None:
    parser = argparse.ArgumentParser(description="Times of copying, loading and moving scenes.")
    parser.add_argument("--reference", help="the Python of an environment with the package robotic")
    reference = parser.parse_args().reference
    print(f"{platform.processor() or platform.machine()}, Python {platform.python_version()}; median (fastest)")
    ours = measure(sys.executable, "import kinegraph as ry, copy", "copy.copy(small)")
    theirs = measure(reference, "import robotic as ry", "copied(small)") if reference else {}
    for job, (median, fastest) in ours.items():
        line = f"{job:22} {1e6 * median:12.1f} us ({1e6 * fastest:.1f})"
        if job in theirs:
            line += f"   robotic {1e6 * theirs[job][0]:12.1f} us ({1e6 * theirs[job][1]:.1f})   ratio {theirs[job][0] / median:.1f}"
        print(line)


if __name__ == "__main__":
    main()
