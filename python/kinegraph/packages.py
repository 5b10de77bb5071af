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
        ImportError: It is installed, but cannot be loaded, as without a library that it needs.
    """
    try:
        return importlib.import_module(module)
    except ModuleNotFoundError as error:
        package = module.split(".")[0]
        if error.name is None or error.name.split(".")[0] != package:
            raise
        raise NotFound(f"the package {package} is not installed: pip install 'kinegraph[{extra}]'") from None
