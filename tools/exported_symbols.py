#!/usr/bin/env python3
"""Writes the version script of the shared library, which exports the symbols that the public headers declare.

    python tools/exported_symbols.py SOURCE NM OUTPUT OBJECT...

SOURCE is the folder src, NM the program that lists the symbols of the OBJECTs, OUTPUT the version script. A symbol is
exported if a public header names its class or function of namespace kinegraph. What is in the inner namespace of a room
is not exported, and neither are inline functions, because users compile their own copies.
"""

import re
import subprocess
import sys
from pathlib import Path

from public_headers import publicHeaders

KINDS = "TDBRVu"  # functions, data, tables and type information of classes, statics of templates
OF_CLASS = re.compile(
    r"^(?:(?:construction )?vtable|typeinfo(?: name)?|VTT|guard variable|(?:non-)?virtual thunk) (?:for|to) "
)
OWNER = re.compile(r"^kinegraph::(\w+)")
INNER = re.compile("_internal$|^(lanes|shaders)$")  # namespaces of rooms, and two of several ones
NOT_CODE = re.compile(r'//[^\n]*|/\*.*?\*/|"[^"\n]*"|^#.*?$', re.MULTILINE | re.DOTALL)


def publicNames(source: Path) -> set[str]:
    """Returns all identifiers of the public headers, without comments, strings and directives."""
    texts = ((source / header).read_text() for header in publicHeaders(source))
    return {word for text in texts for word in re.findall(r"\w+", NOT_CODE.sub(" ", text)) if not INNER.search(word)}


def symbols(nm: str, objects: list[str]) -> list[tuple[str, str, str]]:
    """Returns kind, linker name and readable name of each defined symbol."""
    command = [nm, "--defined-only", "--extern-only", "--no-sort", "--format=posix"]
    raw, readable = (
        subprocess.run([*command, *style, *objects], capture_output=True, text=True, check=True).stdout.splitlines()
        for style in ([], ["--demangle"])
    )
    found = []
    for line, for_people in zip(raw, readable, strict=True):
        parts = line.split(" ")
        if len(parts) >= 2 and not line.endswith(":"):
            found.append((parts[1], parts[0], for_people))
    return found


def isExported(kind: str, for_people: str, names: set[str]) -> bool:
    """`names` are those of the public face of namespace kinegraph."""
    owner = OWNER.match(OF_CLASS.sub("", for_people))
    return kind in KINDS and owner is not None and owner[1] in names


def main() -> int:
    source, nm, output, *objects = sys.argv[1:]
    names = publicNames(Path(source))
    exported = sorted({name for kind, name, people in symbols(nm, objects) if isExported(kind, people, names)})
    if not exported:
        print(f"exported_symbols: none of the symbols of {len(objects)} files is in a public header", file=sys.stderr)
        return 1
    lines = ["{", "  global:", *(f"    {name};" for name in exported), "  local: *;", "};"]
    Path(output).write_text("\n".join(lines) + "\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
