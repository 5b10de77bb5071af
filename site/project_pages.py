"""Writes the pages that come from files beside docs/: the glossary and the citation."""

import re
from pathlib import Path

ISSUES = """## Questions and faults

Open an issue in the tracker of the repository. An issue on a fault needs four things: the version
(`python -c "import kinegraph; print(kinegraph.__version__)"`), the smallest input or program that shows it, what
happened, and what you expected. A proof of a security fault goes the way of [Security](security.md) instead.
[Questions and answers](faq.md) and [Troubleshooting](troubleshooting.md) come first.
"""


def glossary(contributing: str) -> str:
    """The page of the terms, from the section "Glossary"; its third column is for authors only."""
    section = contributing.partition("\n## Glossary\n")[2].partition("\n## ")[0]
    lines = []
    for line in section.strip().splitlines():
        cells = re.split(r"(?<!\\)\|", line)
        lines.append("|".join([*cells[:3], ""]) if len(cells) > 3 else line)
    return "\n".join(["# Glossary", "", *lines, ""])


def citation(file: str) -> str:
    """The page on how to cite, from CITATION.cff."""
    fields = dict(re.findall(r'(?m)^([\w-]+): "?(.+?)"?$', file))
    author = " and ".join(f"{{{name}}}" for name in re.findall(r"(?m)^ +- name: (.+)$", file))
    entry = {
        "author": author,
        "title": f"{{{fields['title']}}}",
        "version": f"{{{fields['version']}}}",
        "year": f"{{{fields['date-released'][:4]}}}",
        "note": f"{{{fields['license']} license}}",
    }
    bibtex = ["@software{kinegraph,", *(f"  {key} = {value}," for key, value in entry.items()), "}"]
    lines = ["# Citation and contact", "", fields["message"].replace("as below", "as follows"), ""]
    return "\n".join([*lines, "```bibtex", *bibtex, "```", "", ISSUES])


def writePages(repository: Path, out: Path) -> None:
    (out / "glossary.md").write_text(glossary((repository / "CONTRIBUTING.md").read_text()))
    (out / "citation.md").write_text(citation((repository / "CITATION.cff").read_text()))
