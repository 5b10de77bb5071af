"""Writes the pages of the reference: each name once, in Python and then in C++."""

from collections import defaultdict
from pathlib import Path

import cpp_reference
import griffe
import python_reference
from member_texts import MemberTexts
from pages import pageOf


def pageText(
    package: griffe.Object,
    cpp: cpp_reference.CppNames,
    title: str,
    names: list[str],
    twins: dict[str, str],
    cpp_only: list[str],
    texts: MemberTexts,
    written: set[str],
    others: list[str],
) -> str:
    """A page; `written` has the names of C++ that are on a page already, and gets those of this one.

    `others` are further names of C++, in a section at the end.
    """

    def inCpp(name: str) -> list[str]:
        written.add(name)
        return cpp.entry(name)

    lines = [f"# {title}", "", "```{py:currentmodule} kinegraph\n```", ""]
    for name in names:
        twin = twins.get(name)
        full = f"kinegraph::{twin}" if twin else None
        lines += python_reference.entry(package, name, full, texts, cpp.membersByName(twin or ""))
        if twin and twin not in written:
            lines += ["```{rubric} C++", "```", "", *inCpp(twin)]
    for name in cpp_only:
        if name in cpp.kinds and name not in written:
            lines += [f"## {name} (C++)", "", *inCpp(name)]
    lines += ["## More in C++", ""] if others else []
    for name in others:
        lines += inCpp(name)
    return "\n".join(lines)


def writePages(
    package: griffe.Object,
    cpp: cpp_reference.CppNames,
    pages: dict[str, tuple[str, list[str]]],
    twins: dict[str, str],
    cpp_only: dict[str, list[str]],
    texts: MemberTexts,
    out: Path,
) -> int:
    """Writes a page per subject.

    Args:
        pages: Title and names of Python per page.
        twins: Names of Python with that of the same thing in C++.
        cpp_only: Further names of C++ per page.
    Returns:
        The number of C++ names.
    """
    out.mkdir(parents=True, exist_ok=True)
    written: set[str] = set()
    placed = {*twins.values(), *(name for names in cpp_only.values() for name in names)}
    others: dict[str, list[str]] = defaultdict(list)
    for name, header in sorted(cpp.headers.items()):
        if name not in placed:
            others[pageOf(header)].append(name)
    for page, (title, names) in pages.items():
        text = pageText(package, cpp, title, names, twins, cpp_only.get(page, []), texts, written, others[page])
        (out / f"{page}.md").write_text(text)
    return len(written)
