"""Viewers in notebooks (Jupyter, VS Code)."""

from __future__ import annotations

import html
import sys

_HEIGHT = 480  # pixels


def isNotebook() -> bool:
    """Returns whether this is a kernel with rich output."""
    ipython = sys.modules.get("IPython")
    shell = ipython.get_ipython() if ipython else None
    return shell is not None and "IPKernelApp" in shell.config


def showInline(url: str) -> None:
    """Shows a viewer's page below the cell, if this is a notebook."""
    if isNotebook():
        from IPython.display import IFrame, display

        display(IFrame(url, "100%", _HEIGHT))


def inlineFrame(page: str, text: str = "") -> str:
    """Returns a page as an element of another one, with a text below it."""
    below = f"<pre>{html.escape(text)}</pre>" if text else ""
    return f'<iframe srcdoc="{html.escape(page)}" width="100%" height="{_HEIGHT}" style="border: 0"></iframe>{below}'
