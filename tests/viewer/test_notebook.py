"""The viewer in a notebook."""

from __future__ import annotations

import base64
import html
import re
import sys
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

import kinegraph as kg

from .browser import Browser


@pytest.fixture
def shown(monkeypatch: pytest.MonkeyPatch) -> list:
    """The output of a notebook, with a simulated IPython kernel."""
    shown: list = []
    shell = SimpleNamespace(config={"IPKernelApp": {}})
    frame = SimpleNamespace(IFrame=lambda *arguments: arguments, display=shown.append)
    monkeypatch.setitem(sys.modules, "IPython", SimpleNamespace(get_ipython=lambda: shell, display=frame))
    monkeypatch.setitem(sys.modules, "IPython.display", frame)
    return shown


def test_the_page_appears_below_the_cell_once(shown: list, config: kg.Config) -> None:
    config.addFrame("world")
    config.view()
    config.view()
    assert shown == [(config.viewer().url, "100%", 480)]


def test_nothing_is_shown_outside_of_notebooks(shown: list, config: kg.Config, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys.modules["IPython"], "get_ipython", lambda: None)
    config.view()
    assert shown == []


def test_a_viewer_is_a_picture_that_can_be_rotated(config: kg.Config, browser: Browser, tmp_path) -> None:
    config.addFrame("the box").setShape(kg.ST.box, [0.1, 0.2, 0.3]).setPosition([1, 2, 3])
    config.view()
    frame = config.viewer()._repr_html_()
    config.view_close()
    page = html.unescape(
        re.fullmatch(r'<iframe srcdoc="([^"]*)" width="100%" height="480" style="[^"]*"></iframe>', frame)[1]
    )
    (tmp_path / "page.html").write_text(page)
    browser.open((tmp_path / "page.html").as_uri())
    assert browser.evaluate("kinegraph.position('the box')") == [1, 2, 3]


def opened(frame: str, browser: Browser, folder: Path) -> None:
    page = html.unescape(re.fullmatch(r'<iframe srcdoc="([^"]*)".*></iframe>', frame)[1])
    (folder / "page.html").write_text(page)
    browser.open((folder / "page.html").as_uri())


def test_a_motion_is_an_element_that_plays_without_a_program(browser: Browser, tmp_path: Path) -> None:
    config = kg.Config()
    config.addFrame("base")
    config.addFrame("one", "base").setJoint(kg.JT.transX, [-3, 3]).setShape(kg.ST.box, [0.2, 0.2, 0.2])
    komo = kg.KOMO(config, 1, 4, 1, False)
    komo.addObjective([1], kg.FS.position, ["one"], kg.OT.eq, [1], [1, 0, 0])
    kg.NLP_Solver(komo.nlp(), verbose=0).solve()
    opened(komo._repr_html_(), browser, tmp_path)
    browser.wait_for("kinegraph.slice() === 3 && Math.abs(kinegraph.position('one')[0] - 1) < 1e-3")
    browser.press("ArrowLeft")
    browser.wait_for("kinegraph.slice() === 2")


def knot(turns: int, around: int) -> tuple[np.ndarray, np.ndarray]:
    """A bumpy ring whose triangles share no vertices, as many files have them."""
    u, v = np.meshgrid(2 * np.pi * np.arange(turns) / turns, 2 * np.pi * np.arange(around) / around, indexing="ij")
    radius = 0.3 + 0.1 * (1 + 0.05 * np.sin(9 * u) * np.cos(7 * v)) * np.cos(v)
    points = np.stack([radius * np.cos(u), radius * np.sin(u), 0.1 * np.sin(v)], axis=-1).reshape(-1, 3)
    i, j = np.meshgrid(np.arange(turns), np.arange(around), indexing="ij")
    a, b, c, d = (k % turns * around + m % around for k, m in ((i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)))
    triangles = np.concatenate([np.stack([a, b, c], -1).reshape(-1, 3), np.stack([a, c, d], -1).reshape(-1, 3)])
    return points[triangles.reshape(-1)], np.arange(triangles.size).reshape(-1, 3)


def test_a_large_scene_is_a_small_element_that_looks_the_same(
    config: kg.Config, browser: Browser, tmp_path: Path
) -> None:
    points, triangles = knot(300, 200)
    for i in range(4):
        config.addFrame(f"ring{i}").setMesh(points * (1 + 0.1 * i), triangles).setPosition([0, 0, 0.4 + 0.3 * i])
    viewer = config.viewer()
    whole, element = viewer.asHtml(), viewer._repr_html_()
    assert len(whole) > 700_000 and len(element) < 600_000
    (tmp_path / "whole.html").write_text(whole)
    browser.open((tmp_path / "whole.html").as_uri())
    before = browser.picture().astype(int)
    opened(element, browser, tmp_path)
    assert browser.evaluate("kinegraph.position('ring3')") == pytest.approx([0, 0, 1.3], abs=1e-6)
    after = browser.picture().astype(int)
    assert (np.abs(after - before).max(axis=2) > 30).mean() < 0.01 and after.std() > 20
    assert browser.errors == []


def test_messages_are_unpacked_bit_by_bit(browser: Browser, tmp_path: Path) -> None:
    """Without lack of space nothing is merged: all bytes of a motion equal the saved ones."""
    config = kg.Config()
    config.addFrame("base")
    config.addFrame("one", "base").setJoint(kg.JT.transX, [-3, 3]).setShape(kg.ST.box, [0.2, 0.2, 0.2])
    path = np.random.default_rng(0).uniform(-3, 3, (200, 1))
    config.view_path(path, 2.0)
    opened(config.viewer()._repr_html_(), browser, tmp_path)
    config.view_close()
    for t in (0, 77, 199):
        browser.wait_for(
            f"(document.querySelector('#motion input[type=range]').valueAsNumber = {t}, document.querySelector('#motion input[type=range]').dispatchEvent(new Event('input')), kinegraph.slice() === {t})"
        )
        assert browser.evaluate("kinegraph.position('one')[0]") == np.float32(path[t, 0])


def test_a_viewer_that_was_never_opened_is_a_page_as_well(browser: Browser, tmp_path: Path) -> None:
    config = kg.Config()
    config.addFrame("the box").setShape(kg.ST.box, [0.1, 0.2, 0.3]).setPosition([1, 2, 3])
    opened(config.viewer()._repr_html_(), browser, tmp_path)
    assert browser.evaluate("kinegraph.position('the box')") == [1, 2, 3]


def test_a_configuration_is_a_picture_and_a_table() -> None:
    config = kg.Config()
    config.addFrame("the box").setShape(kg.ST.box, [0.1, 0.2, 0.3])
    element = config._repr_html_()
    picture = re.search(r'<img alt="the scene" src="data:image/png;base64,([^"]*)">', element)
    assert base64.b64decode(picture[1]).startswith(b"\x89PNG")
    assert "the box" in element


def plan_in(config: kg.Config) -> kg.MotionPlan:
    config.addFile(kg.raiPath("scenarios/pandaSingle.g"))
    return kg.planMotion(config, {"l_gripper": [0.4, 0.2, 0.9]})


def test_a_motion_plan_plays_itself(config: kg.Config, browser: Browser, tmp_path: Path) -> None:
    plan = plan_in(config)
    page = plan._repr_html_()
    assert len(page) < 600_000 and page.endswith("</pre>")
    opened(page.split("<pre>")[0], browser, tmp_path)
    config.setJointState(plan.path[-1])
    there = config.getFrame("l_gripper").getPosition()
    browser.wait_for(f"Math.hypot(...kinegraph.position('l_gripper').map((x, i) => x - {there.tolist()}[i])) < 1e-3")


def test_a_roadmap_and_a_recording_show_themselves(config: kg.Config) -> None:
    plan_in(config)
    roadmap = kg.Roadmap(config)
    roadmap.grow(20)
    assert "20 configurations" in roadmap._repr_html_()
    config.addFrame("ball").setShape(kg.ST.sphere, [0.05]).setPosition([0.4, 0.3, 1.2]).setMass(0.1).setContact(1)
    simulation = kg.Simulation(config, kg.SimulationEngine.physx)
    simulation.startRecording()
    for _ in range(50):
        simulation.step([], 0.01, kg.ControlMode.none)
    page = simulation.stopRecording()._repr_html_()
    assert page.startswith("<iframe") and len(page) < 600_000


def test_a_recording_without_frames_shows_itself() -> None:
    simulation = kg.Simulation(kg.Config(), kg.SimulationEngine.physx)
    simulation.startRecording()
    for _ in range(5):
        simulation.step([], 0.01, kg.ControlMode.none)
    assert simulation.stopRecording()._repr_html_().startswith("<iframe")


def test_a_large_roadmap_is_a_small_element(config: kg.Config) -> None:
    config.addFile(kg.raiPath("scenarios/pandaSingle.g"))
    roadmap = kg.Roadmap(config)
    roadmap.grow(220)
    assert len(roadmap._repr_html_()) < 600_000


def test_pictures_are_of_the_scene_after_a_plan_was_shown(config: kg.Config) -> None:
    plan = plan_in(config)
    plan.view(config, pause=False)
    config.viewer().setWindow("", 320, 240)  # smaller ones are covered by the text of the plan
    before = config.viewer().getRgb()
    config.setJointState(plan.path[-1])
    assert np.abs(config.viewer().getRgb().astype(int) - before).max() > 40
    config.addFrame("new").setPosition([1, 2, 3])
    config.viewer().setCamera("new")


def test_a_task_plan_shows_its_motion_or_only_its_text(config: kg.Config) -> None:
    config.addFile(kg.raiPath("scenarios/pandaSingle.g"))
    cup = config.addFrame("cup", "table").setShape(kg.ST.ssBox, [0.05, 0.05, 0.1, 0.01])
    cup.setRelativePosition([0.3, 0.3, 0.1]).setJoint(kg.JT.rigid).setContact(1)
    tray = config.addFrame("tray", "table").setShape(kg.ST.ssBox, [0.3, 0.3, 0.04, 0.01]).setContact(1)
    tray.setRelativePosition([-0.3, 0.3, 0.07])
    page = kg.planTask(config, "(on tray cup)")._repr_html_()
    assert page.startswith("<iframe") and "2 actions" in page and len(page) < 600_000
    cup.setJoint(kg.JT.none)
    assert kg.planTask(config, "(on tray cup)")._repr_html_() is None
