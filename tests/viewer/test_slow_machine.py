"""While things move on a slow machine the page draws coarsely, and in full when they stand still."""

from __future__ import annotations

from pathlib import Path

import numpy as np

import kinegraph as kg

from .browser import Browser
from .camera import HEIGHT
from .reference_pictures import check

COARSE = 2  # pixels of the page per pixel drawn, across and down
CELL = 8  # pixels of the page
HURRY = """(() => {
  kinegraph.hurry();
  const png = document.getElementById("canvas").toDataURL("image/png").split(",")[1];
  return [png, kinegraph.resolution()];
})()"""


def means(picture: np.ndarray, cell: int) -> np.ndarray:
    height, width, _ = picture.shape
    return picture.reshape(height // cell, cell, width // cell, cell, 3).mean(axis=(1, 3))


def test_a_hurried_picture_is_coarse_but_shows_the_same(config: kg.Config, browser: Browser, tmp_path: Path) -> None:
    config.addFile(kg.raiPath("scenarios/pandaSingle.g"))
    config.view()
    config.viewer().setCamera([1.3, 1.5, 1.5], [0, 0, 0.95])
    browser.open(config.viewer().url)
    full, triangles = browser.picture(), browser.evaluate("kinegraph.triangles()")
    for _ in range(2):
        browser.wait_for(f"(kinegraph.hurry(), kinegraph.triangles() < {0.75 * triangles})")  # made in several pictures
        png, resolution = browser.evaluate(HURRY)
        assert resolution == 1 / COARSE
        apart = np.abs(means(browser.decode(png, HEIGHT // COARSE), CELL // COARSE) - means(full, CELL)).max(axis=2)
        canvas = apart[:-8, :-12]  # the scale and the buttons are not on it
        assert canvas.mean() < 6
        assert (canvas > 60).mean() < 0.02
        check(browser.picture(), "panda", tmp_path)
        assert browser.evaluate("kinegraph.triangles()") == triangles


def test_a_mesh_of_few_triangles_stays_as_it_is(config: kg.Config, browser: Browser) -> None:
    corners = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], float)
    config.addFrame("rock").setMesh(corners, np.array([[0, 1, 2], [1, 3, 2], [0, 4, 1], [0, 2, 4]]))
    config.view()
    browser.open(config.viewer().url)
    before = browser.evaluate("kinegraph.triangles()")
    browser.evaluate(HURRY)
    assert browser.evaluate("kinegraph.triangles()") == before


def test_a_model_is_saved_in_full_while_things_move(config: kg.Config, browser: Browser) -> None:
    config.addFile(kg.raiPath("scenarios/pandaSingle.g"))
    config.view()
    browser.open(config.viewer().url)
    full = browser.evaluate("kinegraph.triangles()")
    browser.evaluate("(kinegraph.hurry(), document.getElementById('model').click())")
    assert browser.evaluate("kinegraph.triangles()") >= full
