"""A saved page moves its joints itself."""

from __future__ import annotations

import json
import time
from pathlib import Path

import numpy as np
import pytest

import kinegraph as kg

from .browser import Browser

JOINTS = """
base: { shape: marker, size: [.1] }
post (base): { pose: [0 0 .3 1 0 0 0] }
turning (post): { joint: hinge, axis: [0 .6 .8], scale: 2, shape: box, size: [.1 .1 .2], limits: [-1 1] }
sliding (turning): { joint: transX, shape: box, size: [.4 .05 .05], limits: [-.5 .5] }
planar (base): { joint: transXYPhi, shape: box, size: [.1 .1 .1] }
ball (planar): { joint: quatBall, shape: box, size: [.1 .2 .1] }
round (base): { joint: circleZ, shape: box, size: [.1 .1 .3] }
follower (base): { joint: hingeX, mimic: turning, scale: -1, shape: box, size: [.1 .1 .1] }
tip (sliding): { pose: [.3 0 0 .7071 0 .7071 0], shape: sphere, size: [.04] }
still (tip): { joint: hingeY, joint_active: false, q: [.4], shape: box, size: [.05 .05 .2] }
"""


def joint_scene(tmp_path: Path) -> kg.Config:
    (tmp_path / "joints.g").write_text(JOINTS)
    config = kg.Config()
    config.addFile(str(tmp_path / "joints.g"))
    return config


def open_saved(config: kg.Config, browser: Browser, folder: Path, client: Path | None = None) -> None:
    config.viewer().saveHtml(folder / "saved.html", client=client)
    browser.open((folder / "saved.html").as_uri())
    browser.wait_for(f"kinegraph.joints().length === {config.getJointDimension()}")


def set_joint(browser: Browser, index: int, value: float) -> None:
    browser.evaluate(
        f"(() => {{ const slider = document.querySelectorAll('#joint-rows input[type=range]')[{index}];"
        f" slider.value = '{value}'; slider.dispatchEvent(new Event('input')); }})()"
    )
    browser.wait_for(f"Math.abs(kinegraph.joints()[{index}] - {value}) < 1e-6")


def assert_agrees(config: kg.Config, browser: Browser, tolerance: float = 2e-6) -> None:
    """The frames are where the program's forward kinematics puts them."""
    config.setJointState(browser.evaluate("kinegraph.joints()"))
    for frame in config.getFrames():
        shown = browser.evaluate(f"kinegraph.pose({json.dumps(frame.name)})")
        pose = np.asarray(frame.getPose())
        assert shown[:3] == pytest.approx(pose[:3], abs=tolerance), frame.name
        assert abs(np.dot(shown[3:], pose[3:])) == pytest.approx(1, abs=tolerance), frame.name


def test_sliders_move_all_kinds_of_joints(browser: Browser, tmp_path: Path) -> None:
    config = joint_scene(tmp_path)
    open_saved(config, browser, tmp_path)
    browser.press_alt("J")
    assert_agrees(config, browser)
    for index, value in enumerate(np.linspace(-0.45, 0.4, config.getJointDimension())):
        set_joint(browser, index, round(float(value), 3))
    assert_agrees(config, browser)


def test_edits_are_undone_and_joints_return_home(browser: Browser, tmp_path: Path) -> None:
    config = kg.Config()
    config.addFile(kg.raiPath("scenarios/pandaSingle.g"))
    home = config.getJointState()
    open_saved(config, browser, tmp_path)
    browser.press_alt("J")
    set_joint(browser, 3, -1.5)
    browser.click_button("random")
    browser.wait_for("kinegraph.joints()[3] !== -1.5")
    limits = config.getJointLimits()
    values = np.array(browser.evaluate("kinegraph.joints()"))
    assert np.all(values >= limits[0]) and np.all(values <= limits[1])
    assert_agrees(config, browser)
    browser.press("z", modifiers=2)
    browser.wait_for("kinegraph.joints()[3] === -1.5")
    browser.press("z", modifiers=2)
    browser.wait_for(f"kinegraph.joints()[3] === {home[3]}")
    browser.press("y", modifiers=2)
    browser.wait_for("kinegraph.joints()[3] === -1.5")
    browser.click_button("reset")
    browser.wait_for(f"JSON.stringify(kinegraph.joints()) === JSON.stringify({home.tolist()})")


def forearm(config: kg.Config) -> np.ndarray:
    ends = [config.getFrame(f"l_panda_joint{i}").getPosition() for i in (4, 6)]
    return 0.2 * ends[0] + 0.8 * ends[1]


def pull_forearm(config: kg.Config, browser: Browser) -> tuple[float, float]:
    """Drags the forearm to the side; returns where the pointer lets it go."""
    start = browser.pixel(forearm(config))
    end = (start[0] + 24, start[1] - 10)
    browser.press_alt("E")
    browser.drag(start, end)
    return end


def assert_follows(config: kg.Config, browser: Browser, end: tuple[float, float], before: np.ndarray) -> None:
    """The pointer is still on the link that it took, and no joint is beyond its limits."""
    q = np.array(browser.evaluate("kinegraph.joints()"))
    limits = config.getJointLimits()
    assert np.abs(q - before).max() > 0.02
    assert np.all(q >= limits[0] - 1e-9) and np.all(q <= limits[1] + 1e-9)
    browser.press_alt("E")
    browser.wait_for("kinegraph.idle()")
    browser.click(*end)
    browser.wait_for("kinegraph.selected() === 'l_panda_joint6' || kinegraph.selected() === 'l_panda_joint5'")


def test_a_link_is_dragged_by_inverse_kinematics(browser: Browser, tmp_path: Path) -> None:
    config = kg.Config()
    config.addFile(kg.raiPath("scenarios/pandaSingle.g"))
    before = config.getJointState()
    open_saved(config, browser, tmp_path)
    end = pull_forearm(config, browser)
    browser.wait_for(f"kinegraph.joints()[1] !== {before[1]}")
    assert_agrees(config, browser)
    assert_follows(config, browser, end, before)


def test_a_link_of_a_running_program_is_dragged_without_a_script(config: kg.Config, browser: Browser) -> None:
    config.addFile(kg.raiPath("scenarios/pandaSingle.g"))
    before = config.getJointState()
    config.view()
    browser.open(config.viewer().url)
    browser.wait_for("kinegraph.joints().length === 7")
    end = pull_forearm(config, browser)
    browser.wait_for(f"kinegraph.joints()[1] !== {before[1]}")
    assert_follows(config, browser, end, before)
    deadline = time.monotonic() + 30
    shown: list[float] = []
    while time.monotonic() < deadline and config.getJointState() != pytest.approx(shown, abs=1e-9):
        config.view()  # takes what has arrived
        shown = browser.evaluate("kinegraph.joints()")
    assert config.getJointState() == pytest.approx(shown, abs=1e-9)
    assert config.getJointState() != pytest.approx(before, abs=1e-3)


def test_inverse_kinematics_reaches_what_the_program_reaches(browser: Browser, tmp_path: Path) -> None:
    """Poses that random joint values produce are found from the home pose, position and rotation."""
    config = kg.Config()
    config.addFile(kg.raiPath("scenarios/pandaSingle.g"))
    home, limits = config.getJointState(), config.getJointLimits()
    open_saved(config, browser, tmp_path)
    rng = np.random.default_rng(0)
    for _ in range(5):
        q = np.clip(home + rng.uniform(-0.3, 0.3, 7), limits[0], limits[1])
        config.setJointState(q)
        pose = config.getFrame("l_gripper").getPose().tolist()
        found = np.array(browser.evaluate(f"kinegraph.reach('l_gripper', {pose})"))
        assert np.all(found >= limits[0]) and np.all(found <= limits[1])
        config.setJointState(found)
        assert config.getFrame("l_gripper").getPosition() == pytest.approx(pose[:3], abs=1e-4)
        assert abs(np.dot(config.getFrame("l_gripper").getQuaternion(), pose[3:])) == pytest.approx(1, abs=1e-6)
    far = browser.evaluate("kinegraph.reach('l_gripper', [5, 0, 1, 1, 0, 0, 0])")
    assert np.all(far >= limits[0]) and np.all(far <= limits[1]) and np.all(np.isfinite(far))


def test_a_saved_panda_is_light(browser: Browser, tmp_path: Path) -> None:
    config = kg.Config()
    config.addFile(kg.raiPath("scenarios/pandaSingle.g"))
    assert len(config.viewer().asHtml()) < 600_000
    assert len(config.viewer()._repr_html_()) < 600_000


def test_a_detailed_mesh_is_packed_into_a_few_bytes_per_triangle(config: kg.Config, browser: Browser) -> None:
    """As of a robot's link from a file: each corner with its own normals was three floats and an index."""
    n = 250
    u, v = np.meshgrid(np.linspace(0, 2 * np.pi, n), np.linspace(0, np.pi, n), indexing="ij")
    points = np.stack([np.sin(v) * np.cos(u), np.sin(v) * np.sin(u), 0.7 * np.cos(v)], axis=-1).reshape(-1, 3)
    i, j = (k.reshape(-1) for k in np.meshgrid(np.arange(n - 1), np.arange(n - 1), indexing="ij"))
    corners = np.stack([i * n + j, i * n + j + 1, (i + 1) * n + j + 1, (i + 1) * n + j], axis=1)
    triangles = np.concatenate([corners[:, [0, 1, 2]], corners[:, [0, 2, 3]]]).astype(np.uint32)
    empty = len(config.viewer().asHtml())
    config.addFrame("egg").setMesh(points[triangles].reshape(-1, 3), np.arange(triangles.size).reshape(-1, 3))
    assert len(config.viewer().asHtml()) - empty < 6 * len(triangles)


def test_pages_run_the_script_that_they_share(browser: Browser, tmp_path: Path) -> None:
    config = joint_scene(tmp_path)
    (tmp_path / "a folder").mkdir()
    for folder in (tmp_path, tmp_path / "a folder"):
        open_saved(config, browser, folder, tmp_path / "viewer.js")
        assert len((folder / "saved.html").read_text()) < 60_000
        set_joint(browser, 0, 0.5)
        assert_agrees(config, browser)


def test_a_page_cannot_be_its_own_script(config: kg.Config, tmp_path: Path) -> None:
    for client in (tmp_path / "saved.html", ""):
        with pytest.raises(kg.ArgumentError, match="saveHtml: "):
            config.viewer().saveHtml(tmp_path / "saved.html", client=client)
