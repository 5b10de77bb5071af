"""Plans on the page of their scene."""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
import pytest

import kinegraph as kg

from .browser import Browser

sys.path.insert(0, str(Path(__file__).parents[2] / "benchmarks"))

import tasks as families

SLIDER = "document.querySelector('#motion input[type=range]')"


@pytest.fixture
def scene(config: kg.Config) -> kg.Config:
    """A gripper on slides, a table, and an object on it."""
    config.addFrame("table").setShape(kg.ST.ssBox, [1.0, 1.0, 0.1, 0.01]).setPosition([0, 0, -0.05]).setAttributes(
        {"logical": {"is_place": True}}
    )
    base = config.addFrame("base")
    x = config.addFrame("x", base.name).setJoint(kg.JT.transXYPhi, [-0.6, -0.6, -3, 0.6, 0.6, 3])
    config.addFrame("hand", x.name).setJoint(kg.JT.transZ, [0, 1]).setShape(kg.ST.sphere, [0.03])
    config.setJointState([0, 0, 0, 0.5])
    return config


def test_a_motion_plan_plays_on_the_page_of_its_scene(scene: kg.Config, browser: Browser) -> None:
    scene.view()
    browser.open(scene.viewer().url)
    plan = kg.planMotion(scene, [0.4, 0.3, 1.0, 0.6])
    assert plan
    plan.view(scene)
    browser.wait_for("kinegraph.slice() !== null")
    assert browser.evaluate(SLIDER + ".max") == str(len(plan.path) - 1)
    np.testing.assert_array_equal(scene.getJointState(), [0, 0, 0, 0.5])
    scene.view()
    browser.wait_for(f"kinegraph.slice() === null && kinegraph.frames() == {scene.getFrameDimension()}")


def test_a_task_plan_has_the_time_slider_on_the_page_of_its_scene(browser: Browser) -> None:
    problem = families.tower(0)
    scene = problem.C
    plan = kg.planTask(scene, problem.goal)
    before = scene.getFrameState()
    scene.view()
    browser.open(scene.viewer().url)
    assert plan.view(scene, pause=False) == 0
    browser.wait_for("kinegraph.slice() !== null")
    assert int(browser.evaluate(SLIDER + ".max")) + 1 == len(plan.frames(scene))
    held = plan.actions[0][1]
    last = f"{SLIDER}.value = {SLIDER}.max; {SLIDER}.dispatchEvent(new Event('input')); kinegraph.position('{held}')"
    np.testing.assert_allclose(browser.evaluate(last), plan.frames(scene)[-1][scene.getFrame(held).ID][:3], atol=1e-5)
    assert str(plan.actions[-1][0]) in browser.evaluate("document.querySelector('.slice-text').textContent")
    np.testing.assert_array_equal(scene.getFrameState(), before)
    scene.view_close()


def test_without_a_plan_the_page_explains_what_is_impossible_and_shows_what_failed(browser: Browser) -> None:
    problem = families.far(0)
    plan = kg.planTask(problem.C, "(on goal obj)")
    problem.C.view()
    browser.open(problem.C.viewer().url)
    assert plan.view(problem.C, pause=False) == 0
    browser.wait_for("kinegraph.message().includes('beyond the reach')")
    problem.C.view_close()
    problem = families.walled(0)
    plan = kg.planTask(problem.C, problem.goal)
    problem.C.view()
    browser.open(problem.C.viewer().url)
    assert plan.view(problem.C, pause=False) == 0
    browser.wait_for("kinegraph.position('failed g_palm') !== null")
    problem.C.view()
    browser.wait_for("kinegraph.position('failed g_palm') === null")
    problem.C.view_close()
