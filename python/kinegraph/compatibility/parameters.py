"""Defaults that scripts set by name, like the reference's global parameters: `params_add({'opt/damping': .1})`."""

from __future__ import annotations

import warnings
from collections.abc import Mapping
from pathlib import Path
from types import NoneType
from typing import Any

from .._core import NLP_SolverOptions, parseText
from ..errors import ArgumentError, FileError, KinegraphWarning

RRT_OPTIONS = (
    "verbose",
    "stepsize",
    "subsamples",
    "maxIters",
    "p_connect",
    "collisionTolerance",
    "useBroadCollisions",
)
# What calls read; those of other groups are the script's own.
_KNOWN = (
    "bot/blockRealRobot",
    "botsim/engine",
    "botsim/hyperSpeed",
    "botsim/realtime",
    "botsim/tau",
    "disableGui",
    "noInteractivity",
    "physx/defaultFriction",
    "problem/dim",
    "Render/backgroundColor",
    "Render/flatColors",
    "Render/floorColor",
    "Render/lights",
    "Render/renderPolygonLines",
    "Render/renderShadow",
    "Render/renderText",
    *(f"rrt/{option}" for option in RRT_OPTIONS),
)
_GROUPS = {name.split("/")[0] for name in _KNOWN if "/" in name}
_values: dict[str, Any] = {}
solver_options: dict[str, Any] = {}  # fields of NLP_SolverOptions set by scripts; the defaults of solvers


def params_add(values: dict[str, Any] | None = None, **more: Any) -> None:
    """Sets parameters, from a dict or from keyword arguments.

    Those named 'opt/<field>' are defaults of NLP_SolverOptions. Scripts may keep parameters of their own. A name that
    no call reads, but that is close to one or of its group ('botsim/...'), causes a KinegraphWarning. The page
    "Conventions" lists all with their values.

    Args:
        values: A dict from names to values.
        more: Parameters by keyword.
    Raises:
        ArgumentError: NLP_SolverOptions has no such field, or the value is invalid; or values is not a dict.
    """
    if not isinstance(values, (Mapping, NoneType)):
        raise ArgumentError(f"params_add: values is {values!r}; expected a dict from names to values")
    for name, value in {**(values or {}), **more}.items():
        if name.startswith("opt/"):
            field = {name.removeprefix("opt/"): value}
            NLP_SolverOptions(**field)
            solver_options.update(field)
        else:
            _checkName(name)
        _values[name] = value


def _checkName(name: str) -> None:
    """Warns of a parameter that seems to be misspelled."""
    lower = {known.lower(): known for known in _KNOWN}
    import difflib  # not at import: it takes milliseconds, and is rarely needed

    near = difflib.get_close_matches(name.lower(), lower, cutoff=0.8)
    if name in _KNOWN or not (near or name.split("/")[0] in _GROUPS):
        return
    hint = f"; similar names: {', '.join(lower[other] for other in near)}" if near else ""
    warnings.warn(f"params_add: no call reads a parameter '{name}'{hint}", KinegraphWarning, stacklevel=3)


def params_file(filename: str) -> None:
    """Adds the parameters of a file in .g syntax.

    Args:
        filename: Path of the file.
    Raises:
        FileError: There is no such file, or it cannot be read.
        ParseError: The file is invalid.
    """
    try:
        text = Path(filename).read_text()
    except (OSError, TypeError, ValueError) as error:
        raise FileError(f"params_file: parameter file {filename!r} cannot be read: {error}") from None
    params_add(parseText(text, str(filename)))


def params_get() -> dict[str, Any]:
    """Returns a copy of all parameters that have been set."""
    return dict(_values)


def params_clear() -> None:
    """Removes all parameters."""
    _values.clear()
    solver_options.clear()


def params_print() -> None:
    """Prints all parameters, one per line; true as `name`, false as `name!`."""
    for name, value in sorted(_values.items()):
        print(name if value is True else f"{name}!" if value is False else f"{name}: {value}")


set_params = params_add
get_params = params_get
clear_params = params_clear
