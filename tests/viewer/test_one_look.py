"""Pictures that the program draws look like the page: the same view, lights, shadows, floor and visible shapes."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import kinegraph as kg
from kinegraph.png import writePng

from .browser import Browser
from .camera import HEIGHT, WIDTH
from .five_scenes import SCENES
from .similarity import ssim

LEAST = 0.9  # similarity
MOST = 4.0  # of 255, difference of the mean colors
HIDE = """document.head.append(Object.assign(document.createElement("style"),
  { textContent: "body > :not(#canvas) { visibility: hidden !important }" }))"""


def both(C: kg.Config, browser: Browser) -> tuple[np.ndarray, np.ndarray]:
    """Returns the page's picture and the program's."""
    browser.open(C.viewer().url)
    browser.evaluate(HIDE)
    return browser.picture(), C.viewer().getRgb()


def compare(page: np.ndarray, own: np.ndarray, name: str, folder: Path) -> None:
    writePng(folder / f"{name}_page.png", page)
    writePng(folder / f"{name}_own.png", own)
    apart = np.abs(page.mean(axis=(0, 1)) - own.mean(axis=(0, 1))).max()
    assert ssim(page, own) > LEAST, f"similarity {ssim(page, own):.3f}; see {folder / name}_own.png"
    assert apart < MOST, f"mean colors differ by {apart:.1f}; see {folder / name}_own.png"


@pytest.mark.parametrize("name", SCENES)
def test_pictures_look_like_the_page(name: str, browser: Browser, tmp_path: Path) -> None:
    C, place, target = SCENES[name]()
    C.view()
    C.viewer().setWindow("", WIDTH, HEIGHT)
    C.viewer().setCamera(place, target)
    page, own = both(C, browser)
    C.view_close()
    compare(page, own, name, tmp_path)


def test_the_first_view_of_the_page_is_that_of_pictures(config: kg.Config, browser: Browser, tmp_path: Path) -> None:
    config.addFile(kg.raiPath("scenarios/pandaSingle.g"))
    config.view()
    config.viewer().setWindow("", WIDTH, HEIGHT)
    compare(*both(config, browser), "first", tmp_path)


def test_similarity_sees_what_people_see() -> None:
    C, place, target = SCENES["panda"]()
    C.view(offscreen=True)
    C.viewer().setWindow("", 320, 240)
    C.viewer().setCamera(place, target)
    picture = C.viewer().getRgb()
    assert ssim(picture, picture) == pytest.approx(1.0)
    C.viewer().setCamera(np.array(place) + np.array([0.1, 0, 0]), target)
    assert ssim(picture, C.viewer().getRgb()) < LEAST
