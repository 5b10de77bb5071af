#!/usr/bin/env python3
"""Generates the message types of the viewer for server (C++) and client (TypeScript) from viewer/messages.json.

python tools/generate_messages.py            writes the files
python tools/generate_messages.py --check    fails if they differ from the schema
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


def cpp_struct(name: str, fields: dict, inside: list[str] | None = None) -> list[str]:
    out = ["", f"struct {name} {{", *(inside or [])]
    for field, kind in fields.items():
        initial = " = 0" if kind in ("int", "number") else ""
        out.append(f"  {cpp_type(kind)} {field}{initial};")
    return [*out, "};"]


def make_header(schema: dict) -> str:
    out = [
        "#pragma once",
        "",
        f"// {NOTE}",
        "// clang-format off",
        "",
        "#include <cstdint>",
        "#include <optional>",
        "#include <string>",
        "#include <vector>",
        "",
        "namespace kinegraph::inline viewer_internal {",
        "",
        "/// First 4 bytes of a binary message to the client.",
        "enum class BinaryKind : std::uint32_t {",
        *[f"  {name} = {value}," for name, value in schema["binary"].items()],
        "};",
    ]
    for name, fields in {**schema["types"], **schema["messages"]}.items():
        out += cpp_struct(name, fields)
    out += ["", "/// Encodes messages for the client."]
    out += [f"std::string jsonText(const {name}& message);" for name in schema["messages"]]
    return "\n".join([*out, "", "}  // namespace kinegraph::inline viewer_internal", ""])


def make_source(schema: dict) -> str:
    out = ['#include "kinegraph/viewer/messages/messages.h"', "", f"// {NOTE}", "// clang-format off", ""]
    out += [
        '#include "kinegraph/common/json.h"',
        "",
        "namespace kinegraph::inline viewer_internal {",
        "",
        "using common_internal::jsonOf;",
    ]
    for name, fields in {**schema["types"], **schema["messages"]}.items():
        kind = [f'{{"kind", "{tag(name)}"}}'] if name in schema["messages"] else []
        entries = [*kind, *[f'{{"{field}", jsonOf(m.{field})}}' for field in fields]]
        out += ["", f"static boost::json::value jsonOf(const {name}& m) {{", "  return boost::json::object{"]
        out += [f"      {entry}," for entry in entries]
        out += ["  };", "}"]
    for name in schema["messages"]:
        out += [
            "",
            f"std::string jsonText(const {name}& message) {{ return boost::json::serialize(jsonOf(message)); }}",
        ]
    return "\n".join([*out, "", "}  // namespace kinegraph::inline viewer_internal", ""])


def make_commands_cpp(schema: dict) -> str:
    out = [
        "#pragma once",
        "",
        f"// {NOTE}",
        "// clang-format off",
        "",
        "#include <optional>",
        "#include <string_view>",
        "#include <variant>",
        "",
    ]
    out += [
        '#include "kinegraph/viewer/messages/command_reader.h"',
        "",
        "namespace kinegraph::inline viewer_internal {",
    ]
    for number, (name, fields) in enumerate(schema["commands"].items(), 1):
        out += cpp_struct(name, fields, [f"  static constexpr int kKind = {number};"])
    names = ", ".join(schema["commands"])
    out += ["", "/// A command of a browser.", f"using Command = std::variant<{names}>;"]
    out += ["", "/// Reads a binary message from a browser; returns nothing unless it is exactly one command."]
    out += ["inline std::optional<Command> readCommand(std::string_view data) {", "  CommandReader reader(data);"]
    out += ["  int kind;", "  if (!reader.read(kind)) return std::nullopt;", "  switch (kind) {"]
    for name, fields in schema["commands"].items():
        members = "".join(f", &{name}::{field}" for field in fields)
        out.append(f"    case {name}::kKind: return readFields<{name}>(reader{members});")
    out += ["  }", "  return std::nullopt;", "}", "", "}  // namespace kinegraph::inline viewer_internal", ""]
    return "\n".join(out)


def make_ts(schema: dict) -> str:
    out = [
        f"// {NOTE}",
        "// clang-format off",
        "",
        'import { writeCommand } from "./commands";',
        "",
        "/** First 4 bytes of a binary message from the server. */",
        "export const BinaryKind = {",
    ]
    out += [f"  {name}: {value}," for name, value in schema["binary"].items()]
    out += ["} as const;"]
    for name, fields in {**schema["types"], **schema["messages"]}.items():
        out += ["", f"export interface {name} {{"]
        if name in schema["messages"]:
            out.append(f'  kind: "{tag(name)}";')
        out += [f"  {field}: {ts_type(kind)};" for field, kind in fields.items()]
        out += ["}"]
    for number, (name, fields) in enumerate(schema["commands"].items(), 1):
        arguments = ", ".join(f"{field}: {ts_type(kind)}" for field, kind in fields.items())
        values = "".join(f', ["{kind}", {field}]' for field, kind in fields.items())
        function = name[0].lower() + name[1:]
        out += ["", f"export const {function} = ({arguments}): Uint8Array<ArrayBuffer> =>"]
        out += [f'  writeCommand(["int", {number}]{values});']
    out += ["", "export type ServerMessage = " + " | ".join(schema["messages"]) + ";", ""]
    return "\n".join(out)


def main() -> int:
    schema = json.loads((ROOT / "viewer/messages.json").read_text())
    files = {
        ROOT / "src/kinegraph/viewer/messages/messages.h": make_header(schema),
        ROOT / "src/kinegraph/viewer/messages/messages.cpp": make_source(schema),
        ROOT / "src/kinegraph/viewer/messages/commands.h": make_commands_cpp(schema),
        ROOT / "viewer/src/messages.ts": make_ts(schema),
    }
    drifted = [file for file, text in files.items() if not file.exists() or file.read_text() != text]
    if "--check" in sys.argv:
        for file in drifted:
            print(f"{file.relative_to(ROOT)} is out of date with viewer/messages.json; run tools/generate_messages.py")
        return 1 if drifted else 0
    for file in drifted:
        file.write_text(files[file])
    return 0


if __name__ == "__main__":
    sys.exit(main())
