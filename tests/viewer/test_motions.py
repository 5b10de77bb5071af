"""Motions in the browser: time slider, playing, all slices at once, and saved files."""

from __future__ import annotations

import base64
import json
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np
import pytest

import kinegraph as kg

from .browser import Browser
from .program import KinematicModel

ARM = """
C.addFrame('base')
C.addFrame('one', 'base').setJoint(kg.JT.transX, [-3, 3]).setShape(kg.ST.box, [.2, .2, .2])
C.addFrame('two', 'one').setJoint(kg.JT.transZ, [0, 2]).setShape(kg.ST.sphere, [.1])
C.view()
"""
PROGRAM = "C = kg.Config()" + ARM + "C.viewer().waitForClient(60)\n"
POSITION = "((x, y) => Math.abs(x - y) < 1e-5)(kinegraph.position('one')[0], {})"


def show_arm(config: kg.Config) -> None:
    exec(ARM, {"kg": kg, "C": config})


@pytest.fixture
def komo() -> Iterator[kg.KOMO]:
    """A path of a Panda through two points with an unreachable end; it meets neither."""
    config = kg.Config()
    config.addFile(kg.raiPath("scenarios/pandaSingle.g"))
    komo = kg.KOMO(config, 3, 4, 2, False)
    komo.addControlObjective([], 2, 1e-1)
    komo.addObjective([1], kg.FS.position, ["l_gripper"], kg.OT.eq, [1], [0.3, 0.3, 1])
    komo.addObjective([3], kg.FS.position, ["l_gripper"], kg.OT.eq, [1], [5, 5, 5])
    kg.NLP_Solver(komo.nlp(), verbose=0).solve()
    yield komo
    komo.view_close()


def test_a_path_is_played_and_can_be_looked_at_slice_by_slice(
    browser: Browser, start: Callable[..., KinematicModel]
) -> None:
    path = "[[0, 0], [1, 0], [2, 1], [2, 1.5]]"
    program = start(
        PROGRAM + f"print('key', C.view_path({path}, .5), C.getJointState())\nC.view_path({path}, .1, True)"
    )
    browser.open(program.url())
    assert program.line("key") == "0 [0. 0.]"
    browser.wait_for(f"kinegraph.slice() === 3 && kinegraph.message().includes('press key') && {POSITION.format(2)}")
    browser.press("q")
    assert program.end() == 0


def test_the_time_slider_moves_everything(config: kg.Config, browser: Browser) -> None:
    show_arm(config)
    browser.open(config.viewer().url)
    assert not browser.is_visible("#motion")
    config.view_path([[0, 0], [1, 0], [2, 1], [2, 1.5]], 1.0)
    browser.wait_for("kinegraph.slice() === 3 && !kinegraph.playing()")
    slider = "document.querySelector('[aria-label=time]')"
    browser.evaluate(f"{slider}.value = 0.5; {slider}.dispatchEvent(new Event('input'))")
    browser.wait_for(POSITION.format(0.5))
    browser.press("ArrowRight")
    browser.wait_for(f"kinegraph.slice() === 1 && {POSITION.format(1)}")
    assert browser.evaluate("document.querySelector('[aria-label=\"one\"]').valueAsNumber") == pytest.approx(1)
    browser.press("ArrowLeft")
    browser.wait_for(f"kinegraph.slice() === 0 && {POSITION.format(0)}")
    browser.press_alt("K")  # play
    browser.wait_for(f"kinegraph.slice() === 3 && !kinegraph.playing() && {POSITION.format(2)}")
    assert config.viewer().takeKey() == 0
    config.view()
    browser.wait_for(f"kinegraph.slice() === null && {POSITION.format(0)}")
    assert not browser.is_visible("#motion")


def test_all_slices_and_curves_can_be_shown(config: kg.Config, browser: Browser) -> None:
    show_arm(config)
    config.viewer().setCamera([1, 5, 1], [1, 0, 0.3])
    browser.open(config.viewer().url)
    config.view_path([[0, 0], [1, 0], [2, 1]], 0.1)
    browser.wait_for("kinegraph.slice() === 2 && kinegraph.idle()")
    column, row = (round(value) for value in browser.pixel([0, 0, 0]))
    region = np.s_[row - 6 : row + 6, column - 6 : column + 6]
    alone = browser.picture()[region].astype(float).mean()
    boxes = "[...document.querySelectorAll('#motion label')].find((x) => x.textContent === '{}').click()"
    browser.evaluate(boxes.format("all slices"))
    browser.wait_for("kinegraph.idle()")
    assert abs(browser.picture()[region].astype(float).mean() - alone) > 5
    assert not browser.is_visible(".curves")
    browser.evaluate(boxes.format("curves"))
    browser.wait_for("document.querySelector('.curves').checkVisibility()")
    assert browser.evaluate("document.querySelector('.legend').innerText.trim().split(/\\s+/).join()") == "one,two"
    ink = """(() => { const c = document.querySelector('.curves');
      return c.getContext('2d').getImageData(0, 0, c.width, c.height).data.filter((x, i) => i % 4 == 3 && x > 0).length })()"""
    assert browser.evaluate(ink) > 200


def test_a_komo_shows_all_slices_and_marks_violations(komo: kg.KOMO, browser: Browser) -> None:
    assert komo.view() == 0
    browser.open(komo.get_viewer().url)
    browser.wait_for(
        "kinegraph.slice() === 11 && kinegraph.idle() && document.querySelector('#motion').checkVisibility()"
    )
    assert "l_gripper" in browser.evaluate("document.querySelector('.slice-text').textContent")
    assert browser.evaluate("document.querySelector('.slice-text').classList.contains('violated')")
    red = """((c) => [...Array(14).keys()].filter((t) =>
      c.getContext('2d').getImageData(c.width * (t + 0.5) / 14, c.height >> 1, 1, 1).data[3] > 0))(document.querySelector('.marks'))"""
    assert browser.evaluate(red) == [2 + 3, 2 + 11]  # the slices with an equality; two lie before the path
    assert browser.evaluate("kinegraph.marks()") > 0  # the gripper is red
    browser.press("ArrowLeft")
    browser.wait_for("kinegraph.slice() === 10 && kinegraph.marks() === 0")
    browser.evaluate("[...document.querySelectorAll('#motion label')].find((x) => x.textContent === 'errors').click()")
    assert "F_Position" in browser.evaluate("document.querySelector('.legend').textContent")
    browser.evaluate("document.activeElement.blur()")
    browser.press("ArrowRight")
    browser.wait_for("kinegraph.slice() === 11")
    gripper = komo.getPathFrames()[11][komo.getConfig().getFrameNames().index("l_gripper")]
    assert browser.evaluate("kinegraph.position('l_gripper')") == pytest.approx(list(gripper[:3]), abs=1e-5)


def test_a_slice_of_a_komo_is_shown(komo: kg.KOMO, browser: Browser) -> None:
    assert komo.view_slice(3) == 0
    browser.open(komo.get_viewer().url)
    browser.wait_for("kinegraph.slice() === 3 && !kinegraph.playing()")
    gripper = komo.getPathFrames()[3][komo.getConfig().getFrameNames().index("l_gripper")]
    assert browser.evaluate("kinegraph.position('l_gripper')") == pytest.approx(list(gripper[:3]), abs=1e-5)
    assert komo.view_slice(-2) == 0
    browser.wait_for("kinegraph.slice() === -2")
    for t in (12, -3):
        with pytest.raises(ValueError, match="expected 0 to 11, or -2 to -1 before the path"):
            komo.view_slice(t)


def test_playing_a_komo_saves_pictures(komo: kg.KOMO, tmp_path: Path) -> None:
    (tmp_path / "slice000099.png").touch()
    (tmp_path / "slice_of_cake.png").touch()
    assert komo.view_play(delay=0.01, saveVideoPath=str(tmp_path / "slice")) == 0
    files = sorted(tmp_path.glob("slice0*.png"))
    assert (tmp_path / "slice_of_cake.png").exists()
    assert [file.name for file in files] == [f"slice{t:06}.png" for t in range(14)]
    assert files[0].read_bytes() != files[-1].read_bytes()


def test_a_key_ends_the_playing(browser: Browser, start: Callable[..., KinematicModel]) -> None:
    program = start(
        "C = kg.Config()" + ARM + "for i in range(100): C.addFrame(f'joint{i}', 'base').setJoint(kg.JT.hingeX)\n"
        "C.view()\nC.viewer().waitForClient(60)\nC.animate()\n"  # 102 s, if nobody ends it
        "print('key', C.view_path([C.getJointState()] * 2, 600., True, 'a path'))"
    )
    browser.open_page(program.url())
    browser.wait_for("kinegraph.playing() && document.querySelector('.slice-text').textContent.startsWith('joint')")
    browser.press("x")
    browser.wait_for("kinegraph.message() == 'a path' && kinegraph.playing()")
    browser.press("y")
    assert program.line("key") == str(ord("y"))


def test_looking_around_while_a_motion_plays_does_not_end_it(
    browser: Browser, start: Callable[..., KinematicModel]
) -> None:
    program = start("""
import time
C = kg.Config()
C.addFrame("base")
C.addFrame("arm", "base").setJoint(kg.JT.hingeX, [-1, 1]).setShape(kg.ST.box, [.1, .1, .5])
komo = kg.KOMO(C, 1, 30, 1, False)
komo.get_viewer().url
komo.get_viewer().waitForClient(60)
begin = time.monotonic()
print("key", komo.view_play(delay=.1), time.monotonic() - begin)
""")
    browser.open_page(program.url())
    browser.wait_for("kinegraph.playing()")
    for modifiers in (0, 8):  # nearer; a slice on, with Shift
        where = {"x": 300, "y": 200, "deltaX": 0, "deltaY": 120}
        browser.call("Input.dispatchMouseEvent", type="mouseWheel", modifiers=modifiers, **where)
    browser.drag((320, 100), (380, 130))
    key, seconds = program.line("key").split()
    assert key == "0" and float(seconds) >= 3


def downloaded(folder: Path, pattern: str) -> bytes:
    deadline = time.monotonic() + 60
    while time.monotonic() < deadline:
        for file in folder.glob(pattern):
            return file.read_bytes()
        time.sleep(0.05)
    raise TimeoutError(f"no {pattern} was saved")


def check_hierarchy(glb: bytes, config: kg.Config) -> None:
    """The nodes of a glTF file are the frames, each below its parent, and the y axis is up."""
    nodes = json.loads(glb[20 : 20 + int.from_bytes(glb[12:16], "little")])["nodes"]
    parents = {nodes[child].get("name"): node.get("name") for node in nodes for child in node.get("children", [])}
    for frame in config.getFrames():
        parent = frame.getParent()
        assert parents[frame.name] == (parent.name if parent else "scene")
    (root,) = (node for node in nodes if node.get("name") == "scene")
    assert root["rotation"] == pytest.approx([-np.sqrt(0.5), 0, 0, np.sqrt(0.5)])


def test_motions_and_shapes_are_saved(config: kg.Config, browser: Browser, tmp_path: Path) -> None:
    show_arm(config)
    browser.open(config.viewer().url)
    browser.call("Browser.setDownloadBehavior", behavior="allow", downloadPath=str(tmp_path))
    browser.press_alt("O")
    assert browser.evaluate("document.querySelector('#video').disabled")
    browser.click_button("model")
    assert downloaded(tmp_path, "*.glb").startswith(b"glTF")
    (model,) = tmp_path.glob("*.glb")
    again = kg.Config()  # read by another library than the one that wrote it
    again.addFrame("model", "", f"mesh: <{model}>")
    points = again.getFrame("model").getMeshPoints()
    assert points.max(axis=0) == pytest.approx([0.1, 0.1, 0.1], abs=1e-3)
    assert points.min(axis=0) == pytest.approx([-0.1, -0.1, -0.1], abs=1e-3)
    check_hierarchy(model.read_bytes(), config)
    config.view_path([[0, 0], [1, 0], [2, 1]], 0.5)
    browser.wait_for("kinegraph.slice() === 2")
    config_seconds = float(browser.evaluate("document.querySelector('#motion').textContent").split(" s")[0].split()[-1])
    browser.click_button("video")
    video = downloaded(tmp_path, "*.webm")
    assert video.startswith(b"\x1a\x45\xdf\xa3")  # EBML, the container of WebM
    assert len(video) > 1000
    played = browser.evaluate(f"""(async () => {{
      const video = document.createElement("video");
      video.src = "data:video/webm;base64,{base64.b64encode(video).decode()}";
      await new Promise((resolve, reject) => {{ video.onloadeddata = resolve; video.onerror = () => reject(new Error("no video")); }});
      return [video.videoWidth, video.videoHeight, video.duration];
    }})()""")
    canvas = browser.evaluate(
        "(({ clientWidth: w, clientHeight: h }) => [w - (w % 2), h])(document.querySelector('canvas'))"
    )
    assert played[:2] == canvas  # the picture on the page, beside the panel
    assert played[2] == pytest.approx(config_seconds + 0.5, abs=0.1)  # the end stays for half a second
    browser.click_button("page")
    assert b"recording" in downloaded(tmp_path, "*.html")


def test_a_saved_page_shows_the_motion_without_the_program(config: kg.Config, browser: Browser, tmp_path: Path) -> None:
    show_arm(config)
    config.addFrame("</script><b>").setMesh(np.eye(4, 3), np.array([[0, 1, 2], [0, 2, 3]], np.uint32))
    config.view_path([[0, 0], [1, 0], [2, 1]], 0.1, message="saved")
    file = tmp_path / "scene.html"
    config.viewer().saveHtml(file)
    config.view_close()
    browser.open(file.as_uri())
    browser.wait_for("kinegraph.slice() !== null && kinegraph.meshes() === 1")
    assert browser.evaluate("kinegraph.message()") == "saved"
    assert browser.evaluate("kinegraph.position('</script><b>')") == [0, 0, 0]
    browser.wait_for("!kinegraph.playing()")
    browser.press("ArrowLeft")
    browser.wait_for(POSITION.format(1))
    assert not browser.evaluate("kinegraph.ended()")
    assert not browser.evaluate("!!document.querySelector('#page')")
