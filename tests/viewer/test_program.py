"""Controls, drawings, plots and notifications that a program puts on the page."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

import kinegraph as kg

from .browser import Browser
from .waiting import wait_until

CONTROL = "document.querySelector('#tab-program [aria-label=\"{}\"]')"


@pytest.fixture
def viewer(config: kg.Config) -> kg.ConfigurationViewer:
    config.addFrame("box").setShape(kg.ST.box, [0.4, 0.4, 0.4]).setPosition([0, 0, 0.2]).setColor([1, 0, 0])
    return config.viewer()


def open_page(config: kg.Config, page: Browser) -> None:
    config.view()
    config.viewer().setCamera([0, -3, 0.5], [0, 0, 0.5])
    page.open(config.viewer().url)


def test_a_button_is_clicked_once_by_mouse_and_by_key(
    config: kg.Config, viewer: kg.ConfigurationViewer, browser: Browser
) -> None:
    button = viewer.button("plan", key="p")
    calls: list[str] = []
    button.onClick(lambda: calls.append("plan"))
    open_page(config, browser)
    assert not button.clicked()
    browser.click_button("planp")
    wait_until(button.clicked)
    assert not button.clicked() and calls == ["plan"]
    browser.evaluate("document.activeElement.blur()")
    browser.press("p", text="p")
    wait_until(lambda: config.view() == 0 and len(calls) == 2)
    assert button.clicked()


def test_values_go_both_ways_and_lie_in_their_folders(
    config: kg.Config, viewer: kg.ConfigurationViewer, browser: Browser
) -> None:
    with viewer.folder("grasp"):
        width = viewer.slider("width", 0, 0.08, 0.04, unit="m")
        with viewer.folder("arm"):
            hand = viewer.choice("hand", ["left", "right"])
    slow = viewer.check("slow")
    note = viewer.text("note", "ä")
    seen: list[float] = []
    width.onChange(seen.append)
    open_page(config, browser)
    assert browser.evaluate("[...document.querySelectorAll('.controls summary')].map((x) => x.textContent)") == [
        "grasp",
        "arm",
    ]
    slider = CONTROL.format("width")
    assert browser.evaluate(f"[{slider}.min, {slider}.max, {slider}.value].map(Number)") == [0, 0.08, 0.04]
    for field, value, event in ((slider, "0.06", "input"), (CONTROL.format("hand"), "'right'", "change")):
        browser.evaluate(f"{field}.value = {value}; {field}.dispatchEvent(new Event('{event}'))")
    browser.evaluate("document.querySelector('.control.check input').click()")
    field = CONTROL.format("note")  # in one step, as between two the page may show what the program sent before
    browser.evaluate(f"{field}.value = 'größer'; {field}.dispatchEvent(new Event('change'))")
    wait_until(lambda: (note.value, width.value, hand.value, slow.value) == ("größer", 0.06, "right", True))
    assert width.changed() and not width.changed() and slow.changed()
    assert seen == [0.06]
    width.value = 0.02
    browser.wait_for(f"{slider}.valueAsNumber == 0.02")
    assert browser.evaluate(f"{slider}.ariaValueText").endswith(" m")
    assert not width.changed()  # by the program
    viewer.remove("grasp")
    browser.wait_for("document.querySelectorAll('.controls summary').length == 0")


def test_a_logged_image_is_replaced_and_removed(
    config: kg.Config, viewer: kg.ConfigurationViewer, browser: Browser
) -> None:
    pixel = "[...document.querySelector('.images canvas').getContext('2d').getImageData({}, {}, 1, 1).data]"
    image = np.zeros((2, 3, 3), np.uint8)
    image[1, 2] = [10, 20, 30]
    viewer.log("wrist", image)
    open_page(config, browser)
    browser.wait_for("document.querySelector('.images canvas')?.width === 3")
    assert browser.evaluate(pixel.format(2, 1)) == [10, 20, 30, 255]
    viewer.log({"wrist": np.full((4, 4, 3), 200, np.uint8), "cost": 1.0})
    browser.wait_for("document.querySelector('.images canvas').width === 4")
    assert browser.evaluate(pixel.format(0, 0)) == [200, 200, 200, 255]
    assert browser.evaluate("document.querySelectorAll('.images figure').length") == 1
    viewer.remove("wrist")
    browser.wait_for("document.querySelectorAll('.images figure').length === 0")


def test_parts_and_mirror_images_of_arrays_are_images(
    config: kg.Config, viewer: kg.ConfigurationViewer, browser: Browser
) -> None:
    rgb = np.zeros((2, 3, 3), np.uint8)
    rgb[0, 1] = [10, 20, 30]
    viewer.log("wrist", rgb[:, 1:, ::-1])
    open_page(config, browser)
    browser.wait_for("document.querySelector('.images canvas')?.width === 2")
    pixel = "[...document.querySelector('.images canvas').getContext('2d').getImageData(0, 0, 1, 1).data]"
    assert browser.evaluate(pixel) == [30, 20, 10, 255]


def test_what_is_neither_numbers_nor_an_image_is_not_logged(viewer: kg.ConfigurationViewer) -> None:
    image = np.zeros((4, 5, 3), np.uint8)
    for wrong in (image.astype(float), image[:, :, 0], np.zeros((4, 5, 4), np.uint8)):
        with pytest.raises(kg.ArgumentError, match=rf"log 'a': the value has {wrong.ndim} dimensions; .*uint8"):
            viewer.log("a", wrong)
        with pytest.raises(kg.ArgumentError, match="log 'a'"):
            viewer.log({"a": wrong}, time=1)
    for given in ({"time": 1.0}, {"unit": "m"}):
        with pytest.raises(kg.ArgumentError, match="an image has no time and no unit"):
            viewer.log("a", image, **given)
    viewer.log({"a": image, "cost": 1.0}, time=1)


def test_fractions_are_no_colors_of_points(viewer: kg.ConfigurationViewer) -> None:
    with pytest.raises(kg.ArgumentError, match="did you mean 255 times"):
        viewer.points("cloud", np.zeros((2, 3)), colors=np.full((2, 3), 0.5))
    viewer.points("cloud", np.zeros((2, 3)), colors=np.ones((2, 3), np.uint8))


def test_what_a_control_refuses(viewer: kg.ConfigurationViewer) -> None:
    width = viewer.slider("width", 0, 1, 0.5)
    for wrong in (
        lambda: viewer.slider("empty", 1, 1),
        lambda: viewer.slider("outside", 0, 1, 2),
        lambda: viewer.button("width"),
        lambda: viewer.choice("none", []),
        lambda: viewer.choice("hand", ["left"], "right"),
        lambda: viewer.button("plan", key="ab"),
        lambda: setattr(width, "value", 1.5),
        lambda: viewer.remove("widht"),
        lambda: viewer.notify("x", "loud"),
        lambda: viewer.log("empty", []),
    ):
        with pytest.raises(kg.ArgumentError):
            wrong()
    assert width.value == 0.5
    with pytest.raises(kg.ArgumentError, match="similar names: width"):
        viewer.remove("widht")
    viewer.log("cost", [1.0, 2.0])
    with pytest.raises(kg.ArgumentError, match="expected 2 as before"):
        viewer.log("cost", 1.0)


def test_an_exception_of_a_callback_reaches_the_program(
    config: kg.Config, viewer: kg.ConfigurationViewer, browser: Browser
) -> None:
    def fail() -> None:
        raise KeyError("callback")

    viewer.button("fail").onClick(fail)
    open_page(config, browser)
    browser.click_button("fail")
    with pytest.raises(KeyError, match="callback"):
        wait_until(lambda: config.view() != 0)
    assert config.view() == 0


def test_drawings_are_seen_follow_frames_and_are_removed(
    config: kg.Config, viewer: kg.ConfigurationViewer, browser: Browser
) -> None:
    viewer.line("path", [[-0.6, 0, 0.9], [0.6, 0, 0.9]], width=9, color=[0, 0.6, 0])
    viewer.points("cloud", [[0, -0.3, 0.7]], size=0.12, colors=[[0, 0, 255]])
    viewer.arrow("force", [0.5, -0.3, 0.2], [0, 0, 0.4], label="12 N", color=[1, 0, 1])
    viewer.label("text", [-0.6, 0, 0.5], "here")
    viewer.axes("goal", [-0.8, 0, 0.2, 1, 0, 0, 0])
    viewer.image("picture", np.full((4, 6, 3), [0, 255, 255], np.uint8), [0.9, 0, 1, 0.7071068, -0.7071068, 0, 0])
    open_page(config, browser)
    browser.wait_for("kinegraph.drawings().length == 6 && kinegraph.idle()")
    picture = browser.picture().astype(int)

    def color_at(point: list[float]) -> np.ndarray:
        x, y = browser.pixel(point)
        return picture[int(y), int(x)]

    assert color_at([0.3, 0, 0.9])[1] > color_at([0.3, 0, 0.9])[[0, 2]].max() + 60
    assert color_at([0, -0.3, 0.7])[2] > 150 > color_at([0, -0.3, 0.7])[0]
    assert color_at([0, -0.3, 0.74])[2] > 150 > color_at([0, -0.3, 0.74])[0]  # within the radius
    assert color_at([0, -0.3, 0.78])[0] > 150  # and beyond
    assert color_at([0.5, -0.3, 0.3])[[0, 2]].min() > color_at([0.5, -0.3, 0.3])[1] + 60
    assert color_at([0.9, 0, 1])[1] > 200 > color_at([0.9, 0, 1])[0]
    texts = "[...document.querySelectorAll('.name.drawn')].map((x) => x.textContent).sort()"
    assert browser.evaluate(texts) == ["12 N", "here"]
    for name in ("path", "cloud", "force", "text", "goal", "picture"):
        viewer.remove(name)
    browser.wait_for("kinegraph.drawings().length == 0 && kinegraph.idle()")
    assert browser.evaluate(texts) == []

    viewer.points("mark", [[0, -0.3, 0.6]], size=0.2, color=[0, 0, 1], frame="box")
    config.getFrame("box").setPosition([0.5, 0, 0.2])
    config.view()
    browser.wait_for("kinegraph.drawings().length == 1 && kinegraph.position('box')[0] == 0.5 && kinegraph.idle()")
    picture = browser.picture().astype(int)
    assert color_at([0.5, -0.3, 0.8])[2] > 150 > color_at([0.5, -0.3, 0.8])[0]
    with pytest.raises(kg.FrameNotFound, match="box"):
        viewer.axes("goal", [0, 0, 0], frame="bax")


def test_a_frustum_follows_its_camera_and_shows_its_image(
    config: kg.Config, viewer: kg.ConfigurationViewer, browser: Browser
) -> None:
    camera = config.addFrame("eye").setPosition([0, -0.5, 0.5]).setAttributes({"focalLength": 1.0})
    camera.setQuaternion([0.7071068, -0.7071068, 0, 0])  # looks along y
    config.view()
    image = np.zeros((2, 2, 3), np.uint8)
    image[0] = [255, 0, 0]  # the upper row
    image[1] = [0, 0, 255]
    viewer.frustum("view", "eye", image=image, size=0.3)
    open_page(config, browser)
    browser.wait_for("kinegraph.drawings().length == 1 && kinegraph.idle()")
    picture = browser.picture().astype(int)
    red, blue = (picture[int(y), int(x)] for x, y in map(browser.pixel, ([0, -0.2, 0.6], [0, -0.2, 0.4])))
    assert red[0] > 200 > red[2] and blue[2] > 200 > blue[0]


def test_logged_values_grow_a_plot(config: kg.Config, viewer: kg.ConfigurationViewer, browser: Browser) -> None:
    for i in range(50):
        viewer.log("cost", 1 / (i + 1), time=0.1 * i)
    open_page(config, browser)
    browser.wait_for("kinegraph.plots().cost == 50 && document.querySelectorAll('.logged canvas').length == 1")
    viewer.log({"q": [0.1, float("nan")], "cost": 2.0}, time=6)
    browser.wait_for("kinegraph.plots().cost == 51 && kinegraph.plots().q == 1")
    browser.wait_for("document.querySelectorAll('.logged canvas').length == 2")
    viewer.remove("cost")
    browser.wait_for("document.querySelectorAll('.logged canvas').length == 1")
    assert browser.evaluate("Object.keys(kinegraph.plots())") == ["q"]


def test_a_click_on_the_scene_calls_the_program(
    config: kg.Config, viewer: kg.ConfigurationViewer, browser: Browser
) -> None:
    hits: list[kg.Hit] = []
    viewer.onClick(hits.append)
    open_page(config, browser)
    browser.click(*browser.pixel([0.1, -0.2, 0.3]))
    wait_until(lambda: config.view() == 0 and hits)
    assert hits[0].frame == "box"
    assert np.allclose(hits[0].point, [0.1, -0.2, 0.3], atol=0.02)
    assert np.allclose(hits[0].normal, [0, -1, 0], atol=1e-6)


def test_notifications_pass(config: kg.Config, viewer: kg.ConfigurationViewer, browser: Browser) -> None:
    open_page(config, browser)
    viewer.notify("replanned", "warning")
    browser.wait_for("document.querySelector('.notice.warning')?.textContent == 'replanned'")
    browser.evaluate("document.querySelector('.notice').click()")
    assert browser.evaluate("document.querySelectorAll('.notice').length") == 0


def test_a_saved_page_shows_the_last_state(
    config: kg.Config, viewer: kg.ConfigurationViewer, browser: Browser, tmp_path: Path
) -> None:
    width = viewer.slider("width", 0, 1, 0.25)
    viewer.log("cost", [1.0, 2.0], time=0)
    viewer.line("path", [[0, 0, 0], [1, 0, 1]])
    width.value = 0.75
    config.view()
    file = tmp_path / "scene.html"
    viewer.saveHtml(file)
    config.view_close()
    browser.open(file.as_uri())
    assert browser.evaluate(f"[{CONTROL.format('width')}.valueAsNumber, {CONTROL.format('width')}.disabled]") == [
        0.75,
        True,
    ]
    assert browser.evaluate("kinegraph.drawings()") == ["path"]
    assert browser.evaluate("kinegraph.plots()") == {"cost": 1}


def test_invalid_commands_change_nothing(config: kg.Config, viewer: kg.ConfigurationViewer, browser: Browser) -> None:
    width = viewer.slider("width", 0, 1, 0.5)
    hand = viewer.choice("hand", ["left", "right"])
    note = viewer.text("note")
    open_page(config, browser)
    ids = {"slider": 1, "choice": 2, "text": 3}
    send = """(async () => {
      const socket = new WebSocket(location.href.replace("http", "ws"));
      await new Promise((resolve) => (socket.onopen = resolve));
      for (const [id, number, text] of %s) {
        const bytes = Uint8Array.from(text, (letter) => letter.charCodeAt(0));
        const view = new DataView(new ArrayBuffer(20 + bytes.length));
        view.setInt32(0, 13, true); view.setInt32(4, id, true); view.setFloat64(8, number, true);
        view.setInt32(16, bytes.length, true);
        new Uint8Array(view.buffer).set(bytes, 20);
        socket.send(view.buffer);
      }
      await new Promise((resolve) => setTimeout(resolve, 300));
      socket.close();
    })()"""
    commands = [
        [ids["slider"], 1e9, ""],
        [ids["choice"], 0, "third"],
        [99, 0, ""],
        [-1, 0, "x"],
        [ids["text"], 0, "\xff"],
    ]
    browser.evaluate(send % json.dumps(commands))
    wait_until(lambda: note.value == "�")
    assert (width.value, hand.value) == (0.5, "left")
    assert config.view() == 0
