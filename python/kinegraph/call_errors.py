"""Explains arguments that match no signature of a compiled function. Loaded with the first such error."""

from __future__ import annotations

import enum
import re
from collections.abc import Callable, Mapping, Sequence
from types import MethodType
from typing import Any

import numpy as np

from . import _core
from .enums import foreignHint
from .errors import ArgumentTypeError


class _Parameter:
    """A parameter of a signature: its name, its type as written there, and whether it is optional."""

    def __init__(self, text: str, keyword_only: bool, defaults: Sequence[Any]) -> None:
        name, _, rest = text.partition(":")
        type_text, has_default, default = rest.partition("=")
        self.name = name.strip().lstrip("*")
        self.stars = len(name.strip()) - len(self.name)
        self.type = type_text.strip() or "typing.Any"
        if self.name in ("C", "config"):  # functions that check it themselves accept any object
            self.type = self.type.replace("object", "Config")
        self.optional = bool(has_default) or self.stars > 0
        self.keyword_only = keyword_only
        default = default.strip()  # nanobind writes an index into the list of defaults, or a text
        self.default = repr(defaults[int(default[1:])]) if default.startswith("\\") else default

    def __str__(self) -> str:
        if self.stars:
            return "*" * self.stars + self.name
        return f"{self.name}: {readable(self.type)}" + (f" = {self.default}" if self.optional else "")


def split(text: str, separator: str) -> list[str]:
    """Splits a text at separators outside brackets.

    Args:
        text: A type, as in `dict[str, int] | None`.
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
    """Parses the parameters of a signature, including self.

    Args:
        signature: In nanobind's format, `def name(self, ...) -> type`.
        defaults: The values of `\\0`, `\\1`, ... in it.
    Returns:
        The parameters.
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
    """Returns the position after the bracket that closes the parameters."""
    depth = 0
    for i, character in enumerate(signature):
        depth += (character in "[({") - (character in "])}")
        if character == ")" and depth == 0:
            return i + 1
    return len(signature)


def readable(type_text: str) -> str:
    """Shortens a type for messages.

    Args:
        type_text: Type in a signature, `kinegraph._core.JT`.
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
    """Returns whether a value may have a type; true if that is unknown.

    Args:
        value: An argument.
        type_text: Its type in the signature.
    Returns:
        False if the value certainly has another type.
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
    import difflib  # not at import: it takes milliseconds, and is rarely needed

    near = difflib.get_close_matches(name, names, 3, 0.5)
    if not near:
        lower = {each.lower(): each for each in names}
        near = [lower[each] for each in difflib.get_close_matches(name.lower(), lower, 3, 0.5)]
    return f"; similar names: {', '.join(near)}" if near else ""


# How objects are read from files.
_READERS: dict[str, Callable[[str], str]] = {
    "Config": lambda file: f"C = Config(); C.addFile({file!r})",
    "Domain": lambda file: f"Domain.from{'Pddl' if file.endswith('.pddl') else 'Fol'}({file!r})",
    "LogicProblem": lambda file: f"LogicProblem.fromPddl(domain, {file!r})",
}


def _memberHint(value: str, kind: type[enum.Enum]) -> str:
    names = list(kind.__members__)
    if value in names:
        return f"; write {kind.__name__}.{value}"
    return foreignHint(kind.__name__, value) or _near(value, names) or f"; as in {kind.__name__}.{names[0]}"


def _isMethod(value: Any) -> bool:
    return isinstance(value, MethodType) or type(value).__name__ == "nb_bound_method"


def _resultHint(value: Any, parameter: _Parameter) -> str:
    """Suggests the numbers of a result, or the timing of a path."""
    kind = readable(parameter.type)
    if "ArrayLike" in kind and isinstance(value, _core.IkResult):
        return "; write result.q"
    if "ArrayLike" in kind and isinstance(value, _core.Trajectory):
        has_path = hasattr(value, "path") and "path" in parameter.name.lower()
        return "; write plan.path" if has_path else "; plan.eval(t)[0] is its configuration at the time t"
    if kind == "Trajectory" and _isNumbers(value):
        return "; ry.retime(path, velocity, acceleration) times a path"
    return ""


def _hint(value: Any, type_text: str) -> str:
    """Suggests a correction, if one is known."""
    if _isMethod(value):
        return f"; call it: {value.__name__}()"
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
        if isinstance(value, str) and name in _READERS:
            return f"; read a file by {_READERS[name](value)}"
    return ""


def _shown(value: Any) -> str:
    text = " ".join(repr(value).split())
    if isinstance(value, type):
        return f"the class {value.__name__}"
    if _isMethod(value):
        return f"the method {value.__name__}"
    if len(text) > 60:
        text = text[:57] + "..."
    return text if value is None or isinstance(value, enum.Enum) else f"{text} ({type(value).__name__})"


def _place(value: Any) -> str:
    """Describes the entry of a list that is not a number."""
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
    reasons = f"{parameter.name} is {_shown(value)}; expected {_expected(parameter.type)}"
    hint = _hint(value, parameter.type) or _resultHint(value, parameter)
    return reasons + (hint or (_place(value) if "ArrayLike" in parameter.type else ""))


def _surplusHint(takes: Sequence[_Parameter], given: Sequence[Any]) -> str:
    """Suggests a list for numbers that are given one by one, as the last argument."""
    numbers = given[max(0, len(takes) - 1) :]
    one_by_one = len(numbers) > 1 and all(isinstance(value, (int, float, np.number)) for value in numbers)
    if one_by_one and takes and "ArrayLike" in takes[-1].type:
        return f"; write one list: [{', '.join(f'{value:g}' for value in numbers)}]"
    return ""


class _Misfit:
    """The reasons why a signature does not match the arguments."""

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
        self.reasons = []
        if surplus:
            own = [each for each in by_place if each.name != "self"]
            taken = [each.name for each in own]
            count = len(positional) - (len(by_place) - len(taken))
            takes = f"it takes at most {len(taken)}: {', '.join(taken)}" if taken else "it takes no positional ones"
            hint = _surplusHint(own, positional[-count:])
            self.reasons.append(f"{count} argument{'s are' if count > 1 else ' is'} given; {takes}{hint}")
        names = [name for name in by_name if name != "self"]
        self.reasons += [f"it has no argument '{name}'{_near(name, names)}" for name in unknown]
        if missing:
            self.reasons.append(f"missing: {', '.join(f'{each.name} ({_expected(each.type)})' for each in missing)}")
        self.reasons += [_wrong(value, each) for each, value in wrong]


def _title(function: Any, positional: Sequence[Any]) -> tuple[str, str]:
    """Returns a function's name in messages, and in a signature."""
    name = str(function.__name__)
    owner = type(positional[0]).__name__ if positional and type(function).__name__ == "nb_method" else ""
    for each in type(positional[0]).__mro__ if owner else ():
        if vars(each).get(name) is function:
            owner = each.__name__
    if name == "__init__":
        return owner, owner
    return (f"{owner}.{name}" if owner else name), name


def explain(function: Any, positional: Sequence[Any], named: Mapping[str, Any]) -> Exception:
    """Creates the error for arguments that match no signature of a function.

    Args:
        function: A function of the compiled module.
        positional: Positional arguments, including self.
        named: Keyword arguments.
    Returns:
        An ArgumentTypeError with the argument's name, its value, and the expected type.
    """
    title, short = _title(function, positional)
    forms = [parameters(signature, defaults or ()) for signature, _, defaults in function.__nb_signature__]
    misfits = [_Misfit(form, positional, named) for form in forms]
    nearest = min((each for each in misfits if each.reasons), key=lambda each: each.rank, default=misfits[0])
    reasons = "; ".join(nearest.reasons[:2]) or "no signature matches these arguments"
    if title in _READERS and len(positional) == 2 and isinstance(positional[1], str):
        reasons += f"; read a file by {_READERS[title](positional[1])}"
    written = [f"{short}({', '.join(str(each) for each in form if each.name != 'self')})" for form in forms]
    return ArgumentTypeError("\n  ".join([f"{title}: {reasons}", *written]))
