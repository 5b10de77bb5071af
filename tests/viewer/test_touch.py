"""The page with fingers."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import pytest

import kinegraph as kg

from .browser import Browser

Point = tuple[float, float]


@pytest.fixture
def page(config: kg.Config, browser: Browser) -> Iterator[Browser]:
    browser.call("Emulation.setTouchEmulationEnabled", enabled=True, maxTouchPoints=2)
    config.addFrame("box").setShape(kg.ST.box, [0.4, 0.4, 0.4]).setPosition([0, 0, 0.5])
    config.view()
    config.viewer().setCamera([0, -3, 0.5], [0, 0, 0.5])
    browser.open(config.viewer().url)
    yield browser
    browser.call("Emulation.setTouchEmulationEnabled", enabled=False)


def move(page: Browser, *fingers: tuple[Point, Point], steps: int = 8) -> None:
    """Fingers go from one point to another, together."""
    paths = [np.linspace(start, end, steps + 1) for start, end in fingers]
    for i in range(steps + 1):
        points = [{"x": path[i][0], "y": path[i][1], "id": k} for k, path in enumerate(paths)]
        page.call("Input.dispatchTouchEvent", type="touchMove" if i else "touchStart", touchPoints=points)
    page.call("Input.dispatchTouchEvent", type="touchEnd", touchPoints=[])


def camera(page: Browser) -> np.ndarray:
    return np.array(page.evaluate("kinegraph.camera()"))


def test_one_finger_rotates(page: Browser) -> None:
    move(page, ((100, 100), (220, 100)))
    x, y, z = camera(page)
    assert abs(x) > 0.5
    assert np.hypot(x, y) == pytest.approx(3, rel=1e-3)
    assert z == pytest.approx(0.5, abs=1e-3)


def test_two_fingers_pinch(page: Browser) -> None:
    move(page, ((300, 200), (200, 200)), ((340, 200), (440, 200)))  # apart: nearer
    assert np.linalg.norm(camera(page) - [0, 0, 0.5]) < 2
    move(page, ((200, 200), (300, 200)), ((440, 200), (340, 200)))
    assert np.linalg.norm(camera(page) - [0, 0, 0.5]) > 2


def test_two_fingers_shift(page: Browser) -> None:
    move(page, ((200, 100), (300, 100)), ((260, 100), (360, 100)))
    x, y, _ = camera(page)
    assert x < -0.2
    assert y == pytest.approx(-3, abs=0.2)


def test_a_tap_selects_and_the_handle_follows_a_finger(page: Browser, config: kg.Config) -> None:
    x, y = page.pixel([0, -0.2, 0.5])
    move(page, ((x, y), (x, y)), steps=1)
    page.wait_for("kinegraph.selected() === 'box'")
    config.viewer().select(config.getFrame("box").ID)
    page.wait_for("kinegraph.idle()")
    x, y = page.pixel([0, 0, 0.5])
    up = page.pixel([0, 0, 0.8])
    handle = (x + 0.6 * (up[0] - x), y + 0.6 * (up[1] - y))  # the arrow along z
    before = camera(page)
    move(page, (handle, (handle[0], handle[1] - 60)))
    page.wait_for("kinegraph.position('box')[2] > 0.55")
    assert page.evaluate("kinegraph.position('box')[0]") == pytest.approx(0, abs=1e-5)
    assert camera(page) == pytest.approx(before)
