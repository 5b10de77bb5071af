"""The names of C++, from the comments of the public headers by Doxygen."""

import re
import subprocess
import sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import cpp_texts

DIRECTIVES = {"class": "doxygenclass", "struct": "doxygenstruct", "enum": "doxygenenum", "function": "doxygenfunction"}
WITH_FUNCTIONS = ("Config", "Frame")  # methods of Python that are functions in C++
OTHER_NAMES = {
    "Config": {"asSRDF": "writeSrdf", "asMJCF": "writeMjcf", "asYaml": "writeYaml", "writeMJCF": "saveMjcf"},
    "Frame": {"asDict": "describeFrame"},
}
CONFIGURATION = """
PROJECT_NAME=Kinegraph
INPUT={headers}
STRIP_FROM_PATH={source}
STRIP_FROM_INC_PATH={source}
OUTPUT_DIRECTORY={out}
GENERATE_HTML=NO
GENERATE_LATEX=NO
GENERATE_XML=YES
XML_PROGRAMLISTING=NO
JAVADOC_AUTOBRIEF=YES
MACRO_EXPANSION=YES
EXPAND_ONLY_PREDEF=YES
PREDEFINED="KINEGRAPH_EXPORT=" "KINEGRAPH_API="
QUIET=YES
WARNINGS=NO
WARN_IF_UNDOCUMENTED=NO
WARN_IF_DOC_ERROR=NO
HAVE_DOT=NO
"""


def runDoxygen(repository: Path, out: Path) -> Path:
    """Returns the folder of the XML files."""
    sys.path.insert(0, str(repository / "tools"))
    from public_headers import publicHeaders

    source = repository / "src"
    out.mkdir(parents=True, exist_ok=True)
    headers = " ".join(f'"{source / header}"' for header in publicHeaders(source))
    file = out / "Doxyfile"
    file.write_text(CONFIGURATION.format(headers=headers, source=source, out=out))
    subprocess.run(["doxygen", str(file)], check=True, stdout=subprocess.DEVNULL)
    cpp_texts.fillDescriptions(out / "xml", source)
    return out / "xml"


def plain(name: str) -> str:
    """A name without the differences in spelling between the languages."""
    return name.replace("_", "").lower()


def headerOf(element: ElementTree.Element) -> str:
    """The header of a declaration, below src/kinegraph."""
    location = element.find("location")
    file = (location.get("declfile") or location.get("file") or "") if location is not None else ""
    return file.partition("kinegraph/")[2]


class CppNames:
    """The names of namespace kinegraph."""

    def __init__(self, xml: Path):
        self.kinds: dict[str, str] = {}  # by name without namespace
        self.overloads: dict[str, list[str]] = {}  # argument lists of functions
        self.headers: dict[str, str] = {}  # by described name, below src/kinegraph
        self.members: dict[str, set[str]] = {}  # public members of classes
        for compound in ElementTree.parse(xml / "index.xml").getroot().findall("compound"):
            name, kind = compound.findtext("name") or "", compound.get("kind") or ""
            if kind in ("class", "struct") and re.fullmatch(r"kinegraph::\w+", name):
                self.kinds[name.removeprefix("kinegraph::")] = kind
                self._readClass(xml / f"{compound.get('refid')}.xml", name.removeprefix("kinegraph::"))
        for member in ElementTree.parse(xml / "namespacekinegraph.xml").getroot().iter("memberdef"):
            name, kind = member.findtext("name") or "", member.get("kind") or ""
            if kind in ("enum", "function") and cpp_texts.text(member):
                self.headers.setdefault(name, headerOf(member))
            if kind == "enum":
                self.kinds.setdefault(name, kind)
            elif kind == "function" and not name.startswith("operator"):
                self.kinds.setdefault(name, kind)
                parameters = [parameter.find("type") for parameter in member.findall("param")]
                types = ["".join(type.itertext()) for type in parameters if type is not None]
                self.overloads.setdefault(name, []).append(f"({', '.join(types)})")

    def _readClass(self, file: Path, name: str) -> None:
        compound = ElementTree.parse(file).getroot().find("compounddef")
        assert compound is not None
        if cpp_texts.text(compound):
            self.headers[name] = headerOf(compound)
        public = [member for member in compound.iter("memberdef") if member.get("prot") == "public"]
        self.members[name] = {member.findtext("name") or "" for member in public if cpp_texts.text(member)}

    def membersByName(self, cls: str) -> dict[str, str]:
        """Full names of the members of a class, and of functions for all scenes, by `plain` of their name."""
        functions = [name for name in self.headers if self.kinds[name] == "function"] if cls in WITH_FUNCTIONS else []
        found = {plain(name): f"kinegraph::{name}" for name in functions}
        members = {plain(member): f"kinegraph::{cls}::{member}" for member in self.members.get(cls, set())}
        other = {plain(name): f"kinegraph::{twin}" for name, twin in OTHER_NAMES.get(cls, {}).items()}
        return {**found, **members, **other}

    def entry(self, name: str) -> list[str]:
        """The declarations of a name, with their comments."""
        kind, full = self.kinds[name], f"kinegraph::{name}"
        heads = [full]
        if kind == "function" and len(self.overloads[name]) > 1:
            heads = [full + arguments for arguments in dict.fromkeys(self.overloads[name])]
        options = [":members:"] if kind in ("class", "struct") else []
        lines: list[str] = []
        for head in heads:
            lines += [f"```{{{DIRECTIVES[kind]}}} {head}", *options, "```", ""]
        return lines
