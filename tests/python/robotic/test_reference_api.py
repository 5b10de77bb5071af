"""Every name of robotic 0.4.2 is there, or says what to call instead; calls take the same arguments under the same
names."""

from __future__ import annotations

import importlib
import inspect
import re
from typing import Any

import pytest

import kinegraph
import robotic as ry
from conftest import recorded
from kinegraph.compatibility.absent import ABSENT
from kinegraph.compatibility.guessed import GUESSED

NAMES: dict[str, list[list[str]] | None] = recorded("reference_api")["names"]

# `from` is a word of Python, so that nobody can give it by name; setQuad calls two of its numbers h.
OTHER_NAMES = {"from": {"from_", "frm", "start"}, "to": {"to", "end"}, "h": {"h", "x"}}
SAYS_WHAT_INSTEAD = re.compile(r"instead: |does not have it yet; ")


def resolved(name: str) -> Any:
    value: Any = ry
    for part in name.split("."):
        value = getattr(value, part)
    return value


def listed(arguments: str) -> list[str]:
    """Splits at commas outside of brackets."""
    parts, depth = [""], 0
    for c in arguments:
        depth += (c in "([{") - (c in ")]}")
        if c == "," and depth == 0:
            parts.append("")
        else:
            parts[-1] += c
    return [part.strip() for part in parts]


def own_signatures(call: Any) -> list[list[str]]:
    """Returns the names of the arguments of each form of a call, with = behind those that need not be given."""
    if inspect.isclass(call):
        call = call.__init__
    forms = getattr(call, "__nb_signature__", None)
    if forms is None:
        parameters = inspect.signature(call).parameters.values()
        empty = inspect.Parameter.empty
        marks = {inspect.Parameter.VAR_POSITIONAL: "*", inspect.Parameter.VAR_KEYWORD: "**"}
        names = [marks.get(p.kind, "") + p.name + ("=" if p.default is not empty else "") for p in parameters]
        return [[name for name in names if name != "self"]]
    result = []
    for form in forms:
        inside = re.match(r"def \w+\((.*)\) ->", form[0].replace("\n", " "))
        assert inside, form[0]
        names = [re.findall(r"^\*{0,2}\w*", part)[0] + ("=" if " = " in part else "") for part in listed(inside[1])]
        result.append([name for name in names if name not in ("self", "")])
    return result


def fits(theirs: list[str], ours: list[str]) -> bool:
    """Can a call by these arguments, by place or by name, be made?"""
    if any(name.startswith("*") and name != "*" for name in ours):
        return True
    by_place = ours[: ours.index("*")] if "*" in ours else ours
    if len(by_place) < len(theirs) or any(not name.endswith("=") for name in by_place[len(theirs) :]):
        return False
    for one, other in zip(theirs, by_place):
        name = one.rstrip("=")
        same = other.rstrip("=") in OTHER_NAMES.get(name, {name}) or re.fullmatch(r"arg\d+", name)
        if not same or (one.endswith("=") and not other.endswith("=")):
            return False
    return True


@pytest.mark.parametrize("name", NAMES)
def test_a_name_of_the_reference_is_there_or_says_what_to_call(name: str) -> None:
    try:
        value = resolved(name)
    except AttributeError as error:
        assert SAYS_WHAT_INSTEAD.search(str(error)), f"{name}: {error}"
        return
    for theirs in NAMES[name] or []:
        assert any(fits(theirs, ours) for ours in own_signatures(value)), f"{theirs}, and ours: {own_signatures(value)}"


@pytest.mark.parametrize("module", ["tools", "src"])
def test_modules_of_helpers_are_there(module: str) -> None:
    assert importlib.import_module(f"robotic.{module}") is getattr(ry, module)


WHAT_CALLS_GIVE = [kinegraph.ConfigurationViewer, kinegraph.CameraView, kinegraph.NLP]
OWNERS = {
    "C": kinegraph.Config,
    "komo": kinegraph.KOMO,
    "frame": kinegraph.Frame,
    "plan": kinegraph.MotionPlan,
    "bot": kinegraph.BotOp,
    "ry": kinegraph,
}
ADVICE = {(owner, name): text for table in (ABSENT, GUESSED) for owner in table for name, text in table[owner].items()}


@pytest.mark.parametrize(("owner", "name"), ADVICE)
def test_what_is_absent_says_what_to_call_and_that_is_there(owner: type, name: str) -> None:
    assert not hasattr(owner, name)
    with pytest.raises(AttributeError, match=rf"{owner.__name__}\.{name}: .* instead: "):
        getattr(owner, name)
    advice = ADVICE[owner, name]
    calls = re.findall(r"(?:(\w+)\.)?(\w+)\(", advice)
    for where, call in calls:
        known = OWNERS.get(where) or getattr(kinegraph, where, None)
        if where and known is None:
            continue
        candidates = [known] if known else [owner, *OWNERS.values(), *WHAT_CALLS_GIVE]
        assert any(hasattr(candidate, call) for candidate in candidates), f"{name}: {where}.{call}"
