"""Tables of options, from the signatures and docstrings that the code makes of its own tables of options.

The column "expects" has the words of the message that refuses another value, so it comes from the same tables.
"""

import contextlib
import math
import re
import warnings
from collections.abc import Callable
from dataclasses import dataclass

from option_calls import calls

import kinegraph as ry

SHORTEST = 4  # options; fewer are a list
DEFAULT = re.compile(r"\s*Default (?P<value>.+?)(?:, in (?P<unit>[^,]+?))?\.$")
IN_UNIT = re.compile(r"(?<=\.) In (?P<unit>[^.]+)\.$")
EXPECTED = re.compile(r"expected (?P<words>.+?)(?:, in [\w/^ ]+)?$")
WRONG_VALUES = (object(), math.nan, -100000000, "no such word")


@dataclass
class Option:
    name: str
    meaning: str
    type: str = ""
    default: str = ""
    unit: str = ""
    expects: str = ""


def optionFrom(name: str, text: str, type: str = "", default: str = "") -> Option:
    """Takes default and unit out of the last sentence of a docstring."""
    unit = ""
    if found := DEFAULT.search(text):
        default, unit = default or found["value"], found["unit"] or ""
    elif found := IN_UNIT.search(text):
        unit = found["unit"]
    return Option(name, (text[: found.start()] if found else text).strip(), type, default, unit)


def expectation(call: Callable[..., object], name: str) -> str:
    """The valid values of an option, from the message that refuses an invalid one; "" if any value is valid."""
    words = ""
    for wrong in WRONG_VALUES:
        if isinstance(wrong, str) and words not in ("", "a text"):
            continue
        with contextlib.suppress(TypeError, ry.NotFound):
            try:
                call(**{name: wrong})
            except ry.ArgumentError as error:
                message = str(error)
                if (name in message or not words) and (found := EXPECTED.search(message)):
                    words = found["words"]
    return re.sub(r"^1 finite ones$", "a finite number per dof", words)


def expectations(name: str, options: list[Option]) -> None:
    """Fills in the column "expects" of the names that option_calls can call."""
    call = calls().get(name)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # those of valid values
        for option in options if call else []:
            option.expects = expectation(call, option.name)


def cell(text: str, as_code: bool = False) -> str:
    text = " ".join(text.split()).replace("|", "\\|")
    return f"`{text}`" if as_code and text else text


def table(options: list[Option]) -> list[str]:
    """A table in Markdown; columns without any entry are left out."""
    columns = [
        ("meaning", lambda o: cell(o.meaning)),
        ("default", lambda o: cell(o.default, True)),
        ("unit", lambda o: cell(o.unit)),
        ("expects", lambda o: cell(o.expects)),
        ("type", lambda o: cell(o.type, True)),
    ]
    shown = [(title, text) for title, text in columns if any(text(option) for option in options)]
    head = ["option", *(title for title, _ in shown)]
    rows = [[cell(option.name, True), *(text(option) for _, text in shown)] for option in options]
    lines = [f"| {' | '.join(row)} |" for row in (head, ["---"] * len(head), *rows)]
    return ["", *lines, ""]
