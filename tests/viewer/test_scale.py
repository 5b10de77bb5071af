"""Scenes of any size fill the page: camera, range of sight, fog, grid and shadows follow."""

from __future__ import annotations

import numpy as np
import pytest

import kinegraph as kg

from .browser import Browser

SCALE = "document.querySelector('#scale').textContent"


def show(config: kg.Config, browser: Browser, size: float) -> np.ndarray:
    """The picture of red blocks on a plate `size` m wide, with the default camera."""
    config.addFrame("plate").setShape(kg.ST.box, [size, size, 0.02 * size]).setColor([0.2, 0.6, 0.2])
    for i in range(3):
        block = config.addFrame(f"block{i}").setShape(kg.ST.box, [0.2 * size, 0.2 * size, 0.4 * size])
        block.setPosition([0.3 * size * (i - 1), 0, 0.2 * size]).setColor([0.9, 0.1, 0.1])
    config.view()
    browser.open(config.viewer().url)
    return np.asarray(browser.picture())


def red(picture: np.ndarray) -> float:
    """The share of the picture that is red."""
    r, g, b = (picture[:, :, k].astype(int) for k in range(3))
    return float(((r > 2 * g) & (r > 2 * b)).mean())


@pytest.mark.filterwarnings("ignore:setShape. frame .* m thick")
@pytest.mark.parametrize(
    ("size", "grid"),
    [
        (0.01, "grid: 1 cm, 2 mm"),
        (20.0, "grid: 10 m, 2 m"),
        (40.0, "grid: 10 m, 2 m"),
        (200.0, "grid: 100 m, 20 m"),
        (2e3, "grid: 1 km, 200 m"),
    ],
)
def test_a_scene_of_any_size_is_seen_as_large(config: kg.Config, browser: Browser, size: float, grid: str) -> None:
    assert red(show(config, browser, size)) > 0.02
    assert browser.evaluate(SCALE) == grid


def test_a_camera_that_the_program_has_placed_stays(config: kg.Config, browser: Browser) -> None:
    show(config, browser, 40.0)
    config.viewer().setCamera([0, -90, 30], [0, 0, 0])
    browser.wait_for("Math.abs(kinegraph.camera()[1] + 90) < 1e-6")
    config.addFrame("another").setShape(kg.ST.box, [1, 1, 1])
    config.view()
    browser.wait_for("kinegraph.position('another')")
    assert browser.evaluate("kinegraph.camera()") == pytest.approx([0, -90, 30])


def test_the_floor_is_not_painted_over_what_one_sees_through(config: kg.Config, browser: Browser) -> None:
    """A pane stands on the floor, in front of a part of the red line along x that is near: through it the line is
    paler."""
    pane = config.addFrame("pane").setShape(kg.ST.box, [1, 0.01, 1]).setPosition([0, -0.3, 0.5])
    pane.setColor([0.1, 0.1, 0.9, 0.9])
    config.view()
    config.viewer().setCamera([0, -2, 0.6], [0, 0, 0.2])
    browser.open(config.viewer().url)
    picture = np.asarray(browser.picture()).astype(int)
    x, y = (round(value) for value in browser.pixel([0, 0, 0]))
    through = picture[y - 2 : y + 3, x - 2 : x + 3].reshape(-1, 3)
    assert (through[:, 2] > through[:, 0] + 60).all()  # as blue as the pane everywhere


def test_no_shadow_on_the_floor_is_painted_over_what_one_sees_through(config: kg.Config, browser: Browser) -> None:
    """A plate above the floor has its shadow behind one half of a pane: both halves are as blue."""
    config.addFrame("plate").setShape(kg.ST.box, [0.6, 0.6, 0.02]).setPosition([-0.4, 0.6, 0.6])
    pane = config.addFrame("pane").setShape(kg.ST.box, [2, 0.01, 0.6]).setPosition([0, -0.3, 0.3])
    pane.setColor([0.1, 0.1, 0.9, 0.9])
    config.view()
    config.viewer().setCamera([0, -2, 1.4], [0, 0.3, 0])
    browser.open(config.viewer().url)

    def color(x: float, y: float) -> np.ndarray:
        column, row = (round(value) for value in browser.pixel([x, y, 0]))
        return picture[row - 2 : row + 3, column - 2 : column + 3].reshape(-1, 3).mean(axis=0)

    # the sun is at (-2.5, 2.2, 4.5), which shifts the shadow of a point at a height of 0.6 m
    shadow = -0.4 + 0.6 * 2.5 / 4.5, 0.6 - 0.6 * 2.2 / 4.5
    picture = np.asarray(browser.picture()).astype(int)
    through = color(*shadow), color(0.6, shadow[1])
    browser.press_alt("C")  # without the pane
    browser.wait_for("kinegraph.idle()")
    picture = np.asarray(browser.picture()).astype(int)
    free = color(*shadow), color(0.6, shadow[1])
    assert np.abs(free[0] - free[1]).max() > 30  # there is one
    assert np.abs(through[0] - through[1]).max() < 0.2 * np.abs(free[0] - free[1]).max() + 5
    assert through[0][2] > through[0][0] + 60
