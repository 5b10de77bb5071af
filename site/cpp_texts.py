"""Sentences for names of C++ whose meaning their declaration says: they are added to the XML of Doxygen."""

import re
import xml.etree.ElementTree as ElementTree
from collections import defaultdict
from pathlib import Path

FORMS = [  # names of functions, and what they return
    (r"\w+Names", "Returns the names of all values."),
    (r"\w+Name", "Returns the name of a value."),
    (r"\w+OptionTable", "Returns the table of the options: names, defaults, ranges and meanings."),
]


def text(element: ElementTree.Element) -> str:
    """The comment of an element."""
    parts = [element.find(part) for part in ("briefdescription", "detaileddescription")]
    return "".join("".join(part.itertext()) for part in parts if part is not None).strip()


def describe(element: ElementTree.Element, sentence: str) -> None:
    brief = element.find("briefdescription")
    assert brief is not None
    ElementTree.SubElement(brief, "para").text = sentence


def takersOf(members: list[ElementTree.Element]) -> dict[str, list[str]]:
    """The functions and constructors with an argument of each type `...Options`."""
    found: dict[str, list[str]] = defaultdict(list)
    for member in members:
        name = (member.findtext("name") or "").lstrip("~")
        for type in member.findall("param/type"):
            for options in re.findall(r"\w+Options", "".join(type.itertext())):
                if name not in found[options] and name != options:
                    found[options].append(name)
    return found


def nameMembers(compound: ElementTree.Element, source: Path) -> bool:
    """Corrects variables whose name Doxygen takes for a keyword of another language, such as `double local`.

    Returns:
        True if there are any.
    """
    is_changed = False
    for member in compound.iter("memberdef"):
        type, name, place = member.find("type"), member.find("name"), member.find("location")
        assert type is not None and name is not None and place is not None
        if member.get("kind") != "variable" or "".join(type.itertext()):
            continue
        line = (source / place.get("file", "")).read_text().splitlines()[int(place.get("line", "1")) - 1]
        found = re.match(rf"\s*{name.text} (\w+)", line)
        if found:
            type.text, name.text, is_changed = name.text, found[1], True
    return is_changed


def fillDescriptions(xml: Path, source: Path) -> None:
    """Adds sentences to names without a comment: names of values, tables, and options with the calls that take them."""
    space = ElementTree.parse(xml / "namespacekinegraph.xml")
    functions = [member for member in space.getroot().iter("memberdef") if member.get("kind") == "function"]
    files = sorted([*xml.glob("classkinegraph_1_1*.xml"), *xml.glob("structkinegraph_1_1*.xml")])
    trees = {file: ElementTree.parse(file) for file in files}
    methods = [member for tree in trees.values() for member in tree.getroot().iter("memberdef")]
    takers = takersOf([*functions, *methods])
    for function in functions:
        name = function.findtext("name") or ""
        for form, sentence in FORMS:
            if not text(function) and re.fullmatch(form, name):
                describe(function, sentence)
    described = {function.findtext("name") for function in functions if text(function)}
    for function in functions:
        if not text(function) and function.findtext("name") in described:
            describe(function, "The same for these arguments.")
    for file, tree in trees.items():
        compound = tree.getroot().find("compounddef")
        assert compound is not None
        name = (compound.findtext("compoundname") or "").removeprefix("kinegraph::")
        is_changed = nameMembers(compound, source)
        if name.endswith("Options") and takers.get(name) and not text(compound):
            describe(compound, f"Options of {' and '.join(takers[name][:3])}.")
            is_changed = True
        if is_changed:
            tree.write(file, encoding="utf-8", xml_declaration=True)
    space.write(xml / "namespacekinegraph.xml", encoding="utf-8", xml_declaration=True)
