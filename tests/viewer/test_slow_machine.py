"""On a slow machine the page draws coarsely during motions, and in full resolution at rest."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

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


# per animation frame with its time in ms and a change flag: whether it has full resolution
DRAW = """((frames) => {
  const quality = kinegraph.quality();
  return frames.map(([time, changes]) => changes ? (quality.change(time), false) : quality.rest(time));
})(FRAMES)"""


class Frames:
    """Animation frames of a machine that takes `full` ms for a picture in full resolution, `coarse` for others, and no
    less than `pace` ms from one to the next."""

    def __init__(self, browser: Browser, coarse: float, full: float, pace: float = 16.0) -> None:
        self._browser, self._coarse, self._full, self._pace = browser, coarse, full, pace
        self._frames: list[tuple[float, bool]] = []
        self.now = 0.0

    def draw(self, changes: bool) -> bool:
        """The next one; true if it is in full resolution."""
        self._frames.append((self.now, changes))
        fine = self._browser.evaluate(DRAW.replace("FRAMES", json.dumps(self._frames)))[-1]
        self.now += max(self._pace, self._full if fine else self._coarse if changes else 0.0)
        return fine

    def rest(self, until: float) -> list[float]:
        """Nothing changes; when there were pictures in full resolution."""
        fine = []
        while (now := self.now) < until:
            if self.draw(False):
                fine.append(now)
        return fine


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


@pytest.fixture
def page(config: kg.Config, browser: Browser) -> Browser:
    config.addFrame("world")
    config.view()
    browser.open(config.viewer().url)
    return browser


@pytest.mark.parametrize("pace", [16.0, 70.0])
@pytest.mark.parametrize("full", [40, 800])
def test_what_is_at_rest_is_soon_seen_in_full_also_if_it_changes_after_that(
    page: Browser, pace: float, full: float
) -> None:
    frames = Frames(page, coarse=10, full=full, pace=pace)
    for _ in range(8):
        frames.draw(True)
        changed = frames.now - pace
        fine = frames.rest(changed + full + 300 + 3 * pace)  # until people have seen it
        assert len(fine) == 1
        assert fine[0] - changed <= 150 + 2 * pace


def test_where_changes_would_wait_for_full_pictures_there_are_none_until_they_stop(page: Browser) -> None:
    frames = Frames(page, coarse=30, full=800)
    fine = []
    for _ in range(20):
        frames.draw(True)
        fine += frames.rest(frames.now + 400)
    assert len(fine) <= 2  # from which it is known
    assert len(frames.rest(frames.now + 1000)) == 1


def test_changes_that_wait_behind_a_slow_picture_are_drawn_first(page: Browser) -> None:
    frames = Frames(page, coarse=600, full=900)
    for _ in range(6):
        frames.draw(True)
        assert not frames.draw(False)  # before the message that came while it was drawn is read
