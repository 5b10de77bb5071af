"""Expands files with xacro macros by the package xacrodoc."""

from __future__ import annotations

import difflib
import io
import re
from collections.abc import Mapping
from contextlib import redirect_stderr
from importlib import import_module
from pathlib import Path

from . import _core
from .errors import FileError

_ARGUMENT = r"""<xacro:arg\b[^>]*?\bname\s*=\s*["']([^"']+)["']|\$\(arg\s+([^)\s]+)\s*\)"""


def expand(path: str, arguments: Mapping[str, str]) -> str:
    """Returns the URDF, MJCF or SRDF text of a file with macros.

    `$(find NAME)` and `package://NAME` are searched as in `Config.addFile`.

    Args:
        path: Path of the file.
        arguments: Values of its `<xacro:arg>`, by name.
    Returns:
        The text without macros.
    Raises:
        FileError: xacrodoc is not installed, the macros have an error, or no file has an argument of that name.
    """
    try:
        xacro, xacrodoc = import_module("xacro"), import_module("xacrodoc")
        packages = import_module("xacrodoc.packages")
    except ModuleNotFoundError:
        raise FileError(
            f"'{path}' has xacro macros, which need the package xacrodoc: pip install kinegraph[xacro]"
        ) from None
    packages.reset()
    tried: set[str] = set()
    while True:
        said = io.StringIO()  # xacro prints the file and the macro of an error
        try:
            xacro.init_stacks(path)  # relative includes
            xacro.all_includes.clear()  # of files loaded before
            with redirect_stderr(said):
                doc = xacrodoc.XacroDoc.from_file(path, subargs=dict(arguments), resolve_packages=False)
            break
        except Exception as error:
            missing = _missingPackage(error)
            folder = ""
            if missing and missing not in tried:
                folder = _core._packageFolder(missing, str(Path(path).parent))  # type: ignore[attr-defined]
            if folder:
                tried.add(missing)
                packages.update_package_cache({missing: folder})
                continue
            raise FileError(f"'{path}' cannot be expanded: {_oneLine(error, said.getvalue())}") from error
    _checkArguments(path, arguments, [path, *xacro.all_includes])
    return str(doc.dom.toprettyxml(indent="  "))


def _checkArguments(path: str, arguments: Mapping[str, str], files: list[str]) -> None:
    """Refuses arguments that none of the files names: xacro ignores them."""
    text = "".join(Path(file).read_text(errors="replace") for file in files if Path(file).is_file())
    known = {first or second for first, second in re.findall(_ARGUMENT, text)}
    for name in arguments:
        if name not in known:
            near = difflib.get_close_matches(name, known, 3, 0.5) or sorted(known)
            hint = f"; it has: {', '.join(near)}" if near else "; it has none"
            raise FileError(f"'{path}' has no xacro argument '{name}'{hint}")


def _missingPackage(error: BaseException | None) -> str:
    """Returns the name of the package that an error misses, or ""."""
    while error is not None:
        if type(error).__name__ == "PackageNotFoundError" and error.args:
            return str(error.args[0])
        inner = getattr(error, "exc", None)  # of a XacroException
        error = inner if isinstance(inner, BaseException) else error.__cause__ or error.__context__
    return ""


def _oneLine(error: Exception, said: str) -> str:
    words = [" ".join(str(error).split()), *(line.strip() for line in said.splitlines())]
    return "; ".join(dict.fromkeys(word for word in words if word)) or type(error).__name__
