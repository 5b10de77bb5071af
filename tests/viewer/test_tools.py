"""Tools of the page: toolbar, outline, axes, orthographic pictures, sections, links, lanes."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import kinegraph as kg

from .browser import Browser


def show_boxes(config: kg.Config, browser: Browser) -> None:
    config.addFrame("left").setShape(kg.ST.box, [0.4, 0.4, 0.4]).setPosition([0, -0.5, 0.2]).setColor([0.8, 0.8, 0.8])
    config.addFrame("right").setShape(kg.ST.sphere, [0.2]).setPosition([0, 0.5, 0.2]).setColor([0.8, 0.8, 0.8])
    config.view()
    browser.open(config.viewer().url)


def is_blue(picture: np.ndarray) -> np.ndarray:
    r, g, b = (picture[..., k].astype(int) for k in range(3))
    return (b > r + 60) & (b > g + 40)


def test_the_selected_frame_has_an_outline_and_keeps_its_color(config: kg.Config, browser: Browser) -> None:
    show_boxes(config, browser)
    before = browser.picture()
    x, y = (round(v) for v in browser.pixel([0, 0.5, 0.2]))
    browser.click(x, y)
    browser.wait_for("kinegraph.selected() === 'right'")
    browser.evaluate("document.querySelector('#card').hidden = true")
    after = browser.picture()
    radius = abs(browser.pixel([0, 0.5, 0.4])[1] - y)
    rows, columns = np.mgrid[: after.shape[0], : after.shape[1]]
    distance = np.hypot(rows - y, columns - x)
    ring = is_blue(after) & ~is_blue(before)
    around = (distance > 0.85 * radius) & (distance < 1.25 * radius + 4)
    assert ring[around].sum() > 4 * radius  # pixels: more than half of its circumference, one pixel wide
    inside = (distance > 0.45 * radius) & (distance < 0.7 * radius)
    changed = np.abs(after.astype(int) - before).max(axis=2)[inside]
    assert np.median(changed) < 3
    browser.press("Escape")
    browser.wait_for("kinegraph.selected() === null")
    assert is_blue(browser.picture())[around].sum() <= is_blue(before)[around].sum() + 3


def test_a_hidden_frame_has_an_outline_too(config: kg.Config, browser: Browser) -> None:
    config.addFrame("wall").setShape(kg.ST.box, [0.1, 2, 2]).setPosition([0.5, 0, 1])
    config.addFrame("behind").setShape(kg.ST.box, [0.5, 0.5, 0.5]).setPosition([-0.5, 0, 1])
    config.view()
    config.viewer().setCamera([5, 0, 1], [0, 0, 1])
    browser.open(config.viewer().url)
    assert is_blue(browser.picture()).sum() == 0
    config.viewer().select(config.getFrame("behind").ID)
    browser.wait_for("kinegraph.selected() === 'behind'")
    browser.evaluate("document.querySelector('#card').hidden = true")
    assert is_blue(browser.picture()).sum() > 100


def test_parallel_lines_stay_parallel_in_an_orthographic_picture(config: kg.Config, browser: Browser) -> None:
    show_boxes(config, browser)

    def heights() -> tuple[float, float]:
        return tuple(abs(browser.pixel([x, 0, 1])[1] - browser.pixel([x, 0, 0])[1]) for x in (-2, 2))

    config.viewer().setCamera([6, 0, 0.5], [0, 0, 0.5])
    browser.wait_for("kinegraph.camera()[0] === 6 && kinegraph.idle()")
    middle = abs(browser.pixel([0, 0, 1])[1] - browser.pixel([0, 0, 0])[1])
    near, far = heights()
    assert far > 1.5 * near
    browser.click_button("flat")
    browser.wait_for("kinegraph.viewpoint().ortho > 0 && kinegraph.idle()")
    near, far = heights()
    assert far == pytest.approx(near, abs=0.01) and far == pytest.approx(middle, abs=0.5)
    browser.press_alt("Q")
    browser.wait_for("kinegraph.viewpoint().ortho === 0 && kinegraph.idle()")
    assert browser.evaluate("kinegraph.camera()") == pytest.approx([6, 0, 0.5], abs=1e-6)


def test_a_section_shows_what_is_inside(config: kg.Config, browser: Browser) -> None:
    config.addFrame("shell").setShape(kg.ST.box, [1, 1, 1]).setPosition([0, 0, 0.5]).setColor([0.8, 0.8, 0.8])
    config.addFrame("core").setShape(kg.ST.sphere, [0.2]).setPosition([0, 0, 0.5]).setColor([0.9, 0, 0])
    config.view()
    config.viewer().setCamera([4, 0, 0.5], [0, 0, 0.5])
    browser.open(config.viewer().url)

    def red() -> int:
        picture = browser.picture()[:, :300].astype(int)
        return int(((picture[..., 0] > 100) & (picture[..., 1] < 70)).sum())

    browser.press_alt("O")
    assert red() < 50  # at most the line of the x axis
    cut = "[...document.querySelectorAll('#section button')].find((x) => x.textContent === 'x')"
    browser.evaluate(f"{cut}.click()")
    assert red() > 300
    x, y = browser.pixel([0, 0, 0.5])
    browser.click(x, y)
    browser.wait_for("kinegraph.selected() === 'core'")  # the cut part is not picked
    browser.evaluate(f"{cut}.click()")
    browser.press("Escape")
    assert red() < 50


@pytest.mark.parametrize(("name", "axis", "sign"), [("+x", 0, 1), ("−y", 1, -1), ("+z", 2, 1)])
def test_axes_in_the_corner_turn_the_view(config: kg.Config, browser: Browser, name: str, axis: int, sign: int) -> None:
    show_boxes(config, browser)
    browser.evaluate(f"document.querySelector('#gizmo [title=\"look from {name}\"]').click()")
    browser.wait_for("kinegraph.idle()")
    away = np.array(browser.evaluate("kinegraph.camera()")) - browser.evaluate("kinegraph.target()")
    assert sign * away[axis] / np.linalg.norm(away) > 0.999


def test_a_link_leads_to_a_view_and_a_moment(config: kg.Config, browser: Browser, tmp_path: Path) -> None:
    config.addFrame("base")
    config.addFrame("one", "base").setJoint(kg.JT.transX, [-3, 3]).setShape(kg.ST.box, [0.2, 0.2, 0.2])
    config.view_path(np.linspace([0], [2], 21), 2.0)
    config.viewer().saveHtml(tmp_path / "motion.html")
    config.view_close()
    browser.open((tmp_path / "motion.html").as_uri() + "#camera=3,4,5,0,0,1&time=0.5")
    browser.wait_for("kinegraph.slice() === 5 && !kinegraph.playing()")
    assert browser.evaluate("kinegraph.camera()") == pytest.approx([3, 4, 5])
    assert browser.evaluate("kinegraph.target()") == pytest.approx([0, 0, 1], abs=1e-6)
    assert browser.evaluate("kinegraph.position('one')[0]") == pytest.approx(0.5, abs=1e-6)
    browser.press("ArrowRight")
    browser.wait_for("kinegraph.slice() === 6")
    assert browser.evaluate("kinegraph.link()").endswith("motion.html#camera=3,4,5,0,0,1&time=0.6")


def test_lanes_show_each_objective_and_seek(config: kg.Config, browser: Browser) -> None:
    config.addFrame("base")
    config.addFrame("one", "base").setJoint(kg.JT.transX, [-3, 3]).setShape(kg.ST.box, [0.2, 0.2, 0.2])
    komo = kg.KOMO(config, 1, 20, 1, False)
    komo.addControlObjective([], 1, 1.0)
    komo.addObjective([0.5, 1], kg.FS.position, ["one"], kg.OT.eq, [1], [5, 0, 0])  # beyond the joint's limit
    kg.NLP_Solver(komo.nlp(), verbose=0).solve()
    komo.view(False)
    browser.open(komo.get_viewer().url)
    try:
        browser.wait_for("kinegraph.slice() !== null")
        browser.evaluate(
            "[...document.querySelectorAll('#motion label')].find((x) => x.textContent === 'objectives').click()"
        )
        lanes = browser.evaluate("[...document.querySelectorAll('.lanes span')].map((x) => x.textContent)")
        assert len(lanes) == 2 and any("one" in lane for lane in lanes)
        boxes = browser.evaluate(
            "[...document.querySelectorAll('.lane')].map((x) => x.getBoundingClientRect()).map((r) => [r.left, r.top, r.width, r.height])"
        )
        left, top, width, height = boxes[[("one" in lane) for lane in lanes].index(True)]
        browser.click(left + 0.25 * width, top + height / 2)
        browser.wait_for("kinegraph.slice() > 3 && kinegraph.slice() < 7")
        browser.mouse("mouseMoved", left + 0.9 * width, top + height / 2)
        browser.wait_for("/one.*eq.*slice 1[6-9]/.test(document.querySelector('.readout').textContent)")
        violated = browser.evaluate("[...document.querySelectorAll('.lanes .violated')].map((x) => x.textContent)")
        assert violated == [lane for lane in lanes if "one" in lane]
    finally:
        komo.view_close()


def test_a_click_in_the_curves_seeks(config: kg.Config, browser: Browser) -> None:
    config.addFrame("base")
    config.addFrame("one", "base").setJoint(kg.JT.transX, [-3, 3]).setShape(kg.ST.box, [0.2, 0.2, 0.2])
    config.view_path(np.linspace([0], [2], 21), 0.2)
    browser.open(config.viewer().url)
    browser.wait_for("kinegraph.slice() === 20")
    browser.evaluate("[...document.querySelectorAll('#motion label')].find((x) => x.textContent === 'curves').click()")
    left, top, width, height = browser.evaluate(
        "(() => { const r = document.querySelector('.curves').getBoundingClientRect(); return [r.left, r.top, r.width, r.height]; })()"
    )
    browser.click(left + 0.5 * width, top + height / 2)
    browser.wait_for("Math.abs(kinegraph.slice() - 10) < 0.6")


def test_the_panel_leaves_room_for_the_scene(config: kg.Config, browser: Browser) -> None:
    show_boxes(config, browser)  # 640 pixels wide
    config.viewer().slider("speed", 0, 1)
    config.view()
    browser.wait_for("!document.querySelector('#panel').hidden && kinegraph.idle()")
    edge = browser.evaluate("document.querySelector('#panel').getBoundingClientRect().left")
    for point in ([0, -0.7, 0.2], [0, 0.7, 0.2], [0, 0.5, 0.2]):
        assert 0 < browser.pixel(point)[0] < edge
