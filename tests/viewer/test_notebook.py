"""The viewer in a notebook."""

from __future__ import annotations

import html
import re
import sys
from types import SimpleNamespace

import pytest

import kinegraph as kg

from .browser import Browser


@pytest.fixture
def shown(monkeypatch: pytest.MonkeyPatch) -> list:
    """What a notebook was told to show, while IPython's kernel seems to run."""
    shown: list = []
    shell = SimpleNamespace(config={"IPKernelApp": {}})
    frame = SimpleNamespace(IFrame=lambda *arguments: arguments, display=shown.append)
    monkeypatch.setitem(sys.modules, "IPython", SimpleNamespace(get_ipython=lambda: shell, display=frame))
    monkeypatch.setitem(sys.modules, "IPython.display", frame)
    return shown


def test_the_page_appears_below_the_cell_once(shown: list, config: kg.Config) -> None:
    config.addFrame("world")
    config.view()
    config.view()
    assert shown == [(config.viewer().url, "100%", 480)]


def test_nothing_is_shown_outside_of_notebooks(shown: list, config: kg.Config, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys.modules["IPython"], "get_ipython", lambda: None)
    config.view()
    assert shown == []


def test_a_viewer_is_a_picture_that_can_be_turned(config: kg.Config, browser: Browser, tmp_path) -> None:
    config.addFrame("the box").setShape(kg.ST.box, [0.1, 0.2, 0.3]).setPosition([1, 2, 3])
    config.view()
    frame = config.viewer()._repr_html_()
    config.view_close()
    page = html.unescape(
        re.fullmatch(r'<iframe srcdoc="([^"]*)" width="100%" height="480" style="[^"]*"></iframe>', frame)[1]
    )
    (tmp_path / "page.html").write_text(page)
    browser.open((tmp_path / "page.html").as_uri())
    assert browser.evaluate("kinegraph.position('the box')") == [1, 2, 3]
