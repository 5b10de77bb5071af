#!/usr/bin/env python3
"""Writes the results of a release, docs/results/VERSION.md, from the logs of tools/nightly.sh.

    python tools/collect_results.py            from build/nightly; stages without a log are listed as not run
    python tools/collect_results.py --quick    from build/nightly_quick, to results.md there: samples are no results

The page begins with one table of all stages, and has the complete output of every benchmark below it.
"""

import argparse
import platform
import re
import subprocess
import tomllib
from datetime import UTC, datetime
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
LOGS = ROOT / "build" / "nightly"
QUICK_LOGS = ROOT / "build" / "nightly_quick"
HEADLINE = re.compile(r"(\d+% tests passed.*|\d+ passed.*|DONE .*|stat::number_of_executed_units.*)")
LONGEST_LOG = 20000  # characters of a benchmark's output


def stage_names() -> list[str]:
    """Returns the stages of nightly.sh in their order, as far as their names are written there."""
    script = (ROOT / "tools" / "nightly.sh").read_text()
    names = []
    for kind, name in re.findall(r"^ *(stage|bench) (\w+) ", script, re.MULTILINE):
        names.append(f"benchmark_{name}" if kind == "bench" else name)
    return list(dict.fromkeys(names))


def stages(logs: Path) -> dict[str, tuple[str, str, str]]:
    """Returns result, time and command of each stage."""
    found = dict.fromkeys(stage_names(), ("not run", "", ""))
    record = logs / "stages.tsv"
    for line in record.read_text().splitlines() if record.exists() else []:
        name, result, seconds, command = line.split("\t")
        minutes, rest = divmod(int(seconds), 60)
        found[name] = (result, f"{minutes} min {rest} s" if result[:3] != "not" else "", command)
    return found


def log_of(logs: Path, name: str) -> str:
    log = logs / f"{name}.log"
    text = log.read_text(errors="replace") if log.exists() else ""
    return re.sub(r"\x1b\[[0-9;]*[A-Za-z]", "", text).replace(f"{ROOT}/", "").strip()


def headline(logs: Path, name: str) -> str:
    """Returns the line of a log that sums it up, for the table: that of the test runner, or nothing."""
    found = [] if name.startswith("benchmark_") else HEADLINE.findall(log_of(logs, name))
    return found[-1].strip("= ").replace("|", "/") if found else ""


def machine() -> list[tuple[str, str]]:
    def run(*command: str) -> str:
        try:
            done = subprocess.run(command, capture_output=True, text=True, cwd=ROOT, check=True)
        except (OSError, subprocess.CalledProcessError):
            return "not installed"
        return done.stdout.splitlines()[0].strip()

    cpu = re.findall(r"^model name\s*: (.*)$", Path("/proc/cpuinfo").read_text(), re.MULTILINE)
    return [
        ("commit", run("git", "rev-parse", "--short", "HEAD")),
        ("date", datetime.now(UTC).strftime("%Y-%m-%d")),
        ("processor", f"{cpu[0]}, {len(cpu)} cores" if cpu else platform.processor()),
        ("system", f"{platform.system()} {platform.machine()}"),
        ("compilers", f"{run('g++', '--version')}; {run('clang++', '--version')}"),
    ]


def page(version: str, logs: Path) -> str:
    found = stages(logs)
    lines = [
        f"# Results of {version}",
        "",
        "<!-- written by tools/collect_results.py from a run of `make nightly` -->",
        "",
    ]
    if any(result != "not run" for result, _, _ in found.values()):
        lines += ["| | |", "|---|---|", *(f"| {name} | {value} |" for name, value in machine()), ""]
    lines += ["| stage | result | time | summary |", "|---|---|---|---|"]
    lines += [f"| {name} | {result} | {time} | {headline(logs, name)} |" for name, (result, time, _) in found.items()]
    for name, (_, _, command) in found.items():
        if command and name.startswith("benchmark_"):
            short = re.sub(r"\S*/bin/python", "python", command.replace(f"{ROOT}/", ""))
            lines += ["", f"## {name.removeprefix('benchmark_')}", "", f"`{short}`", ""]
            lines += ["```", log_of(logs, name)[:LONGEST_LOG], "```"]
    return "\n".join([*lines, ""])


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quick", action="store_true", help="results of nightly.sh --quick")
    arguments = parser.parse_args()
    version = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]["version"]
    logs = QUICK_LOGS if arguments.quick else LOGS
    target = logs / "results.md" if arguments.quick else ROOT / "docs" / "results" / f"{version}.md"
    target.parent.mkdir(parents=True, exist_ok=True)
    target.write_text(page(version, logs))
    print(f"results: {target.relative_to(ROOT)}")
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
