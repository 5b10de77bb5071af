"""The page looks like the reference pictures."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

import kinegraph as kg

from .browser import Browser
from .reference_pictures import check, difference


@pytest.fixture
def dark(browser: Browser) -> Iterator[None]:
    scheme = {"name": "prefers-color-scheme", "value": "dark"}
    browser.call("Emulation.setEmulatedMedia", features=[scheme])
    yield
    browser.call("Emulation.setEmulatedMedia", features=[{**scheme, "value": "light"}])


@pytest.fixture
def panda(config: kg.Config) -> kg.Config:
    config.addFile(kg.raiPath("scenarios/pandaSingle.g"))
    return config


def show(config: kg.Config, browser: Browser, position: list[float], target: list[float]) -> None:
    config.view()
    config.viewer().setCamera(position, target)
    browser.open(config.viewer().url)


def test_the_panda_in_the_light(panda: kg.Config, browser: Browser, tmp_path: Path) -> None:
    show(panda, browser, [1.3, 1.5, 1.5], [0, 0, 0.95])
    check(browser.picture(), "panda", tmp_path)


def test_the_panda_in_the_dark(panda: kg.Config, browser: Browser, dark: None, tmp_path: Path) -> None:
    show(panda, browser, [1.3, 1.5, 1.5], [0, 0, 0.95])
    check(browser.picture(), "panda_dark", tmp_path)


def all_shapes(config: kg.Config) -> None:
    shapes = [
        (kg.ST.box, [0.3, 0.2, 0.4]),
        (kg.ST.sphere, [0.2]),
        (kg.ST.capsule, [0.2, 0.12]),
        (kg.ST.cylinder, [0.4, 0.15]),
        (kg.ST.ssBox, [0.3, 0.3, 0.3, 0.06]),
        (kg.ST.ssCylinder, [0.3, 0.18, 0.05]),
        (kg.ST.quad, [0.3, 0.3]),
        (kg.ST.marker, [0.3]),
    ]
    for i, (shape, size) in enumerate(shapes):
        frame = config.addFrame(f"f{i}").setShape(shape, size).setPosition([0.6 * (i % 4) - 0.9, 0.7 * (i // 4), 0.3])
        frame.setColor([0.2 + 0.1 * i, 0.6, 0.9 - 0.1 * i])
    config.addFrame("glass").setShape(kg.ST.sphere, [0.3]).setColor([0.9, 0.3, 0.1, 0.4]).setPosition([0, -0.3, 0.3])


def test_every_shape(config: kg.Config, browser: Browser, tmp_path: Path) -> None:
    all_shapes(config)
    show(config, browser, [0.6, -2.4, 1.7], [0, 0.2, 0.25])
    check(browser.picture(), "shapes", tmp_path)
    browser.press_alt("W")
    assert difference(browser.picture(), "shapes", tmp_path)
    browser.press_alt("W")
    check(browser.picture(), "shapes", tmp_path)


def test_shadows_and_floor_are_seen_to_be_missing(
    config: kg.Config, browser: Browser, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    all_shapes(config)
    monkeypatch.setattr("kinegraph.compatibility.parameters._values", {"Render/renderShadow": False})
    show(config, browser, [0.6, -2.4, 1.7], [0, 0.2, 0.25])
    assert difference(browser.picture(), "shapes", tmp_path)
    kg.params_add(
        {"Render/renderShadow": True, "Render/floorColor": [0.4, 0.45, 0.5], "Render/backgroundColor": [1, 1, 1]}
    )
    config.view()
    browser.wait_for("kinegraph.idle()")
    red, green, blue = browser.picture()[5, 5].astype(int)  # the floor ends at the horizon, above the picture
    assert abs(red - 119) < 12 and abs(green - 129) < 12 and abs(blue - 141) < 12
    assert difference(browser.picture(), "shapes", tmp_path)
    config.viewer().setCamera([0.6, -2.4, 1.7], [0, 0.2, 1.9])
    browser.wait_for("kinegraph.idle()")
    assert browser.picture()[5, 5].min() > 248  # the tone curve bends below white


def test_things_far_from_the_origin_cast_shadows(config: kg.Config, browser: Browser) -> None:
    config.addFrame("box").setShape(kg.ST.box, [0.4, 0.4, 0.4]).setPosition([50, 0, 0.6])
    show(config, browser, [50, -3, 3], [50, 0, 0])
    browser.wait_for("kinegraph.idle()")
    picture = browser.picture().astype(int).sum(axis=2)

    def brightness(x: float, y: float) -> float:
        column, row = (round(value) for value in browser.pixel([x, y, 0]))
        return float(picture[row - 5 : row + 6, column - 5 : column + 6].mean())

    # the sun is at (-2.5, 2.2, 4.5), which shifts the shadow of a point at a height of 0.6 m
    shadow = brightness(50 + 0.6 * 2.5 / 4.5, -0.6 * 2.2 / 4.5)
    assert shadow < brightness(50 - 0.6, 0.6) - 60


def test_all_slices_of_a_motion(config: kg.Config, browser: Browser, tmp_path: Path) -> None:
    config.addFrame("base").setShape(kg.ST.cylinder, [0.2, 0.2]).setPosition([0, 0, 0.1])
    arm = config.addFrame("arm", "base").setJoint(kg.JT.hingeY, [-2, 2]).setShape(kg.ST.capsule, [0.8, 0.06])
    arm.setColor([0.9, 0.5, 0.1])
    config.view_path([[0.3 * i - 1.2] for i in range(9)], 0.05)
    config.viewer().setCamera([0, -2.6, 1], [0, 0, 0.3])
    browser.open(config.viewer().url)
    browser.evaluate(
        "[...document.querySelectorAll('#motion label')].find((x) => x.textContent === 'all slices').click()"
    )
    browser.evaluate("document.querySelector('#motion').style.visibility = 'hidden'")  # fonts differ
    browser.wait_for("!kinegraph.playing() && kinegraph.slice() === 8")
    check(browser.picture(), "slices", tmp_path)


TRIANGLE = "v -0.5 0 0\nv 0.5 0 0\nv 0 0 1\nf 1 2 3\n"


def test_a_mesh_without_material_has_the_color_of_its_frame_on_the_page_and_in_pictures(
    config: kg.Config, browser: Browser, tmp_path: Path
) -> None:
    file = tmp_path / "triangle.obj"
    file.write_text(TRIANGLE)
    config.addFrame("sign").setMeshFile(str(file)).setColor([0.9, 0.1, 0.1])
    show(config, browser, [0, -3, 0.4], [0, 0, 0.4])
    x, y = browser.pixel([0, 0, 0.3])
    for picture, place in ((browser.picture(), (int(y), int(x))), (config.viewer().getRgb(), None)):
        red, green, blue = (int(c) for c in picture[place or (len(picture) // 2, picture.shape[1] // 2)])
        assert red > 2.5 * green and red > 2.5 * blue, (red, green, blue)
