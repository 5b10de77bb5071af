"""The viewer in a notebook."""

from __future__ import annotations

import base64
import html
import re
import sys
from pathlib import Path
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


def opened(frame: str, browser: Browser, folder: Path) -> None:
    page = html.unescape(re.fullmatch(r'<iframe srcdoc="([^"]*)".*></iframe>', frame)[1])
    (folder / "page.html").write_text(page)
    browser.open((folder / "page.html").as_uri())


def test_a_motion_is_an_element_that_plays_without_a_program(browser: Browser, tmp_path: Path) -> None:
    config = kg.Config()
    config.addFrame("base")
    config.addFrame("one", "base").setJoint(kg.JT.transX, [-3, 3]).setShape(kg.ST.box, [0.2, 0.2, 0.2])
    komo = kg.KOMO(config, 1, 4, 1, False)
    komo.addObjective([1], kg.FS.position, ["one"], kg.OT.eq, [1], [1, 0, 0])
    kg.NLP_Solver(komo.nlp(), verbose=0).solve()
    opened(komo._repr_html_(), browser, tmp_path)
    browser.wait_for("kinegraph.slice() === 3 && Math.abs(kinegraph.position('one')[0] - 1) < 1e-3")
    browser.press("ArrowLeft")
    browser.wait_for("kinegraph.slice() === 2")


def test_a_viewer_that_was_never_opened_is_a_page_as_well(browser: Browser, tmp_path: Path) -> None:
    config = kg.Config()
    config.addFrame("the box").setShape(kg.ST.box, [0.1, 0.2, 0.3]).setPosition([1, 2, 3])
    opened(config.viewer()._repr_html_(), browser, tmp_path)
    assert browser.evaluate("kinegraph.position('the box')") == [1, 2, 3]


def test_a_configuration_is_a_picture_and_a_table() -> None:
    config = kg.Config()
    config.addFrame("the box").setShape(kg.ST.box, [0.1, 0.2, 0.3])
    element = config._repr_html_()
    picture = re.search(r'<img alt="the scene" src="data:image/png;base64,([^"]*)">', element)
    assert base64.b64decode(picture[1]).startswith(b"\x89PNG")
    assert "the box" in element
