"""The first view of a scene, before the program or a user moves the camera; lines; and the size of what is sent."""

from __future__ import annotations

import gzip
import json
import time
import urllib.request

import numpy as np
import pytest
from websockets.sync.client import connect

import kinegraph as kg

from .browser import Browser
from .camera import HEIGHT, WIDTH


def corners(config: kg.Config) -> np.ndarray:
    """The corners of all boxes of the scene, shape (n, 3)."""
    signs = np.array(np.meshgrid([-1, 1], [-1, 1], [-1, 1])).reshape(3, -1).T
    return np.vstack(
        [f.getPosition() + signs * f.getSize()[:3] / 2 @ f.getRotationMatrix().T for f in config.getFrames()]
    )


def row(config: kg.Config) -> None:
    for i in range(7):
        config.addFrame(f"crate {i}").setShape(kg.ST.box, [0.5, 0.5, 0.5]).setPosition([0, 2 * i - 6, 0.25])


def tower(config: kg.Config) -> None:
    for i in range(5):
        config.addFrame(f"block {i}").setShape(kg.ST.box, [0.1, 0.1, 0.5]).setPosition([3, 1, 0.5 * i])


def shelf(config: kg.Config) -> None:
    """Its open side faces -x."""
    config.addFrame("back").setShape(kg.ST.box, [0.02, 1, 1.6]).setPosition([0.8, 0, 0.8])
    for i in range(4):
        config.addFrame(f"board {i}").setShape(kg.ST.box, [0.3, 1, 0.02]).setPosition([0.65, 0, 0.4 * i + 0.2])
        config.addFrame(f"thing {i}").setShape(kg.ST.box, [0.1, 0.1, 0.1]).setPosition([0.65, 0.2 * i, 0.4 * i + 0.26])


@pytest.mark.parametrize("scene", [row, tower, shelf])
def test_the_first_view_shows_the_whole_scene_and_fills_the_picture(scene, config: kg.Config, browser: Browser) -> None:
    scene(config)
    config.view()
    browser.open(config.viewer().url)
    pixels = np.array([browser.pixel(corner) for corner in corners(config)])
    assert np.all(pixels >= 0) and np.all(pixels <= [WIDTH, HEIGHT])
    assert np.max(np.ptp(pixels, axis=0) / [WIDTH, HEIGHT]) > 0.6


def test_a_shelf_is_first_seen_from_its_open_side(config: kg.Config, browser: Browser) -> None:
    shelf(config)
    config.view()
    browser.open(config.viewer().url)
    assert browser.evaluate("kinegraph.camera()")[0] < 0.5


def test_the_program_knows_the_first_view(config: kg.Config, browser: Browser) -> None:
    row(config)
    config.view()
    viewer = config.viewer()
    browser.open(viewer.url)
    expected = browser.evaluate("kinegraph.viewpoint()")
    browser.wait_for("kinegraph.idle()")
    for _ in range(100):
        config.view()
        if np.allclose(viewer.getCamera_pose(), expected["pose"], atol=1e-6):
            break
        browser.wait_for("new Promise((resolve) => setTimeout(() => resolve(true), 50))")
    assert viewer.getCamera_pose() == pytest.approx(expected["pose"], abs=1e-6)
    assert viewer.getCamera_focalLength()[0] == pytest.approx(expected["focal"], abs=1e-6)


def test_lines_have_the_colors_of_their_ends_or_of_their_frame(config: kg.Config, browser: Browser) -> None:
    ends = np.array([[0, -0.5, 0.3], [0, 0.5, 0.3], [0, -0.5, 0.6], [0, 0.5, 0.6]])
    red, green = [220, 30, 30], [30, 160, 30]
    config.addFrame("own").setLines(ends.reshape(-1, 6), np.array([red, red, green, green], np.uint8))
    config.addFrame("plain").setLines(np.array([[0, -0.5, 0.9, 0, 0.5, 0.9]])).setColor([0.1, 0.2, 0.9])
    config.view()
    config.viewer().setCamera([2, 0, 0.6], [0, 0, 0.6])
    browser.open(config.viewer().url)
    picture = browser.picture().astype(int)
    for height, channel in ((0.3, 0), (0.6, 1), (0.9, 2)):
        x, y = (round(pixel) for pixel in browser.pixel([0, 0.2, height]))
        color = picture[y - 2 : y + 3, x]
        strongest = color[np.argmax(color[:, channel] - np.delete(color, channel, axis=1).max(axis=1))]
        assert strongest[channel] > 60 + np.delete(strongest, channel).max(), (height, color)


def test_names_that_a_text_cannot_contain_are_copied_as_the_program_writes_them(
    config: kg.Config, browser: Browser
) -> None:
    names = ["lid of crate", "x(y)", 'a"q', "it's", "shape"]
    for name in names:
        config.addFrame(name).setShape(kg.ST.marker, [0.1])
    config.view()
    browser.open(config.viewer().url)
    copies = []
    for frame in config.getFrames():
        config.viewer().select(frame.ID)
        browser.wait_for(f"kinegraph.selected() === {json.dumps(frame.name)}")
        copies.append(browser.evaluate("kinegraph.asText()"))
    copied, written = kg.Config(), kg.Config()
    copied.addText("\n".join(copies))
    with pytest.warns(kg.KinegraphWarning, match="not expressible"):
        written.addText(config.write())
    assert copied.getFrameNames() == written.getFrameNames()


def test_without_webgl_the_page_says_so(config: kg.Config, browser: Browser) -> None:
    config.addFrame("box").setShape(kg.ST.box, [0.1, 0.1, 0.1])
    config.view()
    hide = "HTMLCanvasElement.prototype.getContext = () => null"
    script = browser.call("Page.addScriptToEvaluateOnNewDocument", source=hide)
    try:
        browser.navigate(config.viewer().url)
        browser.wait_for("document.querySelector('#error')?.textContent")
        assert "WebGL 2 is missing" in browser.evaluate("document.querySelector('#error').textContent")
        assert not browser.is_visible("#panel-button")
    finally:
        browser.call("Page.removeScriptToEvaluateOnNewDocument", **script)
    browser.errors[:] = [error for error in browser.errors if "WebGL 2 is not available" not in error]


def test_page_and_meshes_are_sent_compressed(config: kg.Config) -> None:
    """A browser that cannot unpack gets both as they are."""
    angle = np.linspace(0, 40, 30000)
    points = np.column_stack([np.cos(angle), np.sin(angle), angle / 40])
    config.addFrame("spring").setMesh(points, np.arange(30000, dtype=np.uint32).reshape(-1, 3))
    config.view()
    url = config.viewer().url
    bodies = []
    for encoding in ("identity", "gzip"):
        request = urllib.request.Request(url, headers={"Accept-Encoding": encoding})
        with urllib.request.urlopen(request) as answer:
            assert answer.headers.get("Content-Encoding") == ("gzip" if encoding == "gzip" else None)
            bodies.append(answer.read())
    assert gzip.decompress(bodies[1]) == bodies[0]
    assert len(bodies[1]) < 350_000
    meshes = []
    for compression in ("deflate", None):
        with connect(url.replace("http", "ws"), compression=compression, max_size=None) as socket:
            assert bool(socket.protocol.extensions) == (compression == "deflate")
            while not isinstance(message := socket.recv(20), bytes) or message[:4] != b"\x09\0\0\0":
                pass
            meshes.append(message)
    assert meshes[0] == meshes[1]


def test_a_page_without_shapes_does_not_set_the_camera(config: kg.Config, browser: Browser) -> None:
    config.addFrame("origin")
    config.view()
    pose = config.viewer().getCamera_pose()
    browser.open(config.viewer().url)
    size = {"deviceScaleFactor": 1, "mobile": False}
    browser.call("Emulation.setDeviceMetricsOverride", width=WIDTH // 2, height=HEIGHT, **size)
    browser.wait_for(f"innerWidth === {WIDTH // 2} && kinegraph.idle()")
    time.sleep(0.3)  # the program would receive the camera
    browser.call("Emulation.setDeviceMetricsOverride", width=WIDTH, height=HEIGHT, **size)
    assert np.array_equal(config.viewer().getCamera_pose(), pose)
