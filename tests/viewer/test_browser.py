"""The page in the browser, and its effects on the program."""

from __future__ import annotations

import json
import time
from collections.abc import Callable
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest

import kinegraph as kg

from .browser import Browser
from .camera import HEIGHT, WIDTH, Camera
from .program import KinematicModel

Start = Callable[..., KinematicModel]
PAPER = (223, 227, 234)
LINKS = [f"l_panda_joint{i}" for i in range(1, 8)]


def show(config: kg.Config, browser: Browser, camera: Camera) -> None:
    config.view()
    config.viewer().setCamera(camera.position, camera.target)
    browser.open(config.viewer().url)


def position(config: kg.Config, frame: str) -> np.ndarray:
    return config.getFrame(frame).getPosition()


def wait_for_position(config: kg.Config, browser: Browser, frame: str) -> None:
    """Waits until a frame has the same pose on the page as in the configuration."""
    expected = json.dumps(list(position(config, frame)))
    browser.wait_for(f"{expected}.every((x, i) => Math.abs(x - kinegraph.position({json.dumps(frame)})[i]) < 1e-4)")


def points_of_the_arm(config: kg.Config) -> list[np.ndarray]:
    """Points inside the links: between neighboring joints at different positions."""
    joints = [position(config, name) for name in LINKS]
    return [(a + b) / 2 for a, b in pairwise(joints) if np.linalg.norm(a - b) > 0.25]


@pytest.fixture
def panda(config: kg.Config) -> kg.Config:
    config.addFile(kg.raiPath("scenarios/pandaSingle.g"))
    return config


def test_shapes_appear_where_the_camera_sees_them_in_their_colors_and_sizes(
    config: kg.Config, browser: Browser
) -> None:
    camera = Camera([0, -3.8, 1], [0, 0, 1])
    colors = {"red": [1, 0, 0], "green": [0, 1, 0], "blue": [0, 0, 1]}
    for column, (name, color) in enumerate(colors.items()):
        ball = config.addFrame(name).setShape(kg.ST.sphere, [0.2]).setColor(color)
        ball.setPosition([column - 1, 0, 1 + 0.3 * column])
    show(config, browser, camera)
    picture = browser.picture().astype(int)
    assert np.abs(picture[5, WIDTH - 5] - PAPER).max() < 8
    for channel, name in enumerate(colors):
        others = np.delete(picture, channel, axis=2).max(axis=2)
        ball = picture[..., channel] > others + 60
        rows, columns = np.nonzero(ball)
        row, column = camera.pixel(position(config, name))
        assert np.allclose([rows.mean(), columns.mean()], [row, column], atol=3)
        radius = camera.focal_length * 0.2 / 3.8
        assert np.ptp(rows) / 2 == pytest.approx(radius, abs=3)
        assert ball.sum() == pytest.approx(np.pi * radius**2, rel=0.15)


def test_the_panda_is_seen_on_its_table(panda: kg.Config, browser: Browser) -> None:
    camera = Camera([-1.65, 1.9, 1.65], [0, 0, 0.95])  # the side in the light
    show(panda, browser, camera)
    picture = browser.picture().astype(int)
    assert np.abs(picture[5, WIDTH - 5] - PAPER).max() < 8
    for point in points_of_the_arm(panda):  # white
        color = picture[camera.pixel(point)]
        assert color.min() > 120
        assert np.ptp(color) < 30
    table = picture[camera.pixel([0.5, 0.4, 0.65])]  # dark gray
    assert 20 < table.min() <= table.max() < 110


def test_the_arm_moves_with_the_joint_state(panda: kg.Config, browser: Browser) -> None:
    camera = Camera([1.65, 1.9, 1.65], [0, 0, 0.95])
    show(panda, browser, camera)
    before, start = browser.picture().astype(int), points_of_the_arm(panda)
    q = panda.getJointState()
    q[0] += 2.0
    panda.setJointState(q)
    panda.view()
    wait_for_position(panda, browser, "l_gripper")
    after, end = browser.picture().astype(int), points_of_the_arm(panda)
    moved = np.abs(after - before).max(axis=2) > 40
    assert 1000 < moved.sum() < 0.3 * WIDTH * HEIGHT
    assert moved[camera.pixel(start[-1])]
    assert moved[camera.pixel(end[-1])]
    assert after[camera.pixel(end[-1])].min() > 120
    assert not moved[:20].any()
    assert not moved[-20:].any()


def test_frames_appear_change_and_disappear(config: kg.Config, browser: Browser) -> None:
    config.addFrame("first").setShape(kg.ST.box, [0.1, 0.2, 0.3])
    config.view()
    browser.open(config.viewer().url)
    config.addFrame("second").setShape(kg.ST.mesh, [0.1]).setMesh(TETRAHEDRON, TRIANGLES)
    config.view()
    browser.wait_for("kinegraph.position('second') && kinegraph.meshes() == 1")
    config.delFrame("first")
    config.view()
    browser.wait_for("kinegraph.frames() == 1 && !kinegraph.position('first') && kinegraph.position('second')")


TETRAHEDRON = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], float)
TRIANGLES = np.array([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]], np.uint32)


def test_the_page_forgets_meshes_that_no_frame_uses(config: kg.Config, browser: Browser) -> None:
    frame = config.addFrame("stone")
    held = []
    for i in range(1, 6):
        frame.setMesh(i / 10 * TETRAHEDRON, TRIANGLES)
        config.view(False, f"stone {i}")
        if i == 1:
            browser.open(config.viewer().url)
        browser.wait_for(f"kinegraph.message() == 'stone {i}' && kinegraph.meshes() == 1 && kinegraph.idle()")
        held.append(browser.evaluate("kinegraph.geometries()"))
    assert held[1] == held[-1]


def test_names_with_special_characters_arrive_unchanged(config: kg.Config, browser: Browser) -> None:
    names = ['a "quote"', "back\\slash", "new\nline", "</script><b>", "grün 🤖"]
    for name in names:
        config.addFrame(name).setShape(kg.ST.marker, [0.1])
    config.view()
    browser.open(config.viewer().url)
    browser.wait_for(f"{json.dumps(names)}.every((name) => kinegraph.position(name))")


def test_a_message_is_shown_as_text_until_it_is_replaced(config: kg.Config, browser: Browser) -> None:
    config.addFrame("world")
    config.view(False, "a <b>bold</b> claim\nin two lines")
    browser.open(config.viewer().url)
    browser.wait_for("kinegraph.message() == 'a <b>bold</b> claim\\nin two lines'")
    assert browser.is_visible("#message")
    left, top = browser.evaluate("(({ x, y }) => [x, y])(document.querySelector('#message').getBoundingClientRect())")
    assert (browser.picture()[round(top) : round(top) + 48, round(left) : round(left) + 188] < 100).any()  # ink
    config.view(False, "")
    browser.wait_for("kinegraph.message() == ''")
    assert not browser.is_visible("#message")


def test_a_page_that_is_loaded_again_shows_everything(config: kg.Config, browser: Browser) -> None:
    config.addFrame("box").setShape(kg.ST.box, [0.1, 0.2, 0.3]).setPosition([1, 2, 3])
    config.view(False, "here")
    browser.open(config.viewer().url)
    config.getFrame("box").setPosition([4, 5, 6])
    config.view()
    wait_for_position(config, browser, "box")
    browser.open(config.viewer().url)
    wait_for_position(config, browser, "box")
    assert browser.evaluate("kinegraph.message()") == "here"


def test_view_returns_the_key_that_was_pressed_on_the_page(browser: Browser, start: Start) -> None:
    program = start("""
C = kg.Config()
C.addFile(kg.raiPath('scenarios/pandaSingle.g'))
C.view()
C.viewer().waitForClient(60)
while (key := C.view(True, 'a question')) != ord('q'):
    print('key', key)
print('end', C.view())
""")
    browser.open(program.url())
    browser.wait_for("kinegraph.message() == 'a question\\n[press key to continue]'")
    for key, code in {
        "x": 120,
        "X": 120,
        "7": 55,
        " ": 32,
        "Enter": 13,
        "Escape": 27,
        "ArrowUp": 265,
        "F1": 290,
    }.items():
        browser.press("Shift")
        browser.press(key)
        assert program.line("key") == str(code)
        browser.wait_for("kinegraph.message().endsWith('[press key to continue]')")
    browser.press("q")
    assert program.line("end") == "0"
    assert program.end() == 0


def test_a_key_pressed_before_does_not_answer_the_question(browser: Browser, start: Start) -> None:
    program = start("""
import sys, time
C = kg.Config()
C.addFrame('world')
C.view()
C.viewer().waitForClient(60)
while C.view() != ord('a'):
    time.sleep(.01)
print('before', flush=True)
while not C.viewer().takeKey():
    time.sleep(.01)
print('asking', flush=True)
print('key', C.view(True))
""")
    browser.open(program.url())
    browser.press("a")
    program.line("before")
    browser.press("b")
    program.line("asking")
    browser.wait_for("kinegraph.message() == '[press key to continue]'")
    browser.press("c")
    assert program.line("key") == str(ord("c"))


def test_without_a_browser_view_waits_a_few_seconds_and_headless_not_at_all(start: Start) -> None:
    code = """
import time
C = kg.Config()
before = time.monotonic()
key = C.view(True, 'is anybody there?')
print('took', time.monotonic() - before)
print('key', key)
"""
    patient, headless = start(code), start(code, KINEGRAPH_HEADLESS="1")
    assert float(headless.line("took")) < 2
    assert headless.line("key") == "0"
    assert 4.9 < float(patient.line("took")) < 20
    assert patient.line("key") == "0"


def test_over_ssh_view_waits_for_the_first_browser_and_says_where(browser: Browser, start: Start) -> None:
    code = "C = kg.Config()\nC.addFrame('here')\nprint('key', C.view(True, 'who is there?'))"
    program = start(code, SSH_CONNECTION="192.0.2.1 5 192.0.2.2 22")
    url, hint = program.line("Viewer:").split(" ", 1)
    assert f"ssh -L {url.split(':')[-1].strip('/')}:localhost:" in hint
    time.sleep(6)  # longer than anybody is waited for without ssh
    browser.open(url)
    browser.press("c")
    assert program.line("key") == str(ord("c"))


WATCH = "C = kg.Config()\nC.watchFile('scene.g')\nprint('frames', C.getFrameNames())"


def test_watchfile_shows_edits_and_mistakes_and_their_mending(browser: Browser, start: Start, tmp_path: Path) -> None:
    scene = tmp_path / "scene.g"
    scene.write_text("box: { shape: box, size: [.1 .2 .3], X: [0 0 0] }")
    program = start(WATCH)
    browser.open(program.url())
    assert browser.evaluate("document.title") == "ConfigView <scene.g>"
    for height in range(1, 30):
        scene.write_text(f"box: {{ shape: box, size: [.1 .2 .3], X: [0 0 {height}] }}")
        written = time.perf_counter()
        browser.wait_for(f"kinegraph.position('box')[2] == {height} && kinegraph.idle()")
        if (delay := time.perf_counter() - written) < 0.5:
            break
    assert delay < 0.5  # at least once: the machine may be busy

    scene.write_text("box: { shape: bxo, size: [.1 .2 .3] }")
    browser.wait_for("kinegraph.error().includes('scene.g:1:') && kinegraph.error().includes('bxo')")
    assert browser.is_visible("#error")
    assert browser.evaluate("kinegraph.position('box')[2]") == height
    scene.write_text("ball: { shape: sphere, size: [.1] }")
    browser.wait_for("kinegraph.error() == '' && kinegraph.position('ball')")
    assert not browser.is_visible("#error")

    browser.press("q")
    assert program.line("frames") == "['ball']"
    assert program.end() == 0


def test_watchfile_sees_included_files_come_and_go(browser: Browser, start: Start, tmp_path: Path) -> None:
    scene, part = tmp_path / "scene.g", tmp_path / "part.g"
    scene.write_text("Include: <part.g>")
    program = start(WATCH)
    browser.open_page(program.url())
    browser.wait_for("kinegraph.error().includes('part.g')")
    part.write_text("one: { shape: marker }")
    browser.wait_for("kinegraph.error() == '' && kinegraph.position('one')")
    part.write_text("two: { shape: marker }")
    browser.wait_for("kinegraph.position('two') && !kinegraph.position('one')")


def test_the_end_of_a_program_is_shown_and_the_page_reconnects(browser: Browser, start: Start) -> None:
    code = "C = kg.Config()\nC.addFrame('NAME').setShape(kg.ST.marker, [.1])\nwhile True: C.view(True)"
    program = start(code.replace("NAME", "old"))
    url = program.url()
    browser.open(url)
    assert not browser.is_visible("#ended")
    before = browser.picture()
    program.kill()
    browser.wait_for("kinegraph.ended()")
    assert browser.is_visible("#ended")
    assert "ended" in browser.evaluate("document.querySelector('#ended').textContent")
    assert np.array_equal(browser.picture()[HEIGHT // 2], before[HEIGHT // 2])  # the scene is seen as before
    again = start(code.replace("NAME", "new"))
    assert again.url() == url
    browser.wait_for("!kinegraph.ended() && kinegraph.position('new') && !kinegraph.position('old')")
    assert not browser.is_visible("#ended")


def test_a_page_for_others_works_at_the_printed_address_and_requires_its_token(
    config: kg.Config, browser: Browser
) -> None:
    config.addFrame("here")
    config.view(host="0.0.0.0", port=0)
    url = config.viewer().url
    assert "0.0.0.0" not in url and "localhost" not in url and "?token=" in url
    browser.open(url)
    assert browser.evaluate("kinegraph.position('here')") == [0, 0, 0]
    browser.navigate(url.split("?")[0])
    browser.wait_for("location.search === '' && document.readyState === 'complete'")
    assert browser.evaluate("typeof kinegraph") == "undefined"


def test_a_token_may_be_given(config: kg.Config, browser: Browser) -> None:
    config.addFrame("here")
    with pytest.raises(kg.ArgumentError, match="letters, digits"):
        config.view(port=0, token="a b")
    config.view(port=0, token="my-token_1")
    url = config.viewer().url
    assert url.endswith("/?token=my-token_1")
    browser.open(url)
    browser.navigate(url.replace("my-token_1", "my-token_2"))
    browser.wait_for("location.search.endsWith('2') && document.readyState === 'complete'")
    assert browser.evaluate("typeof kinegraph") == "undefined"


def test_the_page_runs_no_foreign_script_and_loads_nothing(config: kg.Config, browser: Browser) -> None:
    config.addFrame("world")
    config.view()
    browser.open(config.viewer().url)
    browser.evaluate(
        "document.body.append(Object.assign(document.createElement('script'), {textContent: 'window.foreign = 1'}))"
    )
    assert browser.evaluate("window.foreign") is None
    assert browser.evaluate("fetch('http://127.0.0.1:1/').then(() => '', (error) => error.name)") == "TypeError"
