"""The page shows forbidden contacts and ignored obstacles."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import kinegraph as kg

from .browser import Browser

MARKS = "kinegraph.warnings().marks"


@pytest.fixture
def panda(config: kg.Config) -> kg.Config:
    """A Panda with a box in its middle that collides with nothing."""
    config.addFile(kg.raiPath("scenarios/pandaSingle.g"))
    box = config.addFrame("a box").setShape(kg.ST.box, [0.25, 0.25, 0.25]).setColor([0.2, 0.4, 0.8])
    box.setPosition(config.getFrame("l_panda_joint4").getPosition())
    return config


def ignored(config: kg.Config) -> list[str]:
    return [warning for warning in config.contactWarnings() if "'a box'" in warning]


def test_an_obstacle_that_is_ignored_is_marked_and_the_page_says_why(panda: kg.Config, browser: Browser) -> None:
    panda.view()
    panda.viewer().setCamera([1.3, 1.5, 1.5], [0, 0, 0.95])
    browser.open(panda.viewer().url)
    browser.wait_for(f"{MARKS} === 1")
    (warning,) = ignored(panda)
    browser.press_alt("T")
    assert warning in browser.evaluate("document.querySelector('#warnings').innerText")
    assert (
        browser.evaluate("[...document.querySelectorAll('#tree .ignored')].map((x) => x.textContent).join()") == "a box"
    )
    browser.evaluate(
        "[...document.querySelectorAll('#warnings button')].find((x) => x.textContent === 'a box').click()"
    )
    browser.wait_for("kinegraph.selected() === 'a box'")
    assert warning in browser.evaluate("document.querySelector('#card').innerText")
    browser.press("Escape")
    browser.press("Escape")
    marked = browser.picture().astype(int)
    browser.press_alt("I")
    browser.wait_for(f"{MARKS} === 0")
    plain = browser.picture().astype(int)
    orange = (marked[..., 0] > marked[..., 2] + 80) & (np.abs(marked - plain).max(axis=2) > 30)
    rows, columns = np.nonzero(orange)
    assert len(rows) > 60
    x, y = browser.pixel(panda.getFrame("a box").getPosition())
    assert abs(columns.mean() - x) < 40 and abs(rows.mean() - y) < 40


def test_the_mark_goes_when_the_obstacle_counts_or_is_away(panda: kg.Config, browser: Browser) -> None:
    panda.view()
    browser.open(panda.viewer().url)
    browser.wait_for(f"{MARKS} === 1")
    panda.getFrame("a box").setContact(1)
    panda.view()
    browser.wait_for(f"{MARKS} === 0 && kinegraph.warnings().texts.every((text) => !text.includes('a box'))")
    panda.getFrame("a box").setContact(0)
    panda.view()
    browser.wait_for(f"{MARKS} === 1")
    panda.getFrame("a box").setPosition([3, 3, 0.2])
    panda.view()
    browser.wait_for(f"{MARKS} === 0")
    assert ignored(panda) == []


def test_people_see_it_where_they_move_a_joint_to(config: kg.Config, browser: Browser) -> None:
    config.addFrame("base")
    config.addFrame("slide", "base").setJoint(kg.JT.transX, [0, 2]).setShape(kg.ST.sphere, [0.1]).setContact(1)
    config.addFrame("a box").setShape(kg.ST.box, [0.2, 0.2, 0.2]).setPosition([1, 0, 0])
    config.view()
    browser.open(config.viewer().url)
    slider = "document.querySelector('input[type=range][aria-label=slide]')"
    browser.wait_for(f"{slider} !== null")
    for place, marks in ((0.9, 1), (0.2, 0)):
        browser.evaluate(f"{slider}.value = {place}; {slider}.dispatchEvent(new Event('input'))")
        browser.wait_for(f"{MARKS} === {marks}")
    assert config.getJointState() == [0]


def test_a_saved_page_has_the_marks(panda: kg.Config, browser: Browser, tmp_path: Path) -> None:
    panda.viewer().saveHtml(tmp_path / "open.html")
    panda.view()
    panda.viewer().saveHtml(tmp_path / "shown.html")
    for name in ("open", "shown"):
        browser.open((tmp_path / f"{name}.html").as_uri())
        browser.wait_for(f"{MARKS} === 1")


def reaching(config: kg.Config, feature: kg.FS, kind: kg.OT) -> kg.KOMO:
    """A Panda whose gripper has a target inside the table."""
    config.addFile(kg.raiPath("scenarios/pandaSingle.g"))
    komo = kg.KOMO(config, 1, 2, 1, True)
    komo.addControlObjective([], 1, 1e-1)
    x, y, _ = config.getFrame("l_gripper").getPosition()
    komo.addObjective([1], kg.FS.position, ["l_gripper"], kg.OT.sos, [1e2], [x, y, 0.6])
    kg.NLP_Solver(komo.nlp(), verbose=0).solve()
    komo.addObjective([], feature, [], kind)
    return komo


def test_where_shapes_touch_that_must_not_is_shown_instead_of_a_red_table(config: kg.Config, browser: Browser) -> None:
    komo = reaching(config, kg.FS.accumulatedCollisions, kg.OT.eq)
    komo.get_viewer().setCamera([1.3, 1.5, 1.2], [0, -0.2, 0.65])
    komo.view_slice(1)
    browser.open(komo.get_viewer().url)
    browser.wait_for("kinegraph.violatedPairs().touching > 0")
    assert browser.evaluate("kinegraph.marks()") == 0
    names = browser.evaluate("[...document.querySelectorAll('.distance')].map((x) => x.textContent)")
    assert any("table" in name and name.endswith(" mm") and "-" in name for name in names), names
    picture = browser.picture().astype(int)
    red = (picture[..., 0] > 190) & (picture[..., 1] < 90) & (picture[..., 2] < 90)
    assert 60 < red.sum() < 8000  # rings and lines, not the table
    browser.press("ArrowLeft")
    browser.wait_for("kinegraph.slice() === 0 && kinegraph.violatedPairs().all === 0")
    komo.view_close()
