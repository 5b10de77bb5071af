#!/usr/bin/env python3
"""Makes the message types of the viewer, for its server (C++) and its client (TypeScript), from viewer/messages.json.

python tools/generate_messages.py            writes both files
python tools/generate_messages.py --check    fails if they are not what the schema says
"""

import json
import sys
from pathlib import Path

ROOT = Path(__file__).parent.parent
NOTE = "Made by tools/generate_messages.py from viewer/messages.json; change that file instead."
CPP_TYPES = {"string": "std::string", "number": "double", "int": "int"}


def cpp_type(name: str) -> str:
    if name.endswith("[]"):
        return f"std::vector<{cpp_type(name[:-2])}>"
    if name.endswith("?"):
        return f"std::optional<{cpp_type(name[:-1])}>"
    return CPP_TYPES.get(name, name)


def ts_type(name: str) -> str:
    if name.endswith("[]"):
        return f"{ts_type(name[:-2])}[]"
    if name.endswith("?"):
        return f"{ts_type(name[:-1])} | null"
    return {"int": "number"}.get(name, name)


def tag(message: str) -> str:
    return message.removesuffix("Message").lower()


def make_cpp(schema: dict) -> str:
    out = [
        "#pragma once",
        "",
        f"// {NOTE}",
        "",
        "#include <cstdint>",
        "#include <optional>",
        "#include <string>",
        "#include <vector>",
        "",
        '#include "kinegraph/viewer/json.h"',
        "",
        "namespace kinegraph {",
        "",
        "/// First 4 bytes of a binary message.",
        "enum class BinaryKind : std::uint32_t {",
        *[f"  {name} = {value}," for name, value in schema["binary"].items()],
        "};",
    ]
    for name, fields in {**schema["types"], **schema["messages"]}.items():
        out += ["", f"struct {name} {{"]
        for field, kind in fields.items():
            initial = " = 0" if kind in ("int", "number") else ""
            out.append(f"  {cpp_type(kind)} {field}{initial};")
        out += ["};", "", f"inline void writeJson(JsonWriter& json, const {name}& m) {{", "  json.beginObject();"]
        if name in schema["messages"]:
            out.append(f'  json.field("kind", std::string("{tag(name)}"));')
        out += [f'  json.field("{field}", m.{field});' for field in fields]
        out += ["  json.endObject();", "}"]
    return "\n".join([*out, "", "}  // namespace kinegraph", ""])


def make_ts(schema: dict) -> str:
    out = [f"// {NOTE}", "", "/** First 4 bytes of a binary message. */", "export const BinaryKind = {"]
    out += [f"  {name}: {value}," for name, value in schema["binary"].items()]
    out += ["} as const;"]
    for name, fields in {**schema["types"], **schema["messages"]}.items():
        out += ["", f"export interface {name} {{"]
        if name in schema["messages"]:
            out.append(f'  kind: "{tag(name)}";')
        out += [f"  {field}: {ts_type(kind)};" for field, kind in fields.items()]
        out += ["}"]
    out += ["", "export type ServerMessage = " + " | ".join(schema["messages"]) + ";", ""]
    return "\n".join(out)


def main() -> int:
    schema = json.loads((ROOT / "viewer/messages.json").read_text())
    files = {
        ROOT / "src/kinegraph/viewer/messages.h": make_cpp(schema),
        ROOT / "viewer/src/messages.ts": make_ts(schema),
    }
    drifted = [file for file, text in files.items() if not file.exists() or file.read_text() != text]
    if "--check" in sys.argv:
        for file in drifted:
            print(f"{file.relative_to(ROOT)} is not what viewer/messages.json says; run tools/generate_messages.py")
        return 1 if drifted else 0
    for file in drifted:
        file.write_text(files[file])
    return 0


if __name__ == "__main__":
    sys.exit(main())
