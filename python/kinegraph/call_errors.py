"""What is wrong with arguments that no form of a compiled function takes, in words. Loaded when that happens first."""

from __future__ import annotations

import difflib
import enum
import re
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from . import _core
from .errors import ArgumentTypeError


class _Parameter:
    """One of a form's parameters: its name, its type as the signature has it, and whether it may be left out."""

    def __init__(self, text: str, keyword_only: bool, defaults: Sequence[Any]) -> None:
        name, _, rest = text.partition(":")
        type_text, has_default, default = rest.partition("=")
        self.name = name.strip().lstrip("*")
        self.stars = len(name.strip()) - len(self.name)
        self.type = type_text.strip() or "typing.Any"
        if self.name in ("C", "config"):  # what looks at it itself takes any object
            self.type = self.type.replace("object", "Config")
        self.optional = bool(has_default) or self.stars > 0
        self.keyword_only = keyword_only
        default = default.strip()  # nanobind writes a number of the list of defaults, or the text of one
        self.default = repr(defaults[int(default[1:])]) if default.startswith("\\") else default

    def __str__(self) -> str:
        if self.stars:
            return "*" * self.stars + self.name
        return f"{self.name}: {readable(self.type)}" + (f" = {self.default}" if self.optional else "")


def split(text: str, separator: str) -> list[str]:
    """The parts of a text between separators that stand in no bracket.

    Args:
        text: As in `dict[str, int] | None`.
        separator: A character.
    Returns:
        The parts, stripped.
    """
    parts, depth = [""], 0
    for character in text:
        depth += (character in "[({") - (character in "])}")
        if character == separator and depth == 0:
            parts.append("")
        else:
            parts[-1] += character
    return [part.strip() for part in parts if part.strip()]


def parameters(signature: str, defaults: Sequence[Any] = ()) -> list[_Parameter]:
    """The parameters of a form, self among them.

    Args:
        signature: As nanobind gives it, `def name(self, ...) -> type`.
        defaults: What stands for `\\0`, `\\1`, ... in it.
    Returns:
        One each.
    """
    inside = signature[signature.index("(") + 1 : signature.rindex(")", 0, _end(signature))]
    found, keyword_only = [], False
    for part in split(inside, ","):
        if part in ("*", "/"):
            keyword_only = keyword_only or part == "*"
            continue
        found.append(_Parameter(part, keyword_only, defaults))
        keyword_only = keyword_only or found[-1].stars == 1
    return found


def _end(signature: str) -> int:
    """Behind the bracket that closes the parameters."""
    depth = 0
    for i, character in enumerate(signature):
        depth += (character in "[({") - (character in "])}")
        if character == ")" and depth == 0:
            return i + 1
    return len(signature)


def readable(type_text: str) -> str:
    """A type as people write it.

    Args:
        type_text: As the signature has it, `kinegraph._core.JT`.
    Returns:
        `JT`.
    """
    return re.sub(r"\b(?:kinegraph|_core|numpy|typing|collections|abc)\.", "", type_text)


def _isNumbers(value: Any) -> bool:
    try:
        np.asarray(value, float)
    except (TypeError, ValueError, OverflowError):
        return False
    return value is not None and not isinstance(value, (str, bytes, enum.Enum))


_PLAIN: dict[str, Any] = {
    "None": lambda value: value is None,
    "bool": lambda value: isinstance(value, (bool, np.bool_)),
    "int": lambda value: hasattr(value, "__index__"),
    "float": lambda value: hasattr(value, "__float__") or hasattr(value, "__index__"),
    "str": lambda value: isinstance(value, str),
}


def fits(value: Any, type_text: str) -> bool:
    """Whether a value may be what a type asks for; true where that cannot be told.

    Args:
        value: An argument.
        type_text: Its type as the signature has it.
    Returns:
        False if it is certainly of another type.
    """
    alternatives = split(type_text, "|")
    if len(alternatives) > 1:
        return any(fits(value, each) for each in alternatives)
    name = readable(type_text)
    if name in _PLAIN:
        return bool(_PLAIN[name](value))
    if name.startswith(("ArrayLike", "NDArray", "npt.")) or ".ArrayLike" in name:
        return _isNumbers(value)
    if name.startswith(("Sequence[", "list[")):
        inner = name[name.index("[") + 1 : -1]
        is_list = isinstance(value, (Sequence, np.ndarray)) and not isinstance(value, (str, bytes))
        return is_list and all(fits(each, inner) for each in value)
    if name.startswith(("dict", "Mapping")):
        return isinstance(value, Mapping)
    if name.startswith("Callable"):
        return callable(value)
    if name.startswith("os.PathLike"):
        return hasattr(value, "__fspath__")
    kind = getattr(_core, name, None)
    return isinstance(value, kind) if isinstance(kind, type) else True


def _near(name: str, names: list[str]) -> str:
    near = difflib.get_close_matches(name, names, 3, 0.5)
    if not near:
        lower = {each.lower(): each for each in names}
        near = [lower[each] for each in difflib.get_close_matches(name.lower(), lower, 3, 0.5)]
    return f"; similar names: {', '.join(near)}" if near else ""


def _memberHint(value: str, kind: type[enum.Enum]) -> str:
    names = list(kind.__members__)
    if value in names:
        return f"; write {kind.__name__}.{value}"
    return _near(value, names) or f"; as in {kind.__name__}.{names[0]}"


def _hint(value: Any, type_text: str) -> str:
    """How to mend it, if that is known."""
    for name in map(readable, split(type_text, "|")):
        kind = getattr(_core, name, None)
        if isinstance(value, str) and isinstance(kind, type) and issubclass(kind, enum.Enum):
            return _memberHint(value, kind)
        if isinstance(value, str) and name == "Frame":
            return f"; write C.getFrame({value!r})"
        if isinstance(value, _core.Frame) and name in ("str", "Sequence[str]"):
            return f"; write the frame's name, {value.name!r}" if name == "str" else f"; write [{value.name!r}]"
        if isinstance(value, str) and name == "Sequence[str]":
            return f"; write [{value!r}]"
        if isinstance(value, _core.KOMO) and name == "NLP":
            return "; write komo.nlp()"
    return ""


def _shown(value: Any) -> str:
    text = " ".join(repr(value).split())
    if isinstance(value, type):
        return f"the class {value.__name__}"
    if len(text) > 60:
        text = text[:57] + "..."
    return text if value is None or isinstance(value, enum.Enum) else f"{text} ({type(value).__name__})"


def _place(value: Any) -> str:
    """Which entry of a list is no number."""
    if not isinstance(value, (list, tuple)):
        return ""
    for i, each in enumerate(value):
        if isinstance(each, (list, tuple, np.ndarray)):
            return "; its rows have different lengths" if len({np.size(row) for row in value}) > 1 else _place(each)
        if not _isNumbers(each):
            return f"; entry {i} is {_shown(each)}"
    return ""


def _expected(type_text: str) -> str:
    return readable(type_text).replace("ArrayLike", "numbers").replace(" | ", " or ")


def _wrong(value: Any, parameter: _Parameter) -> str:
    said = f"{parameter.name} is {_shown(value)}; expected {_expected(parameter.type)}"
    hint = _hint(value, parameter.type)
    return said + (hint or (_place(value) if "ArrayLike" in parameter.type else ""))


class _Misfit:
    """What keeps one form of a function from taking these arguments."""

    def __init__(self, form: list[_Parameter], positional: Sequence[Any], named: Mapping[str, Any]) -> None:
        by_place = [each for each in form if not each.keyword_only and not each.stars]
        by_name = {each.name: each for each in form if not each.stars}
        takes_more, takes_any_name = (any(each.stars == stars for each in form) for stars in (1, 2))
        surplus = 0 if takes_more else max(0, len(positional) - len(by_place))
        unknown = [] if takes_any_name else [name for name in named if name not in by_name]
        given = [
            *zip(by_place, positional, strict=False),
            *((by_name[name], value) for name, value in named.items() if name in by_name),
        ]
        found = [each for each, _ in given]
        missing = [each for each in form if not each.optional and each not in found]
        wrong = [(each, value) for each, value in given if each.name != "self" and not fits(value, each.type)]
        self.rank = (surplus + len(unknown) + len(wrong), len(missing), -len(form))
        self.said = []
        if surplus:
            names = [each.name for each in by_place if each.name != "self"]
            count = len(positional) - (len(by_place) - len(names))
            takes = f"it takes at most {len(names)}: {', '.join(names)}" if names else "it takes none without a name"
            self.said.append(f"{count} argument{'s are' if count > 1 else ' is'} given; {takes}")
        self.said += [f"it has no argument '{name}'{_near(name, [*by_name])}" for name in unknown]
        if missing:
            self.said.append(f"missing: {', '.join(f'{each.name} ({_expected(each.type)})' for each in missing)}")
        self.said += [_wrong(value, each) for each, value in wrong]


def _title(function: Any, positional: Sequence[Any]) -> tuple[str, str]:
    """How it is called in messages, and in a signature."""
    name = str(function.__name__)
    owner = type(positional[0]).__name__ if positional and type(function).__name__ == "nb_method" else ""
    for each in type(positional[0]).__mro__ if owner else ():
        if vars(each).get(name) is function:
            owner = each.__name__
    if name == "__init__":
        return owner, owner
    return (f"{owner}.{name}" if owner else name), name


def explain(function: Any, positional: Sequence[Any], named: Mapping[str, Any]) -> Exception:
    """The error for arguments that no form of a function takes.

    Args:
        function: A function of the compiled module.
        positional: The arguments without a name, self among them.
        named: Those with one.
    Returns:
        An ArgumentTypeError that names the argument, what it is, and what was expected.
    """
    title, short = _title(function, positional)
    forms = [parameters(signature, defaults or ()) for signature, _, defaults in function.__nb_signature__]
    misfits = [_Misfit(form, positional, named) for form in forms]
    nearest = min((each for each in misfits if each.said), key=lambda each: each.rank, default=misfits[0])
    said = "; ".join(nearest.said[:2]) or "no form of it takes these arguments"
    written = [f"{short}({', '.join(str(each) for each in form if each.name != 'self')})" for form in forms]
    return ArgumentTypeError("\n  ".join([f"{title}: {said}", *written]))
