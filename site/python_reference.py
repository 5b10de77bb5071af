"""Writes the pages of Python's names, from the stub and the docstrings of the installed package."""

import re
from pathlib import Path

import griffe
import option_tables
from cpp_reference import plain
from member_texts import MemberTexts

SHORT = re.compile(r"(collections\.abc|typing|numpy\.typing|kinegraph\._core)\.")
SPECIAL = ("__len__", "__getitem__", "__call__", "__iter__")


def loadPackage(folder: Path) -> griffe.Object:
    """Reads the package in `folder`/kinegraph without importing it."""
    options = {"warnings": False, "returns_named_value": False, "returns_multiple_items": False}
    return griffe.load(
        "kinegraph",
        search_paths=[str(folder)],
        allow_inspection=False,
        docstring_parser="google",
        docstring_options=options,
        resolve_aliases=True,
    )


def exportedNames(package: griffe.Object) -> list[str]:
    return [str(name) for name in package.exports or [] if not str(name).startswith("_")]


def annotation(text: object) -> str:
    return SHORT.sub("", str(text)).replace("NDArray[numpy.float64]", "NDArray")


def signature(function: griffe.Function, skips_self: bool) -> str:
    parts, has_star = [], False
    for parameter in function.parameters:
        if skips_self and parameter.name in ("self", "cls"):
            continue
        kind = parameter.kind.value if parameter.kind else ""
        mark = {"variadic positional": "*", "variadic keyword": "**"}.get(kind, "")
        if kind == "keyword-only" and not has_star:
            parts.append("*")
            has_star = True
        has_star |= mark == "*"
        part = mark + parameter.name
        if parameter.annotation:
            part += f": {annotation(parameter.annotation)}"
        if parameter.default is not None and not mark:
            part += f" = {parameter.default}"
        parts.append(part)
    result = f" -> {annotation(function.returns)}" if function.returns else ""
    return f"({', '.join(parts)}){result}"


def oneLine(text: str) -> str:
    return " ".join(text.split())


def withFences(text: str) -> list[str]:
    """Indented lines after an empty one are Python."""
    lines: list[str] = []
    is_code = False
    for line in text.splitlines():
        if line.startswith("    ") and not is_code and (not lines or not lines[-1].strip()):
            lines.append("~~~python")
            is_code = True
        elif is_code and line.strip() and not line.startswith("    "):
            while not lines[-1].strip():
                lines.pop()
            lines += ["~~~", ""]
            is_code = False
        lines.append(line[4:] if is_code else line)
    return lines + (["~~~"] if is_code else [])


def optionNames(function: griffe.Function, described: list[str]) -> list[str]:
    """The arguments with a default, and the described ones that a `**` argument takes; none if they are few."""
    parameters = {parameter.name: parameter for parameter in function.parameters}
    takes_more = any(p.kind and p.kind.value == "variadic keyword" for p in function.parameters)

    def isOption(name: str) -> bool:
        parameter = parameters.get(name)
        if parameter is None:
            return takes_more
        return parameter.default is not None and "variadic" not in (parameter.kind.value if parameter.kind else "")

    names = [name for name in described if isOption(name)]
    return names if len(names) >= option_tables.SHORTEST else []


def optionTable(function: griffe.Function, names: list[str], texts: dict[str, str]) -> list[str]:
    options = []
    parameters = {parameter.name: parameter for parameter in function.parameters}
    for name in names:
        parameter = parameters.get(name)
        kind = annotation(parameter.annotation) if parameter and parameter.annotation else ""
        options.append(option_tables.optionFrom(name, texts[name], kind, str(parameter.default) if parameter else ""))
    option_tables.expectations(function.name, options)
    return option_tables.table(options)


def returned(part: griffe.DocstringReturn | griffe.DocstringYield, docstring: str) -> str:
    """The whole text of a result; griffe takes what is before a colon for its type."""
    before = f"{part.annotation}: "
    return (before if before in oneLine(docstring) else "") + oneLine(part.description)


def description(item: griffe.Object) -> list[str]:
    """The docstring as MyST, with fields for arguments, results and errors. Many options are a table."""
    if not item.docstring:
        return []
    docstring = item.docstring
    docstring.value = re.sub(r"\n(Returns|Raises|Yields):\n", r"\n\n\1:\n", docstring.value)
    lines: list[str] = []
    for section in docstring.parsed:
        kind = section.kind.value
        if kind == "text":
            lines += [*withFences(section.value), ""]
        elif kind in ("parameters", "other parameters"):
            texts = {p.name: oneLine(p.description) for p in section.value}
            options = optionNames(item, list(texts)) if item.is_function else []
            if options:
                lines += optionTable(item, options, texts)
            lines += [f":param {name}: {text}" for name, text in texts.items() if name not in options]
        elif kind == "attributes":
            lines += [f"- `{p.name}`: {oneLine(p.description)}" for p in section.value] + [""]
        elif kind in ("returns", "yields"):
            lines += [f":returns: {' '.join(returned(r, docstring.value) for r in section.value)}"]
        elif kind == "raises":
            lines += [f":raises {annotation(r.annotation)}: {oneLine(r.description)}" for r in section.value]
        elif kind == "examples":
            lines += ["", "~~~python", *(str(example[1]) for example in section.value), "~~~", ""]
        elif kind == "admonition":
            lines += ["", f"**{section.title or 'Note'}** {oneLine(section.value.description)}", ""]
    return lines


def directive(kind: str, head: str, body: list[str], depth: int, options: list[str] | None = None) -> list[str]:
    fence = ":" * (8 - depth)
    return [f"{fence}{{{kind}}} {head}", *(f":{option}" for option in options or []), "", *body, fence, ""]


def functionEntry(
    variants: list[griffe.Function],
    name: str,
    depth: int,
    kind: str = "py:function",
    is_method: bool = False,
    end: list[str] | None = None,
) -> list[str]:
    is_static = is_method and "staticmethod" in variants[0].labels
    body: list[str] = []
    texts: list[list[str]] = []
    for variant in variants:
        text = description(variant)
        if text and text not in texts:
            texts.append(text)
            body += text
    heads = [name + signature(variant, is_method and not is_static) for variant in variants]
    if len(heads) > 1:
        body = ["Overloads:", "", "~~~python", *heads[1:], "~~~", "", *body]
    return directive(kind, heads[0], [*body, *(end or [])], depth, ["staticmethod:"] if is_static else [])


def classOptions(cls: griffe.Class) -> list[option_tables.Option]:
    """The fields of a class of options: each says its default."""
    if "dict" not in cls.members:
        return []
    fields = [m for name, m in cls.members.items() if m.is_attribute and not name.startswith("_")]
    options = []
    for field in fields:
        text = oneLine(field.docstring.value) if field.docstring else ""
        options.append(
            option_tables.optionFrom(field.name, text, annotation(field.annotation) if field.annotation else "")
        )
    if not all(option.default for option in options):
        return []
    option_tables.expectations(cls.name, options)
    return options


def attributesOfText(cls: griffe.Class) -> list[str]:
    """The attributes that the section "Attributes" of the docstring describes."""
    _, _, section = (cls.docstring.value if cls.docstring else "").partition("\nAttributes:\n")
    return [name for line in re.findall(r"(?m)^ {4}(\w[\w, ]*):", section) for name in line.split(", ")]


def memberEntries(cls: griffe.Class, depth: int, texts: MemberTexts, in_cpp: dict[str, str]) -> list[str]:
    def link(name: str) -> list[str]:
        twin = in_cpp.get(plain(name))
        return ["", f"In C++: {{cpp:any}}`{twin.removeprefix('kinegraph::')} <{twin}>`"] if twin else []

    members: dict[str, list] = {name: [member] for name, member in cls.members.items()}
    for name, variants in getattr(cls, "overloads", {}).items():
        if variants:
            members[name] = list(variants)
    lines: list[str] = []
    table = classOptions(cls)
    if table:  # the fields have targets for links, and one table for all
        for option in table:
            lines += directive("py:attribute", option.name, [], depth, ["no-typesetting:"])
        lines += option_tables.table(table)
    in_table = {option.name for option in table}
    for name in attributesOfText(cls):  # described in the text of the class
        lines += directive("py:attribute", name, [], depth, ["no-typesetting:"])
        in_table.add(name)
    for name, variants in members.items():
        member = variants[-1]
        if name in in_table:
            continue
        if (name.startswith("_") and name not in SPECIAL) or member.is_alias:
            continue
        if member.is_function:
            variants = list(member.overloads or variants) if len(variants) == 1 else variants
            if not any(variant.docstring for variant in variants):
                lines += directive("py:method", name + "()", [texts.find(cls.name, name), *link(name)], depth)
                continue
            lines += functionEntry(variants, name, depth, "py:method", is_method=True, end=link(name))
        elif member.is_attribute:
            is_property = "property" in member.labels
            options = [f"type: {annotation(member.annotation)}"] if member.annotation else []
            if member.value is not None and not is_property and len(str(member.value)) < 30:
                options.append(f"value: {member.value}")
            text = [*(description(member) or [texts.find(cls.name, name)]), *link(name)]
            lines += directive("py:property" if is_property else "py:attribute", name, text, depth, options)
    return lines


def entry(package: griffe.Object, name: str, twin: str | None, texts: MemberTexts, in_cpp: dict[str, str]) -> list[str]:
    """The section of a name, with links to its counterpart in C++ and those of its members (`in_cpp`)."""
    item, variants = package[name], []
    if item.is_alias:
        module = package.modules_collection[item.target_path.rsplit(".", 1)[0]]
        variants = list(getattr(module, "overloads", {}).get(name, []))
        item = variants[-1] if variants else item.final_target
    lines = [f"## {name}", ""]
    if twin:
        lines += [f"In C++: {{cpp:any}}`{twin}`", ""]
    if item.is_class:
        init = item.members.get("__init__")
        is_written = init is not None and init.is_function
        head = name + (signature(init, True) if is_written else "")
        body = description(item) + (["", *description(init)] if is_written else [])
        return lines + directive("py:class", head, [*body, "", *memberEntries(item, 2, texts, in_cpp)], 1)
    if item.is_function:
        return lines + functionEntry(variants or list(item.overloads or [item]), name, 1)
    other = f"Another name of `{item.value}`, in older scripts." if item.is_attribute and item.value else ""
    return lines + directive("py:data", name, description(item) or [other], 1)
