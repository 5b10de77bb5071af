"""Dicts as YAML text."""

from __future__ import annotations

import json
from typing import Any


def dict_as_yaml(data: dict[str, Any]) -> str:
    """Returns a dict as YAML, one entry per line; values are in flow style.

    Args:
        data: Numbers, texts, lists and dicts.
    Returns:
        The text.
    """
    return "".join(f"{json.dumps(str(key))}: {json.dumps(value)}\n" for key, value in data.items())
