"""Pictures that the program draws look like the page: the same view, lights, shadows, floor and visible shapes."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import kinegraph as kg
from kinegraph.png import writePng

from .browser import Browser
from .camera import HEIGHT, WIDTH, Camera
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


def draw_everything(C: kg.Config) -> dict[str, list[float]]:
    """Draws one of each kind on the viewer of C; returns a point in the middle of each, m."""
    v = C.viewer()
    angle = np.linspace(0, 3, 30)
    spiral = np.column_stack([-0.2 + 0.25 * np.cos(angle), 0.25 * np.sin(angle), 1.0 + 0.1 * angle])
    v.line("path", spiral, width=8, color=[0.1, 0.6, 0.1])
    colors = np.array([[255, 0, 0], [0, 0, 255]])
    v.line("colored", [[0.3, -0.6, 0.8], [0.3, -0.1, 0.8]], width=6, colors=colors)
    v.arrow("force", [0.5, 0.1, 0.7], [0, 0, 0.4], color=[0.9, 0.4, 0], size=0.05)
    v.points("big", [[0.4, 0.4, 0.8], [0.5, 0.4, 0.9]], color=[0.5, 0, 0.5], size=0.08)
    v.points("small", np.random.default_rng(0).uniform([0.2, 0.5, 0.7], [0.5, 0.8, 1.0], (300, 3)))
    v.axes("goal", [-0.5, -0.4, 0.8, 1, 0, 0, 0], size=0.3)
    rows = np.zeros((40, 60, 3), np.uint8)
    rows[:20] = [200, 40, 40]
    rows[20:] = [40, 40, 200]
    v.image("picture", rows, [-0.3, 0.6, 1.2, 0.5, -0.5, -0.5, 0.5], size=0.5)
    v.frustum("camera", [0.2, 0.2, 1.5, 0, 1, 0, 0], focal_length=1.0, image=rows, size=0.25)
    return {
        "path": spiral[15].tolist(),
        "colored": [0.3, -0.55, 0.8],
        "force": [0.5, 0.1, 0.9],
        "big": [0.4, 0.4, 0.8],
        "picture": [-0.3, 0.6, 1.25],
        "camera": [0.2, 0.25, 1.25],
    }


def test_drawings_are_on_the_page_and_in_pictures(config: kg.Config, browser: Browser, tmp_path: Path) -> None:
    config.addFile(kg.raiPath("scenarios/pandaSingle.g"))
    places = draw_everything(config)
    config.view()
    config.viewer().setWindow("", WIDTH, HEIGHT)
    eye, target = [2.2, 0.8, 1.7], [0.0, 0.1, 0.9]
    config.viewer().setCamera(eye, target)
    page, own = both(config, browser)
    compare(page, own, "drawn", tmp_path)
    camera = Camera(eye, target)
    for name in places:
        config.viewer().remove(name)
    without = config.viewer().getRgb()
    for name, place in places.items():
        row, column = camera.pixel(np.array(place))
        a, b, c = (
            image[row - 1 : row + 2, column - 1 : column + 2].mean(axis=(0, 1)) for image in (page, own, without)
        )
        assert np.abs(a - b).max() < 25, f"{name}: {a} on the page, {b} in the picture"
        assert np.abs(b - c).max() > 40, f"{name} is not there"


def test_similarity_sees_what_people_see() -> None:
    C, place, target = SCENES["panda"]()
    C.view(offscreen=True)
    C.viewer().setWindow("", 320, 240)
    C.viewer().setCamera(place, target)
    picture = C.viewer().getRgb()
    assert ssim(picture, picture) == pytest.approx(1.0)
    C.viewer().setCamera(np.array(place) + np.array([0.1, 0, 0]), target)
    assert ssim(picture, C.viewer().getRgb()) < LEAST
