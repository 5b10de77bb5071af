"""The names of C++, from the comments of the public headers by Doxygen."""

import re
import subprocess
import sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path

DIRECTIVES = {"class": "doxygenclass", "struct": "doxygenstruct", "enum": "doxygenenum", "function": "doxygenfunction"}
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
    return out / "xml"


class CppNames:
    """The names of namespace kinegraph."""

    def __init__(self, xml: Path):
        self.kinds: dict[str, str] = {}  # by name without namespace
        self.overloads: dict[str, list[str]] = {}  # argument lists of functions
        for compound in ElementTree.parse(xml / "index.xml").getroot().findall("compound"):
            name, kind = compound.findtext("name") or "", compound.get("kind") or ""
            if kind in ("class", "struct") and re.fullmatch(r"kinegraph::\w+", name):
                self.kinds[name.removeprefix("kinegraph::")] = kind
        for member in ElementTree.parse(xml / "namespacekinegraph.xml").getroot().iter("memberdef"):
            name, kind = member.findtext("name") or "", member.get("kind") or ""
            if kind == "enum":
                self.kinds.setdefault(name, kind)
            elif kind == "function" and not name.startswith("operator"):
                self.kinds.setdefault(name, kind)
                parameters = [parameter.find("type") for parameter in member.findall("param")]
                types = ["".join(type.itertext()) for type in parameters if type is not None]
                self.overloads.setdefault(name, []).append(f"({', '.join(types)})")

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
