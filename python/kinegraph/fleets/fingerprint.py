"""Fingerprints of functions and items, so that the results of an earlier version are not continued."""

from __future__ import annotations

import functools
import hashlib
import pickle
import sys
import sysconfig
import types
from pathlib import Path
from typing import Any

import numpy as np

from .._core import Config

_INSTALLED = tuple(Path(sysconfig.get_path(name)).resolve() for name in ("stdlib", "purelib", "platlib"))


def fingerprint(value: Any) -> str:
    """Returns a text that is equal for equal values, in every process.

    A function counts with its code, its defaults, and the values and functions that it refers to. Functions and classes
    of installed packages count with their name, and so do other objects of unknown content. Comments, line numbers and
    docstrings do not count.
    """
    collected = hashlib.blake2b(digest_size=12)
    _Walk(collected).add(value)
    return collected.hexdigest()


class _Walk:
    def __init__(self, collected: Any):
        self._collected = collected
        self._seen: dict[int, Any] = {}  # with the objects themselves, so that no number is used twice

    def add(self, value: Any) -> None:
        if value is None or isinstance(value, (bool, int, float, complex, str, bytes, np.generic)):
            self._text(type(value).__name__, repr(value))
        elif id(value) in self._seen:
            self._text("again", "")
        else:
            self._seen[id(value)] = value
            self._content(value)

    def _content(self, value: Any) -> None:
        if isinstance(value, types.CodeType):
            self._code(value)
        elif isinstance(value, types.FunctionType):
            self._function(value)
        elif isinstance(value, types.MethodType):
            self._all("method", [value.__func__, value.__self__])
        elif isinstance(value, functools.partial):
            self._all("partial", [value.func, value.args, value.keywords])
        elif isinstance(value, np.ndarray) and not value.dtype.hasobject:
            self._text("array", f"{value.dtype} {value.shape} {hashlib.blake2b(value.tobytes()).hexdigest()}")
        elif isinstance(value, Config):
            self._text("scene", hashlib.blake2b(pickle.dumps(value)).hexdigest())
        elif isinstance(value, (list, tuple)):
            self._all(type(value).__name__, value)
        elif isinstance(value, dict):
            self._all("dict", [part for item in value.items() for part in item])
        elif isinstance(value, (set, frozenset)):
            self._all("set", sorted(fingerprint(part) for part in value))
        elif isinstance(value, type):
            self._class(value)
        elif not isinstance(value, types.ModuleType) and _isOwn(type(value)):
            self._all("object", [type(value), getattr(value, "__dict__", None)])
        else:
            name = getattr(value, "__qualname__", None) or getattr(value, "__name__", None) or type(value).__qualname__
            self._text("name", f"{getattr(value, '__module__', '')}.{name}")

    def _text(self, kind: str, text: str) -> None:
        self._collected.update(f"{kind}:{len(text)}:{text};".encode())

    def _all(self, kind: str, parts: Any) -> None:
        parts = list(parts)
        self._text(kind, str(len(parts)))
        for part in parts:
            self.add(part)

    def _code(self, code: types.CodeType) -> None:
        self._text("code", f"{code.co_code.hex()} {code.co_names} {code.co_varnames} {code.co_freevars}")
        constants = code.co_consts
        if constants and code.co_flags & 0x4000000:  # CO_HAS_DOCSTRING of Python 3.14
            constants = constants[1:]
        self._all("constants", constants)

    def _function(self, function: types.FunctionType) -> None:
        self._text("function", function.__qualname__)
        if not _isOwn(function):
            self._text("module", function.__module__)
            return
        code = function.__code__
        if function.__doc__ is not None and code.co_consts[:1] == (function.__doc__,):
            code = code.replace(co_consts=(None, *code.co_consts[1:]))
        self.add(code)
        self._all("defaults", [function.__defaults__, function.__kwdefaults__])
        self._all("closure", [_content(cell) for cell in function.__closure__ or ()])
        for name in sorted(_namesOf(code)):
            if name in function.__globals__:
                self._text("global", name)
                self.add(function.__globals__[name])

    def _class(self, kind: type) -> None:
        self._text("class", f"{kind.__module__}.{kind.__qualname__}")
        if _isOwn(kind):
            members = {name: part for name, part in vars(kind).items() if not name.startswith("__") or callable(part)}
            for name in sorted(members):
                self._text("member", name)
                self.add(getattr(members[name], "__func__", members[name]))


def _namesOf(code: types.CodeType) -> set[str]:
    """Returns the names that a function and those within it refer to."""
    inner = (_namesOf(part) for part in code.co_consts if isinstance(part, types.CodeType))
    return set(code.co_names).union(*inner)


def _content(cell: types.CellType) -> Any:
    try:
        return cell.cell_contents
    except ValueError:  # not set yet
        return None


def _isOwn(defined: Any) -> bool:
    """Returns whether a function or class belongs to the user's program, and not to an installed package."""
    module = sys.modules.get(getattr(defined, "__module__", None) or "")
    if module is None or module.__name__ == "__main__":
        return True
    if module.__name__.split(".")[0] in ("kinegraph", "builtins"):
        return False
    file = getattr(module, "__file__", None)
    return file is not None and not any(Path(file).resolve().is_relative_to(folder) for folder in _INSTALLED)
