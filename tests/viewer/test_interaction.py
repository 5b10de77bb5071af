"""Edits in the browser: joints by sliders, frames by handles, and the cards of frames."""

from __future__ import annotations

import json
import time
from collections.abc import Callable

import numpy as np
import pytest

import kinegraph as kg

from .browser import Browser
from .program import KinematicModel

SLIDER = "document.querySelector('input[type=range][aria-label=\"{}\"]')"


def set_slider(page: Browser, joint: str, value: float) -> None:
    slider = SLIDER.format(joint)
    page.wait_for(f"{slider} !== null")
    page.evaluate(f"{slider}.value = {value}; {slider}.dispatchEvent(new Event('input'))")


CENTER_OF_MEASURE = """((box) => [box.x + box.width / 2, box.y + box.height / 2])(
  document.querySelector("#measure-button").getBoundingClientRect())"""


@pytest.fixture
def arm(config: kg.Config) -> kg.Config:
    """A post with a slide on a hinge, a box beside them, and a mug on the box."""
    config.addFrame("post").setShape(kg.ST.box, [0.2, 0.2, 1.0]).setPosition([0, 0, 0.5])
    hinge = config.addFrame("hinge", "post").setJoint(kg.JT.hingeZ, [-1, 2]).setShape(kg.ST.capsule, [0.3, 0.1])
    hinge.setColor([1, 0, 0])
    slide = config.addFrame("slide", "hinge").setJoint(kg.JT.transX, [0, 0.5])
    slide.setShape(kg.ST.sphere, [0.1]).setColor([0, 0, 1])
    config.addFrame("box").setShape(kg.ST.box, [0.4, 0.4, 0.4]).setPosition([-1, 0, 0.2]).setContact(1)
    mug = config.addFrame("the mug", "box").setShape(kg.ST.cylinder, [0.1, 0.05])
    mug.setRelativePosition([0, 0, 0.25])
    return config


def open_page(config: kg.Config, page: Browser) -> None:
    config.view()
    config.viewer().setCamera([0, 3, 1.5], [0, 0, 0.5])
    page.open(config.viewer().url)


def test_sliders_have_the_limits_of_the_joints_and_show_their_values(arm: kg.Config, browser: Browser) -> None:
    arm.setJointState([0.75, 0.125])
    open_page(arm, browser)
    browser.press_alt("J")
    limits = "((x) => [x.min, x.max, x.value].map(Number))"
    assert browser.evaluate(limits + f"({SLIDER.format('hinge')})") == [-1, 2, 0.75]
    assert browser.evaluate(limits + f"({SLIDER.format('slide')})") == [0, 0.5, 0.125]
    arm.setJointState([-0.5, 0.25])
    arm.view()
    browser.wait_for(f"{SLIDER.format('hinge')}.valueAsNumber == -0.5")
    assert browser.evaluate("document.querySelector('[aria-label=\"hinge, value\"]').value") == "-0.500"


def test_a_slider_moves_the_robot_at_once_and_the_configuration_at_the_next_view(
    arm: kg.Config, browser: Browser
) -> None:
    open_page(arm, browser)
    set_slider(browser, "slide", 0.5)
    browser.wait_for("Math.abs(kinegraph.position('slide')[0] - 0.5) < 1e-6")
    assert arm.getJointState().tolist() == [0, 0]
    assert arm.viewer().hasEdits()
    arm.view()
    assert arm.getJointState().tolist() == [0, 0.5]
    assert not arm.viewer().hasEdits()


def test_joints_move_while_the_program_waits_for_a_key(browser: Browser, start: Callable[..., KinematicModel]) -> None:
    program = start("""
C = kg.Config()
C.addFile(kg.raiPath('scenarios/pandaSingle.g'))
C.view(True)
print('q', C.getJointState()[0])
""")
    browser.open(program.url())
    set_slider(browser, "l_panda_joint1", 1.25)
    browser.wait_for("kinegraph.joints()[0] == 1.25")
    browser.press("q")
    assert program.line("q") == "1.25"


def test_random_stays_within_the_limits_and_reset_goes_home(arm: kg.Config, browser: Browser) -> None:
    open_page(arm, browser)
    for _ in range(5):
        before = browser.evaluate("kinegraph.joints()")
        browser.click_button("random")
        browser.wait_for(f"JSON.stringify(kinegraph.joints()) != '{json.dumps(before, separators=(',', ':'))}'")
        hinge, slide = browser.evaluate("kinegraph.joints()")
        assert -1 <= hinge <= 2
        assert 0 <= slide <= 0.5
    browser.click_button("reset")
    browser.wait_for("kinegraph.joints().join() == '0,0'")


def test_two_browsers_stay_in_step(arm: kg.Config, browser: Browser) -> None:
    open_page(arm, browser)
    with Browser() as other:
        other.open(arm.viewer().url)
        set_slider(browser, "hinge", 1.0)
        other.wait_for(f"kinegraph.joints()[0] == 1 && {SLIDER.format('hinge')}.valueAsNumber == 1")
        set_slider(other, "slide", 0.25)
        browser.wait_for("kinegraph.joints().join() == '1,0.25'")
        assert other.errors == []


def test_a_click_shows_the_card_of_the_frame(arm: kg.Config, browser: Browser) -> None:
    arm.setJointState([0.5, 0.25])
    open_page(arm, browser)
    browser.click(*browser.pixel(arm.getFrame("the mug").getPosition()))
    browser.wait_for("kinegraph.selected() == 'the mug'")
    assert browser.is_visible("#card")
    card = browser.evaluate("document.querySelector('#card').innerText")
    for text in ("the mug", "box", "-1.0000 0.0000 0.4500", "0.0000 0.0000 0.2500", "cylinder"):
        assert text in card
    browser.click_button("box")  # its parent
    browser.wait_for("kinegraph.selected() == 'box'")
    assert "contact: 1" in browser.evaluate("document.querySelector('#card').innerText")
    browser.press("Escape")
    browser.wait_for("kinegraph.selected() === null")
    assert not browser.is_visible("#card")
    assert arm.viewer().takeKey() == 0


def test_a_selected_frame_is_copied_as_an_entry_of_a_scene(arm: kg.Config, browser: Browser) -> None:
    arm.setJointState([0.5, 0.25])
    open_page(arm, browser)
    browser.press_alt("T")
    copies = []
    for name in ("post", "hinge", "slide", "box"):  # parents first
        browser.evaluate(f"document.querySelector('[title=\"select {name}\"]').click()")
        browser.wait_for(f"kinegraph.selected() == '{name}'")
        assert browser.evaluate("document.querySelector('#tree .selected').textContent") == name
        copies.append(browser.evaluate("kinegraph.asText()"))
    copied = kg.Config()
    copied.addText("\n".join(copies))
    assert np.allclose(copied.getJointState(), arm.getJointState())
    assert np.allclose(copied.getFrameState(), arm.getFrameState()[:4], atol=1e-5)
    assert np.allclose(copied.getJointLimits(), arm.getJointLimits())


def test_names_are_copied_so_that_they_can_be_read_again(config: kg.Config, browser: Browser) -> None:
    names = ["base", "1st", "a(b)", "x:y", "it's", "a-b/c.d", "true"]
    for name in names:
        config.addFrame(name, "" if name == "base" else "base").setShape(kg.ST.marker, [0.1])
    open_page(config, browser)
    copies = []
    for frame in config.getFrames():
        config.viewer().select(frame.ID)
        browser.wait_for(f"kinegraph.selected() === {json.dumps(frame.name)}")
        copies.append(browser.evaluate("kinegraph.asText()"))
    copied = kg.Config()
    copied.addText("\n".join(copies))
    assert copied.getFrameNames() == names


def test_a_button_measures_as_well_and_shows_that_it_is_pressed(arm: kg.Config, browser: Browser) -> None:
    open_page(arm, browser)
    browser.press_alt("O")
    background = "getComputedStyle(document.querySelector('#measure-button')).backgroundColor"
    released = browser.evaluate(background)
    browser.click_button("measure")
    assert browser.is_visible("#measure")
    pressed = browser.evaluate(background)
    browser.press("Escape")
    assert not browser.is_visible("#measure")
    assert browser.evaluate("document.querySelector('#measure-button').ariaPressed") == "false"
    browser.evaluate("document.querySelector('#measure-button').scrollIntoView()")
    browser.mouse("mouseMoved", *browser.evaluate(CENTER_OF_MEASURE))
    hovered = browser.evaluate(background)
    assert len({released, hovered, pressed}) == 3


def test_a_number_beyond_a_limit_is_reported_and_clamped(arm: kg.Config, browser: Browser) -> None:
    open_page(arm, browser)
    browser.press_alt("J")
    limit = arm.getJointLimits()[1, 0]
    browser.evaluate("""((x) => { x.value = 77; x.dispatchEvent(new Event("change")); })(
      document.querySelector("[aria-label='hinge, value']"))""")
    browser.wait_for(f"Math.abs(kinegraph.joints()[0] - {limit}) < 1e-9")
    warning = browser.evaluate("document.querySelector('.joint .warning').textContent")
    assert warning.startswith("77 is beyond the limit")
    assert browser.is_visible(".joint .warning")


def test_two_clicks_measure_the_distance(arm: kg.Config, browser: Browser) -> None:
    open_page(arm, browser)
    browser.press_alt("R")
    for point in ([-0.9, 0.2, 0.1], [-1.1, 0.2, 0.3]):  # on the near side of the box
        browser.click(*browser.pixel(point))
    browser.wait_for("document.querySelector('#measure').textContent.includes(' m ')")
    length = float(browser.evaluate("document.querySelector('#measure').textContent.split(' ')[0]"))
    assert length == pytest.approx(np.hypot(0.2, 0.2), abs=0.01)
    browser.press_alt("R")
    assert not browser.is_visible("#measure")


def test_handles_move_a_frame_with_all_below_it(arm: kg.Config, browser: Browser) -> None:
    open_page(arm, browser)
    arm.viewer().select(arm.getFrame("box").ID)
    browser.wait_for("kinegraph.selected() == 'box' && kinegraph.idle()")
    x, y = browser.pixel([-1, 0, 0.2])
    up = browser.pixel([-1, 0, 0.45])
    handle = (x + 0.8 * (up[0] - x), y + 0.8 * (up[1] - y))  # the arrow along z
    browser.drag(handle, (handle[0], handle[1] - 60))
    browser.wait_for("kinegraph.position('box')[2] > 0.3")
    assert arm.getFrame("box").getPosition()[2] == 0.2
    arm.view()
    assert arm.getFrame("box").getPosition()[2] > 0.25
    deadline = time.monotonic() + 60
    while True:  # the last steps of the drag may still be on their way
        arm.view()
        x, y, height = arm.getFrame("box").getPosition()
        if abs(browser.evaluate("kinegraph.position('box')[2]") - height) < 1e-5 or time.monotonic() > deadline:
            break
    assert [x, y] == pytest.approx([-1, 0], abs=1e-5)
    assert browser.evaluate("kinegraph.position('the mug')[2]") == pytest.approx(height + 0.25, abs=1e-5)
    assert arm.getFrame("the mug").getPosition()[2] == pytest.approx(height + 0.25, abs=1e-5)


def test_wireframe_and_x_ray_change_what_is_seen(arm: kg.Config, browser: Browser) -> None:
    open_page(arm, browser)
    x, y = (round(value) for value in browser.pixel([-1, 0.2, 0.2]))
    region = np.s_[y - 20 : y + 20, x - 20 : x + 20]
    solid = browser.picture()[region].astype(int)
    for letter in "WX":
        browser.press_alt(letter)
        browser.wait_for("kinegraph.idle()")
        assert np.abs(browser.picture()[region].astype(int) - solid).max() > 20
        browser.press_alt(letter)
        browser.wait_for("kinegraph.idle()")
        assert np.abs(browser.picture()[region].astype(int) - solid).max() < 8


def test_the_arm_follows_a_target_that_is_dragged(browser: Browser, start: Callable[..., KinematicModel]) -> None:
    program = start("""
C = kg.Config()
C.addFile(kg.raiPath('scenarios/pandaSingle.g'))
C.view()
C.viewer().setCamera([0, 2.5, 1.2], [0, 0, 1.2])
C.viewer().waitForClient(60)
kg.interactiveIk(C, 'l_gripper')
print('gripper', *C.getFrame('l_gripper').getPosition())
print('target', *C.getFrame('ik_target').getPosition())
""")
    browser.open(program.url())
    browser.wait_for("kinegraph.selected() == 'ik_target' && kinegraph.message().includes('drag the target')")
    z = browser.evaluate("kinegraph.position('ik_target')")[2]
    handle = browser.upper_handle("ik_target")
    browser.drag(handle, (handle[0], handle[1] - 15))
    browser.wait_for(f"kinegraph.position('ik_target')[2] > {z} + 0.02")
    browser.wait_for("""((a, b) => Math.hypot(...a.map((x, i) => x - b[i])) < 2e-3)
      (kinegraph.position('l_gripper'), kinegraph.position('ik_target'))""")
    browser.wait_for("kinegraph.message().startsWith('l_gripper: 0.')")
    browser.drag((handle[0], handle[1] - 15), (handle[0], handle[1] - 400))  # out of reach
    browser.wait_for("parseFloat(kinegraph.message().split(': ')[1]) > 50")
    browser.press("q")
    gripper, target = (np.array(program.line(name).split(), float) for name in ("gripper", "target"))
    assert target[2] > gripper[2] + 0.05


def test_interactive_ik_goes_to_the_target_once_where_nobody_can_drag(config: kg.Config) -> None:
    config.addFile(kg.raiPath("scenarios/pandaSingle.g"))
    config.addFrame("there").setPosition([0.3, 0.3, 1.0])
    q = kg.interactiveIk(config, "l_gripper", "there")
    assert np.array_equal(q, config.getJointState())
    assert config.getFrame("l_gripper").getPosition() == pytest.approx([0.3, 0.3, 1.0], abs=1e-3)


def test_edits_are_undone_and_done_again(arm: kg.Config, browser: Browser) -> None:
    open_page(arm, browser)
    browser.press_alt("J")
    set_slider(browser, "slide", 0.5)
    browser.wait_for("Math.abs(kinegraph.position('slide')[0] - 0.5) < 1e-6")
    arm.view()
    assert arm.getJointState()[1] == 0.5
    browser.evaluate("document.activeElement.blur()")
    browser.press("z", code="KeyZ", modifiers=2)
    browser.wait_for("Math.abs(kinegraph.position('slide')[0]) < 1e-6")
    assert arm.view() == 0 and arm.getJointState()[1] == 0
    browser.click_button("redo")
    browser.wait_for("Math.abs(kinegraph.position('slide')[0] - 0.5) < 1e-6")
    arm.view()
    assert arm.getJointState()[1] == 0.5
