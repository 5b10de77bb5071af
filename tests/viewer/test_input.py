"""Mouse and key events in the program, and images of the program on the page."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

import kinegraph as kg

from .browser import Browser
from .program import KinematicModel
from .waiting import wait_until

Start = Callable[..., KinematicModel]

TWO_PICTURES = "new Promise(done => requestAnimationFrame(() => requestAnimationFrame(() => done(true))))"


@pytest.fixture
def cube(config: kg.Config, browser: Browser) -> kg.Config:
    config.addFrame("cube").setShape(kg.ST.box, [1, 1, 1])
    config.addFrame("mark").setShape(kg.ST.marker, [3])
    config.view(False, "a cube")
    config.viewer().setCamera([0, -5, 0], [0, 0, 0])
    browser.open(config.viewer().url)
    return config


def test_events_of_mouse_and_keys_are_reported(cube: kg.Config, browser: Browser) -> None:
    viewer = cube.viewer()
    viewer.setupEventHandler(True)
    browser.wait_for("kinegraph.blocked()")
    before = browser.evaluate("kinegraph.camera()")
    browser.drag((300, 200), (350, 200))
    browser.press("a")
    browser.press("Escape")
    browser.press("Shift", modifiers=8)
    browser.call("Input.dispatchMouseEvent", type="mouseWheel", x=300, y=200, deltaX=0, deltaY=100)
    events: list[str] = []

    def all_there() -> bool:
        events.extend(viewer.getEvents())
        return "scroll down" in events

    wait_until(all_there)
    assert events[:2] == ["click down left", "click up left"]
    assert events[2:6] == ["key down a", "key up a", "key down esc", "key up esc"]
    assert "mod shift" in events
    assert viewer.getEvents() == []
    assert viewer.takeKey() == 0  # keys are events, and nothing else
    assert browser.evaluate("kinegraph.camera()") == before


def test_the_cursor_is_known_on_surfaces(cube: kg.Config, browser: Browser) -> None:
    viewer = cube.viewer()
    assert viewer.getEventCursor().size == 0
    assert viewer.getEventCursorObject() == 16777215
    x, y = browser.pixel([0.2, -0.5, 0.3])

    def move_to(x: float, y: float) -> None:
        browser.call("Input.dispatchMouseEvent", type="mouseMoved", x=x, y=y)

    def is_on_the_cube() -> bool:
        move_to(x, y)
        return viewer.getEventCursor().size == 6

    wait_until(is_on_the_cube)
    assert viewer.getEventCursor() == pytest.approx([0.2, -0.5, 0.3, 0, -1, 0], abs=0.01)
    assert viewer.getEventCursorObject() == cube.getFrame("cube").ID
    move_to(5, 5)
    wait_until(lambda: viewer.getEventCursorObject() == 16777215)
    assert viewer.getEventCursor()[:3] == pytest.approx([0.2, -0.5, 0.3], abs=0.01)


def test_visuals_only_hides_markers_and_texts_on_the_page(cube: kg.Config, browser: Browser) -> None:
    assert browser.is_visible("#message")
    with_marker = browser.picture()
    cube.viewer().visualsOnly()
    browser.wait_for("!document.querySelector('#message').checkVisibility()")
    assert (browser.picture() != with_marker).any(axis=2).sum() > 200
    cube.viewer().visualsOnly(False)
    browser.wait_for("document.querySelector('#message').checkVisibility()")


def test_a_picture_lies_on_the_scene_where_it_was_put(cube: kg.Config, browser: Browser) -> None:
    red = np.zeros((4, 8, 3), np.uint8)
    red[..., 0] = 255
    viewer = cube.viewer()
    assert viewer.setQuad(-1, red, 0.5, 0.25, 0.125) == 0
    browser.wait_for("kinegraph.quads() === 1")
    picture = browser.picture()  # 480 high
    assert picture[125, 245].tolist() == [255, 0, 0]
    assert picture[175, 355].tolist() == [255, 0, 0]
    assert picture[125, 365].tolist() != [255, 0, 0]
    assert viewer.setQuad(0, red[..., 2], 0.5, 0.25, 0.125) == 0
    assert viewer.setQuad(-1, red, 0, 0, 0.1) == 1
    browser.wait_for("kinegraph.quads() === 2")
    assert browser.picture()[125, 245].tolist() == [0, 0, 0]
    with pytest.raises(ValueError, match="expected \\(height, width, 3\\)"):
        viewer.setQuad(-1, np.zeros((4, 4, 4), np.uint8), 0, 0, 0.1)


def test_an_image_viewer_shows_pixels(browser: Browser) -> None:
    viewer = kg.ImageViewer()
    image = np.zeros((100, 150, 3), np.uint8)
    image[:, 75:] = [10, 200, 30]
    assert viewer.view(image, zoom=2.0) == 0
    browser.open_page(viewer.url)
    browser.wait_for("kinegraph.quads() === 1 && document.title === 'ImageViewer'")
    picture = browser.picture()
    assert picture[199, 299].tolist() == [10, 200, 30]
    assert picture[100, 100].tolist() == [0, 0, 0]
    viewer.viewFloat(np.full((10, 10), 300.0, np.float32))
    browser.wait_for("document.querySelector('.quad').width === 10")
    assert browser.picture()[5, 5].tolist() == [255, 255, 255]
    viewer.close()


def test_focus_turns_the_camera_and_fits_a_height(cube: kg.Config, browser: Browser) -> None:
    cube.viewer().focus([0, 0, 0.5], 2.0)
    f = cube.viewer().getCamera_focalLength()[0]
    browser.wait_for("Math.abs(kinegraph.pixel(0, 0, 0.5)[1] - 240) < 1")
    (_, top), (_, bottom) = browser.pixel([0, 0, 1.5]), browser.pixel([0, 0, -0.5])
    assert bottom - top == pytest.approx(480, rel=0.05)
    position = np.array(browser.evaluate("kinegraph.camera()"))
    assert np.linalg.norm(position - [0, 0, 0.5]) == pytest.approx(2 * f, rel=1e-3)


def test_the_page_looks_as_the_tracked_camera_does(cube: kg.Config, browser: Browser) -> None:
    cube.addFrame("camera_track").setPosition([3, 0, 0]).setQuaternion([0.5, -0.5, -0.5, 0.5])
    cube.view()
    browser.wait_for("Math.abs(kinegraph.camera()[0] - 3) < 1e-4")
    cube.getFrame("camera_track").setPosition([4, 0, 0])
    cube.view()
    browser.wait_for("Math.abs(kinegraph.camera()[0] - 4) < 1e-4")


def test_keys_with_modifiers_and_the_arrows_do_not_answer(browser: Browser, start: Start) -> None:
    program = start("C = kg.Config()\nC.addFrame('world')\nprint('key', C.view(True))\n")
    browser.open(program.url())
    browser.wait_for("kinegraph.message() === '[press key to continue]'")
    browser.press("X", modifiers=8)
    browser.press("ArrowLeft")
    browser.press("ArrowRight")
    browser.press("Control")
    browser.press("ArrowUp")
    assert program.line("key") == "265"


def test_a_page_that_is_closed_ends_the_waiting(browser: Browser, start: Start) -> None:
    program = start("C = kg.Config()\nC.addFrame('world')\nprint('key', C.view(True))\n")
    browser.open(program.url())
    browser.wait_for("kinegraph.message() === '[press key to continue]'")
    browser.close_page()
    assert program.line("key") == "0"


def test_keys_do_things_while_a_file_is_watched(browser: Browser, start: Start, tmp_path: Path) -> None:
    (tmp_path / "scene.g").write_text(
        "base: { shape: box, size: [.4 .4 .1] }\narm (base): { joint: hingeX, limits: [-1 1], shape: box, size: [.1 .1 .5], contact: 1 }\n"
        "wall: { shape: box, size: [.1 .1 .1], contact: 1 }\n"
    )
    program = start("C = kg.Config()\nC.watchFile('scene.g')\nprint('end')")
    browser.open(program.url())
    browser.press("h")
    browser.wait_for("kinegraph.message().includes('random joints')")
    browser.press("i")
    first = browser.wait_for("kinegraph.message().includes('joints: arm') && kinegraph.message()")
    browser.drag((320, 400), (380, 430))  # below the message
    browser.press("i")
    is_another = f"kinegraph.message() !== {json.dumps(first)} && kinegraph.message().includes('camera_init')"
    text = browser.wait_for(f"{is_another} && kinegraph.message()")
    C = kg.Config()
    C.addText(text[text.index("camera_init") :])
    np.testing.assert_allclose(C.viewer().getCamera_pose()[:3], browser.evaluate("kinegraph.camera()"), atol=1e-4)
    browser.press("c")
    browser.wait_for("kinegraph.message().includes('arm - wall')")
    browser.press("r")
    browser.wait_for("kinegraph.joints()[0] !== 0")
    browser.press("x")
    browser.wait_for("kinegraph.message().startsWith('written')")
    assert all((tmp_path / f"z.{ending}").stat().st_size > 100 for ending in ("g", "urdf", "ply", "dae"))
    browser.press("a")
    browser.wait_for("kinegraph.playing()")
    browser.press("k")
    browser.wait_for("kinegraph.slice() === null")
    x, y = browser.pixel([0.05, 0, 0])
    browser.call("Input.dispatchMouseEvent", type="mouseMoved", x=x, y=y)
    browser.evaluate(TWO_PICTURES)  # with the second, the page has sent the place of the pointer
    browser.press(" ")
    browser.wait_for("/ at /.test(kinegraph.message())")
    browser.press("q")
    program.line("end")


def test_distances_are_drawn_between_what_is_near(config: kg.Config, browser: Browser) -> None:
    for i, x in enumerate((0.0, 0.13, 0.2, 1.0)):
        config.addFrame(f"ball{i}").setShape(kg.ST.sphere, [0.05]).setPosition([x, 0, 1]).setContact(1)
    config.view()
    browser.open(config.viewer().url)
    browser.press_alt("D")
    browser.wait_for("kinegraph.nearLines() === 2")
    texts = "[...document.querySelectorAll('.distance')].map((x) => x.textContent).sort()"
    browser.wait_for(f"String({texts}) === '-30.0 mm,30.0 mm'")
    config.getFrame("ball3").setPosition([0.32, 0, 1])
    config.view()
    browser.wait_for("kinegraph.nearLines() === 3")
    browser.press_alt("D")
    browser.wait_for("kinegraph.nearLines() === 0")
    assert json.loads(browser.evaluate("JSON.stringify(kinegraph.selected())")) is None
