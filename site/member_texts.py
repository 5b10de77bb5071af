"""Descriptions of members of Python that have no docstring: those of the C++ enumerators, or of tables in docs/."""

import re
import xml.etree.ElementTree as ElementTree
from pathlib import Path

SPECIAL = {
    "__len__": "Returns the number of entries.",
    "__getitem__": "Returns an entry, or those of a slice.",
    "__iter__": "Iterates over the entries.",
    "__call__": "Calls the object.",
}
TABLES = {"ST": ("scenes.md", 1, "Size: {}."), "JT": ("scenes.md", 1, "Dofs: {}."), "SY": ("motion.md", 2, "{}.")}
NONE = {"ST": "No shape.", "JT": "No joint.", "SY": "No mode.", "OT": "No objective."}


def sentence(text: str) -> str:
    """Begins with a capital, unless the first word is a name, and ends with a period."""
    is_name = "_" in text.split()[0] or text[0] == "`"
    return (text if is_name else text[0].upper() + text[1:]).rstrip(".") + "."


def enumerators(xml: Path) -> dict[tuple[str, str], str]:
    """(enum, enumerator) -> comment, of the C++ headers."""
    texts = {}
    members = []
    for file in [xml / "namespacekinegraph.xml", *sorted(xml.glob("classkinegraph_1_1*.xml"))]:
        root = ElementTree.parse(file).getroot()
        outer = (root.findtext("compounddef/compoundname") or "").removeprefix("kinegraph").replace("::", "")
        members += [(outer + (member.findtext("name") or ""), member) for member in root.iter("memberdef")]
    for enum, member in members:
        for value in member.findall("enumvalue"):
            parts = [value.find(part) for part in ("briefdescription", "detaileddescription")]
            text = " ".join(" ".join("".join(part.itertext()).split()) for part in parts if part is not None).strip()
            if text:
                texts[enum, value.findtext("name") or ""] = sentence(text)
    return texts


def rows(page: Path) -> dict[str, list[str]]:
    """Rows of all tables of a page, by each of the names in code in their first cell."""
    found: dict[str, list[str]] = {}
    for line in page.read_text().splitlines():
        cells = [cell.strip() for cell in line.strip().strip("|").split(" | ")]
        if line.startswith("| `") and len(cells) > 1:
            for name in re.findall(r"`(\w+)", cells[0]):
                found.setdefault(name, cells)
    return found


class MemberTexts:
    """Descriptions by class and member."""

    def __init__(self, xml: Path, docs: Path, cpp_names: dict[str, str]):
        self.of_cpp = enumerators(xml)
        self.cpp_names = cpp_names
        self.pages = {page: rows(docs / page) for page, _, _ in TABLES.values()}

    def find(self, cls: str, member: str) -> str:
        """The description of a member; "" if there is none."""
        if member in SPECIAL:
            return SPECIAL[member]
        if member == "none" and cls in NONE:
            return NONE[cls]
        if cls in TABLES:
            page, column, form = TABLES[cls]
            cells = self.pages[page].get(member) or self.pages[page].get("_xyzabc" if member == "generic" else "")
            if cells and len(cells) > column:
                return sentence(form.format(cells[column].rstrip(".")))
        return self.of_cpp.get((self.cpp_names.get(cls, cls), member), "")
