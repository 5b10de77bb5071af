"""Tells whether the repository is ready for a release, and the time of its commit."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path


def _git(root: Path, *arguments: str) -> str:
    return subprocess.run(["git", *arguments], cwd=root, check=True, capture_output=True, text=True).stdout.strip()


def commit_time(root: Path) -> int:
    """Returns the time of the last commit in seconds since 1970."""
    return int(_git(root, "log", "-1", "--format=%ct"))


def refuse_unready(root: Path, version: str) -> None:
    """Ends the program with one sentence per step of docs/releases.md that is missing."""
    missing = []
    if _git(root, "status", "--porcelain"):
        missing.append("there are uncommitted changes")
    if f"v{version}" not in _git(root, "tag", "--points-at", "HEAD").split():
        missing.append(f"the commit has no tag v{version}")
    if f"version: {version}" not in (root / "CITATION.cff").read_text():
        missing.append(f"CITATION.cff names another version than {version}")
    if not re.search(rf"^## {re.escape(version)}\b", (root / "CHANGELOG.md").read_text(), re.MULTILINE):
        missing.append(f"CHANGELOG.md has no section {version}")
    if missing:
        sys.exit("no release yet: " + "; ".join(missing) + " (--dirty tries it all the same)")
