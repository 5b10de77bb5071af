"""Objects made from nothing, or from a scene without joints: each call answers, or raises a typed error."""

from __future__ import annotations

import inspect
import itertools
import re
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import kinegraph as ry

UNTIMED = {"animate", "animateSpline", "grow", "play", "view", "view_play", "wait", "waitForClient", "watchFile"}


def scenes() -> list[ry.Config]:
    with_frame = ry.Config()
    with_frame.addFrame("a")
    return [ry.Config(), with_frame]


def values(annotation: str) -> list[Any]:
    """Some values for a parameter with this annotation, odd ones among them."""
    simple: dict[str, list[Any]] = {
        "Config": scenes(),
        "int": [0, -1, 7],
        "float": [0.0, 1.0, float("nan")],
        "bool": [True],
        "str": ["", "x"],
        "ArrayLike": [[], [0.0, 0.0, 0.0], np.zeros((2, 3))],
        "Sequence": [[], ["x"]],
        "Mapping": [{}],
        "Callable": [lambda *arguments: 0.0],
    }
    words = re.findall(r"\w+", annotation)
    found = [value for word in words for value in simple.get(word, [])]
    for word in words:
        kind = getattr(ry, word, None)
        if inspect.isclass(kind) and word not in simple:
            found += list(getattr(kind, "__members__", {}).values())[:2]
    return found or [None, 0, "x"]


def parameters(signature: str) -> list[tuple[str, bool]]:
    """Annotation of each parameter after self, and whether it has a default."""
    inside = signature[signature.index("(") + 1 : signature.rindex(")")]
    parts, depth, begin = [], 0, 0
    for place, letter in enumerate(inside + ","):
        depth += (letter in "([{") - (letter in ")]}")
        if letter == "," and depth == 0:
            parts.append(inside[begin:place].strip())
            begin = place + 1
    named = [part.partition(":") for part in parts if part and part[0] not in "*/" and part.split(":")[0] != "self"]
    return [(annotation, "=" in name + annotation) for name, _, annotation in named]


def arguments(call: Callable[..., Any], most: int) -> Iterator[tuple[Any, ...]]:
    """Arguments for the parameters without default, of each signature."""
    for signature, *_ in getattr(call, "__nb_signature__", ()):
        required = [
            values(annotation) for annotation, optional in parameters(signature.split(" ->")[0]) if not optional
        ]
        yield from itertools.islice(itertools.product(*required), most)


def makers(kind: type) -> list[Callable[[], Any]]:
    """Two ways at most to make an object of a class."""
    made: list[Callable[[], Any]] = []
    for given in itertools.chain([()], arguments(kind.__init__, 40)):  # type: ignore[misc]
        try:
            kind(*given)
        except (ry.Error, TypeError, OSError):
            continue
        made.append(lambda given=given: kind(*given))
        if len(made) == 2:
            break
    return made


def main(name: str) -> None:
    """Calls all methods of a class, and prints each call before it is made."""
    kind = getattr(ry, name)
    for make in makers(kind):
        for method in dir(kind):
            if method.startswith("_") or method in UNTIMED:
                continue
            try:
                call = getattr(make(), method)
            except (ry.Error, AttributeError):  # AttributeError: absent, with advice
                continue
            if not callable(call) or inspect.isclass(call):
                continue
            for given in arguments(getattr(kind, method), 12):
                print(f"{name}.{method}{given}", flush=True)
                try:
                    getattr(make(), method)(*given)
                except (ry.Error, TypeError, OSError):
                    continue


CLASSES = [
    name
    for name in sorted(ry.__all__)
    if inspect.isclass(kind := getattr(ry, name))
    and not hasattr(kind, "__members__")
    and not issubclass(kind, BaseException)
    and hasattr(kind.__init__, "__nb_signature__")  # a class with a constructor
]


@pytest.mark.parametrize("name", CLASSES)
def test_an_object_of_an_empty_scene_answers_or_raises_a_typed_error(name: str, tmp_path: Path) -> None:
    done = subprocess.run([sys.executable, __file__, name], cwd=tmp_path, capture_output=True, text=True, timeout=300)
    last = done.stdout.splitlines()[-1:]
    assert done.returncode == 0, f"exit status {done.returncode} of {last}: {done.stderr[-500:]}"


if __name__ == "__main__":
    import warnings

    warnings.simplefilter("ignore")
    main(sys.argv[1])
