"""tools/nightly.sh runs every benchmark, and tools/collect_results.py lists every stage."""

import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).parent.parent.parent.parent
SCRIPT = (ROOT / "tools" / "nightly.sh").read_text()

# Parts of other benchmarks, pictures to be compared by eye, and one that needs a program compiled by hand.
NOT_RUN = {
    "control_peers",
    "panda_peers",
    "planning_peers",
    "stereo_cameras",
    "everyday_objects",
    "everyday_scenes",
    "komo_family",
    "look_features",
    "look",
    "aligator_horizon",
}


def test_every_benchmark_is_a_stage():
    scripts = {path.stem for path in (ROOT / "benchmarks").glob("*.py")}
    run = set(re.findall(r"^ *bench (\w+)", SCRIPT, re.MULTILINE)) | set(re.findall(r"benchmarks/(\w+)\.py", SCRIPT))
    assert scripts - run == NOT_RUN


def test_a_page_of_results_lists_every_stage():
    done = subprocess.run(
        [sys.executable, "-c", "import collect_results; print(*collect_results.stage_names())"],
        cwd=ROOT / "tools",
        capture_output=True,
        text=True,
        check=True,
    )
    names = done.stdout.split()
    assert {"tests", "clang_tests", "sanitize_tests", "tsan_tests", "tidy", "benchmark_komo"} <= set(names)
