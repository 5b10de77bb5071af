"""Dicts as YAML text."""

from __future__ import annotations

import json
from typing import Any


def plainValue(value: Any) -> Any:
    """Returns an array or a number of numpy as lists and numbers, for json.

    Args:
        value: The array or number.
    Raises:
        TypeError: It is no array and no number.
    """
    if hasattr(value, "tolist"):
        return value.tolist()
    raise TypeError(f"a dict has {value!r}; expected numbers, texts, lists, arrays and dicts")


def dict_as_yaml(data: dict[str, Any]) -> str:
    """Returns a dict as YAML, one entry per line; values are in flow style.

    Args:
        data: Numbers, texts, lists, arrays and dicts.
    Returns:
        The text.
    """
    return "".join(f"{json.dumps(str(key))}: {json.dumps(value, default=plainValue)}\n" for key, value in data.items())
