"""The files that name the version of the package agree, and the changelog describes it."""

import re
import tomllib
from pathlib import Path

ROOT = Path(__file__).parent.parent.parent.parent
VERSION = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]["version"]


def test_the_citation_has_the_version_of_the_package():
    assert re.search(rf"^version: {re.escape(VERSION)}$", (ROOT / "CITATION.cff").read_text(), re.MULTILINE)


def test_the_changelog_has_a_dated_section_for_the_version():
    changes = (ROOT / "CHANGELOG.md").read_text()
    assert re.search(rf"^## {re.escape(VERSION)} \(\d{{4}}-\d{{2}}-\d{{2}}\)$", changes, re.MULTILINE)


def test_breaking_changes_come_first_in_each_release():
    for section in re.split(r"^## (?=\d)", (ROOT / "CHANGELOG.md").read_text(), flags=re.MULTILINE)[1:]:
        headings = re.findall(r"^### (.*)$", section, re.MULTILINE)
        assert "Breaking changes" not in headings[1:]
