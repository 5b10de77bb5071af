"""Packages of the extras, which are imported when they are needed."""

from __future__ import annotations

import importlib
from typing import Any

from .errors import NotFound


def needed(module: str, extra: str = "mcap") -> Any:
    """Imports a module of an extra.

    Args:
        module: Its name.
        extra: The extra that installs it.
    Returns:
        The module.
    Raises:
        NotFound: It is not installed.
    """
    try:
        return importlib.import_module(module)
    except ImportError:
        package = module.split(".")[0]
        raise NotFound(f"the package {package} is not installed: pip install 'kinegraph[{extra}]'") from None
