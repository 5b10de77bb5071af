"""Reads the prose of a source tree: comments, docstrings, documentation strings and Markdown pages."""

import ast
import inspect
import io
import re
import subprocess
import tokenize
from collections.abc import Iterator
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
SUFFIXES = (".h", ".cpp", ".py", ".ts", ".md")
EXCLUDED = ("models/", "tests/data/")  # recorded and third-party content

# Strings are matched first, so that a // inside of them starts no comment.
_CPP = re.compile(
    r'R"(?P<tag>\w*)\((?P<raw>.*?)\)(?P=tag)"'
    r"|(?P<line>//[^\n]*)|(?P<block>/\*.*?\*/)"
    r"|\"(?:\\.|[^\"\\\n])*\"|'(?:\\.|[^'\\\n])'|`(?:\\.|[^`\\\n])*`",
    re.DOTALL,
)

Passage = tuple[int, str]  # the number of its first line, and its text, which may have several lines


def tracked_files(root: Path = ROOT) -> list[Path]:
    """Returns the files under version control (and new ones) whose prose is checked."""
    command = ["git", "ls-files", "--cached", "--others", "--exclude-standard"]
    names = subprocess.run(command, cwd=root, check=True, capture_output=True, text=True).stdout.splitlines()
    return [root / n for n in sorted(names) if n.endswith(SUFFIXES) and not n.startswith(EXCLUDED)]


def _cpp(text: str, with_raw_strings: bool) -> Iterator[Passage]:
    for match in _CPP.finditer(text):
        is_comment = match["line"] is not None or match["block"] is not None
        if is_comment or (with_raw_strings and match["raw"] is not None):
            yield text.count("\n", 0, match.start()) + 1, match[0]


def _python(text: str) -> Iterator[Passage]:
    for token in tokenize.generate_tokens(io.StringIO(text).readline):
        if token.type == tokenize.COMMENT and not token.string.startswith("#!"):
            yield token.start[0], token.string
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.Module | ast.ClassDef | ast.FunctionDef | ast.AsyncFunctionDef) and node.body:
            first = node.body[0]
            if (
                isinstance(first, ast.Expr)
                and isinstance(first.value, ast.Constant)
                and isinstance(first.value.value, str)
            ):
                yield first.lineno, first.value.value


def passages(path: Path) -> list[Passage]:
    """Returns the comments and docstrings of a source file, or all of a Markdown page, by line. The docstrings of the
    bindings are raw strings; elsewhere raw strings are programs and files."""
    text = path.read_text(encoding="utf-8", errors="replace")
    if path.suffix == ".md":
        return [(1, text)]
    if path.suffix == ".py":
        return sorted(_python(text))
    return list(_cpp(text, with_raw_strings="bindings" in path.parts))


def plain_text(path: Path) -> str:
    """Returns the prose of a file as running text: without markers, code, tables, headings and link targets."""
    if path.suffix == ".md":
        text = re.sub(r"^```.*?^```", "", path.read_text(encoding="utf-8"), flags=re.DOTALL | re.MULTILINE)
        text = re.sub(r"^(\||#| {4,}(?![-*\d])).*$", "", text, flags=re.MULTILINE)
        text = re.sub(r"!?\[([^\]]*)\]\([^)]*\)", r"\1", text)
    else:
        lines = path.read_text(encoding="utf-8", errors="replace").split("\n")
        parts, last = [], -1
        for line, passage in passages(path):
            goes_on = line == last + 1 and lines[line - 1].lstrip().startswith(passage[:2])  # no code before it
            stripped = re.sub(r'^R"\w*\(|\)\w*"$|^/\*+|\*/$', "", passage)
            stripped = re.sub(r"^\s*(///?<?|\*|#) ?", "", inspect.cleandoc(stripped), flags=re.MULTILINE)
            parts.append(("\n" if goes_on else "\n\n") + stripped)  # consecutive comments are one paragraph
            last = line + passage.count("\n")
        text = "".join(parts)
        text = re.sub(r"(?<=\n\n)( {4}[^\n]*\n?)+", "", text)  # indented blocks: code
        if path.suffix == ".h" and "bindings" not in path.parts:  # rows of tables, and formulas
            text = re.sub(r"^ {2,}(?![-*\d])[^\n]*( {2,}|\|)[^\n]*$", "\n", text, flags=re.MULTILINE)
    text = re.sub(r"^\s*([-*]|\d+\.)\s+", "\n\n", text, flags=re.MULTILINE)  # items of a list are sentences
    return re.sub(r"`+[^`\n]*`+", "X", text)
