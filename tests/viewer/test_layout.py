"""The layout on pages of any size: nothing covers the controls."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import combinations

import pytest

import kinegraph as kg

from .browser import Browser
from .camera import HEIGHT, WIDTH

WINDOWS = {"small window": (800, 600), "phone": (390, 844), "phone on its side": (844, 390), "small phone": (320, 568)}
SIZES = {**WINDOWS, "frame on a phone": (366, 366)}
PARTS = ["#panel", "#motion", "#run", "#message", "#error", "#panel-button", "#help-button"]
RECTANGLES = f"""Object.fromEntries({PARTS}.map((name) => [name, document.querySelector(name)])
  .filter(([, part]) => part.checkVisibility())
  .map(([name, part]) => [name, ((box) => [box.left, box.top, box.right, box.bottom])(part.getBoundingClientRect())]))"""
# controls that a finger cannot hit
COVERED = """[...document.querySelectorAll(".transport *, .round, #tabs button")]
  .filter((x) => x.matches("button, input, select") && x.checkVisibility())
  .filter((x) => {
    const { left, top, width, height } = x.getBoundingClientRect();
    const hit = document.elementFromPoint(left + width / 2, top + height / 2);
    return hit !== x && hit?.closest("label")?.control !== x;
  }).map((x) => x.ariaLabel || x.textContent || x.closest("label").textContent)"""


@pytest.fixture(params=WINDOWS)
def page(request: pytest.FixtureRequest, browser: Browser) -> Iterator[Browser]:
    width, height = SIZES[request.param]
    mobile = "phone" in request.param
    browser.call("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=mobile)
    browser.call("Emulation.setTouchEmulationEnabled", enabled=mobile)
    yield browser
    browser.call("Emulation.setTouchEmulationEnabled", enabled=False)
    browser.call("Emulation.setDeviceMetricsOverride", width=WIDTH, height=HEIGHT, deviceScaleFactor=1, mobile=False)


def fill(config: kg.Config) -> None:
    for i in range(40):
        config.addFrame(f"frame{i}").setShape(kg.ST.box, [0.1, 0.1, 0.1]).setPosition([0.2 * i, 0, 1])
    config.addFrame("arm", "frame0").setJoint(kg.JT.hingeX, [-1, 1]).setShape(kg.ST.box, [0.1, 0.1, 0.5]).setMass(1.0)
    config.viewer().setError("an error\nof two lines")


def check_nothing_overlaps(page: Browser) -> None:
    for letter in "TJO":
        page.press_alt(letter)
        page.wait_for("kinegraph.idle()")
        boxes = page.evaluate(RECTANGLES)
        assert len(boxes) == 6  # all but one of the two bars
        width, height = page.evaluate("[innerWidth, innerHeight]")
        for name, (left, top, right, bottom) in boxes.items():
            assert left >= 0 and top >= 0 and right <= width and bottom <= height, name
            assert right - left > 20 and bottom - top > 20, name
        for one, other in combinations(boxes, 2):
            apart = (
                boxes[one][2] <= boxes[other][0]
                or boxes[other][2] <= boxes[one][0]
                or boxes[one][3] <= boxes[other][1]
                or boxes[other][3] <= boxes[one][1]
            )
            assert apart, (one, other, boxes)
        assert page.evaluate(COVERED) == []


def test_panels_and_messages_leave_the_time_slider_free(config: kg.Config, page: Browser) -> None:
    fill(config)
    config.view_path([[0.0], [0.5]], 0.05, message="\n".join(f"line {i}" for i in range(60)))
    page.open(config.viewer().url)
    page.wait_for("!kinegraph.playing()")
    check_nothing_overlaps(page)


def test_the_axes_in_the_corner_leave_the_time_slider_free(config: kg.Config, page: Browser) -> None:
    fill(config)
    config.view_path([[0.0], [0.5]], 0.05)
    page.open(config.viewer().url)
    for letter in "NJ":  # names of frames, then the panel
        page.press_alt(letter)
        page.wait_for("kinegraph.idle()")
        left, right, bottom, bar = page.evaluate("""((axes, bar) => [axes.left, axes.right, axes.bottom, bar.top])(
          ...["#gizmo", "#motion"].map((name) => document.querySelector(name).getBoundingClientRect()))""")
        assert 0 <= left < right <= page.evaluate("innerWidth") and bottom <= bar


def test_the_card_of_a_frame_covers_neither_axes_nor_messages(config: kg.Config, page: Browser) -> None:
    fill(config)
    config.view_path([[0.0], [0.5]], 0.05, message="a message")
    page.open(config.viewer().url)
    page.press_alt("T")
    page.evaluate("[...document.querySelectorAll('#tree .frame')].find((x) => x.textContent === 'arm').click()")
    for _ in range(2):
        page.wait_for("kinegraph.idle()")
        covered = page.evaluate("""((card, parts) => parts.map((name) => document.querySelector(name)).filter((part) => {
          const [a, b] = [card, part].map((x) => x.getBoundingClientRect());
          const apart = a.right <= b.left || b.right <= a.left || a.bottom <= b.top || b.bottom <= a.top;
          return card.checkVisibility() && part.checkVisibility() && !apart;
        }).map((part) => part.id))(document.querySelector("#card"), ["#gizmo", "#message", "#motion", "#toolbar", "#panel"])""")
        assert covered == []
        page.press_alt("T")  # without the panel


@pytest.mark.parametrize("page", ["frame on a phone"], indirect=True)
def test_a_page_within_another_on_a_phone_shows_the_scene(config: kg.Config, page: Browser) -> None:
    fill(config)
    config.view_path([[0.0], [0.5]], 0.05)
    page.open(config.viewer().url)
    left, top, right, bottom = page.evaluate(RECTANGLES)["#motion"]
    assert 0 <= left < right <= 366 and 0.8 * 366 <= top < bottom <= 366
    assert page.evaluate(COVERED) == []
    assert not page.is_visible("#gizmo")


def test_panels_and_messages_leave_the_buttons_of_a_simulation_free(config: kg.Config, page: Browser) -> None:
    fill(config)
    simulation = kg.Simulation(config)
    simulation.view(False, "\n".join(f"line {i}" for i in range(60)))
    page.open(config.viewer().url)
    page.wait_for("kinegraph.run() !== null")
    check_nothing_overlaps(page)


@pytest.mark.parametrize("page", ["phone"], indirect=True)
def test_the_help_on_a_phone_lists_gestures(config: kg.Config, page: Browser) -> None:
    config.addFrame("world")
    config.view()
    page.open(config.viewer().url)
    page.evaluate("document.querySelector('#help-button').click()")
    assert page.is_visible("#help")
    text = page.evaluate("document.querySelector('#help').innerText")
    for what in ("one finger", "two fingers", "tap", "two taps"):
        assert what in text
    assert "Alt" not in text and "wheel" not in text
    left, right = page.evaluate(
        "((box) => [box.left, box.right])(document.querySelector('#help').getBoundingClientRect())"
    )
    assert left >= 0 and right <= 390
