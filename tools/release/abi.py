#!/usr/bin/env python3
"""Records what programs rely on at run time, and compares it with the recording of an earlier release:

    python tools/release/abi.py record PREFIX FILE     of the C++ package that is installed in PREFIX
    python tools/release/abi.py compare PREFIX FILE    exits with 1 if a program made with the recorded one could fail

Recorded are the exported symbols, sizes and alignments of all types of the public headers, and values of enumerators.
Additions are compatible. Members that change places within an equal size are not found.
"""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

TYPE = re.compile(r"(?<!>\n)^(class|struct|enum class) (\w+)(?: final)?(?: : [^;{]+)?\s*\{", re.MULTILINE)
ENUMERATORS = re.compile(r"^enum class (\w+)[^{;]*\{([^}]*)\}", re.MULTILINE)
PUBLIC = re.compile(r"^namespace kinegraph \{$(.*?)^\} +// namespace kinegraph$", re.MULTILINE | re.DOTALL)
COMMENT = re.compile(r"//[^\n]*|/\*.*?\*/", re.DOTALL)


def public_code(headers: Path) -> str:
    """Returns what the headers of a folder declare in namespace kinegraph, without comments."""
    texts = (header.read_text() for header in sorted(headers.rglob("*.h")))
    return "\n".join(COMMENT.sub("", part) for text in texts for part in PUBLIC.findall(text))


def layout_program(code: str) -> str:
    """Returns a C++ program that prints a line for each type and enumerator: name, and its numbers."""
    lines = [f'  show("{name}", sizeof({name}), alignof({name}));' for _, name in TYPE.findall(code)]
    for name, body in ENUMERATORS.findall(code):
        values = [re.split(r"[=\s]", entry.strip())[0] for entry in body.split(",") if entry.strip()]
        lines += [f'  show("{name}::{value}", static_cast<long>({name}::{value}));' for value in values]
    return "\n".join(
        [
            "#include <cstdio>",
            "#include <kinegraph/kinegraph.h>",
            "using namespace kinegraph;",
            'void show(const char* name, long a, long b = 0) { std::printf("%s %ld %ld\\n", name, a, b); }',
            "int main() {",
            *lines,
            "}",
        ]
    )


def layouts(prefix: Path) -> dict[str, list[int]]:
    """Returns size and alignment of types, and values of enumerators, by their names."""
    include = prefix / "include"
    compiler = os.environ.get("CXX", "c++")
    with tempfile.TemporaryDirectory() as folder:
        source, program = Path(folder, "layouts.cpp"), Path(folder, "layouts")
        source.write_text(layout_program(public_code(include / "kinegraph")))
        eigen = include / "kinegraph" / "eigen3"
        command = [compiler, "-std=c++20", "-O0", f"-I{include}", f"-I{eigen}", str(source), "-o", str(program)]
        library = next(prefix.glob("lib*/libkinegraph.so"))
        command += [str(library), f"-Wl,-rpath,{library.parent}", "-Wl,--unresolved-symbols=ignore-in-shared-libs"]
        subprocess.run(command, check=True)
        lines = subprocess.run([program], check=True, capture_output=True, text=True).stdout.splitlines()
    return {name: [int(a), int(b)] for name, a, b in (line.split() for line in lines)}


def symbols(library: Path) -> list[str]:
    """Returns the exported symbols."""
    command = ["nm", "--dynamic", "--defined-only", "--format=posix", str(library)]
    lines = subprocess.run(command, check=True, capture_output=True, text=True).stdout.splitlines()
    return sorted(line.split()[0].split("@")[0] for line in lines)


def interface(prefix: Path) -> dict:
    """Returns all that is recorded of an installed package."""
    return {"layouts": layouts(prefix), "symbols": symbols(next(prefix.glob("lib*/libkinegraph.so")))}


def differences(old: dict, new: dict) -> list[str]:
    """Returns the differences by which a program that was compiled with the old package could fail."""
    found = []
    for name, numbers in old["layouts"].items():
        now = new["layouts"].get(name)
        if now is None:
            found.append(f"{name} is missing")
        elif now != numbers:
            was, is_now = (str(n[0]) if "::" in name else f"{n[0]} bytes, aligned to {n[1]}" for n in (numbers, now))
            found.append(f"{name}: {was} is {is_now} now")
    missing = sorted(set(old["symbols"]) - set(new["symbols"]))
    if missing:
        readable = subprocess.run(["c++filt"], input="\n".join(missing), check=True, capture_output=True, text=True)
        found += [f"{symbol} is not exported any more" for symbol in readable.stdout.splitlines()]
    return found


def main() -> int:
    if len(sys.argv) != 4 or sys.argv[1] not in ("record", "compare"):
        print(__doc__, file=sys.stderr)
        return 2
    command, prefix, file = sys.argv[1], Path(sys.argv[2]), Path(sys.argv[3])
    now = interface(prefix)
    if command == "record":
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(json.dumps(now, indent=0, sort_keys=True) + "\n")
        print(f"abi: {len(now['layouts'])} types and enumerators, {len(now['symbols'])} symbols")
        return 0
    found = differences(json.loads(file.read_text()), now)
    print("\n".join(found) if found else f"abi: compatible with {file.name}")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
