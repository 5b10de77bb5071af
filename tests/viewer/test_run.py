"""A simulation on the page: its display and its controls."""

from __future__ import annotations

import time
from collections.abc import Callable

import numpy as np
import pytest

import kinegraph as kg

from .browser import Browser
from .program import KinematicModel

SCENE = """
import numpy as np
C = kg.Config()
C.addFrame('table').setShape(kg.ST.box, [2., 2., .1]).setPosition([0, 0, .45]).setColor([.7, .7, .7])
box = C.addFrame('box').setShape(kg.ST.box, [.3, .3, .3]).setPosition([0, 0, .65]).setMass(2.).setColor([1, .2, .2])
C.viewer().setCamera([0, 3, 1.2], [0, 0, .6])
"""
WATCHED = (
    SCENE
    + """
S = kg.Simulation(C)
S.view()
C.viewer().waitForClient(60)
"""
)
TIME = "parseFloat(document.querySelector('.run-time').textContent)"
PAUSED = "kinegraph.run().paused"


def show(config: kg.Config) -> kg.Simulation:
    scope = {"kg": kg, "C": config}
    exec(SCENE.replace("C = kg.Config()", ""), scope)
    return kg.Simulation(config)


def test_time_contacts_and_forces_are_shown_with_each_step(config: kg.Config, browser: Browser) -> None:
    S = show(config)
    S.view()
    browser.open(config.viewer().url)
    for _ in range(50):
        S.step()
    browser.wait_for(f"{TIME} === 0.5")  # the last step, also if many are taken at once
    arrows = sum("box" in contact["frames"] for contact in S.getContacts())
    assert arrows >= 4
    browser.wait_for(f"kinegraph.run().arrows === {arrows}")
    assert "N" in browser.evaluate("document.querySelector('.run-scale').textContent")
    picture = browser.picture().astype(int)
    assert np.sum((picture[..., 0] > 180) & (picture[..., 1] < 80) & (picture[..., 2] > 80)) > 100  # arrows
    config.viewer().setCamera([0, 0.4, 0.6], [0, 0.15, 0.5])  # near one of them
    browser.wait_for("document.querySelector('.run-scale').textContent.includes('1 cm of arrow')")
    near = browser.picture().astype(int)
    pink = (near[..., 0] > 180) & (near[..., 1] < 80) & (near[..., 2] > 80)
    assert 100 < pink.sum() < 0.02 * pink.size  # no thicker than from afar
    del S
    browser.wait_for("kinegraph.run() === null")
    assert not browser.is_visible("#run")


def test_a_simulation_is_paused_stepped_let_go_on_and_reset(
    browser: Browser, start: Callable[..., KinematicModel]
) -> None:
    program = start(
        WATCHED
        + """
box.setPosition([0, 0, 2.])
S.pushConfigToSim()
print('steps')
while C.viewer().takeKey() != ord('q'):
    S.step()
print('end', S.get_t() < 1e9)
"""
    )
    browser.open_page(program.url())  # which never rests
    program.line("steps")
    browser.wait_for(f"kinegraph.run() && {TIME} > 0.3")
    browser.evaluate("document.querySelector('#run .play').click()")
    browser.wait_for(PAUSED)
    browser.wait_for("kinegraph.idle()")
    at = browser.evaluate(TIME)
    browser.click_button("step")
    browser.wait_for(f"Math.abs({TIME} - {at} - 0.01) < 1e-6")
    browser.click_button("step")
    browser.wait_for(f"Math.abs({TIME} - {at} - 0.02) < 1e-6")
    assert browser.evaluate(PAUSED)
    assert browser.evaluate("kinegraph.position('box')[2]") < 1
    browser.click_button("reset")
    browser.wait_for(f"{TIME} === 0")
    browser.wait_for("Math.abs(kinegraph.position('box')[2] - 0.65) < 1e-3")  # its place when it was first shown
    assert browser.evaluate(PAUSED)
    browser.press_alt("K")
    browser.wait_for(f"!{PAUSED} && {TIME} > 0.3")
    browser.press("q")
    assert program.line("end") == "True"
    assert program.end() == 0


def test_a_body_is_perturbed_by_the_mouse_and_the_force_is_shown(
    browser: Browser, start: Callable[..., KinematicModel]
) -> None:
    program = start(
        WATCHED
        + """
S.startRecording()
S.run(tau=.01)
recording = S.stopRecording()
again = recording.replay(recording.makeConfig())
print('same', again.getState() == S.getState())
print('highest', recording.freePos[:, 0, 2].max())
"""
    )
    browser.open_page(program.url())  # which never rests
    browser.wait_for(f"kinegraph.run() && {TIME} > 0.1")
    browser.click_button("perturb")
    x, y = browser.pixel([0, 0.15, 0.65])
    browser.mouse("mouseMoved", x, y)
    browser.mouse("mousePressed", x, y, button="left")
    for i in range(1, 9):
        browser.mouse("mouseMoved", x, y - 14 * i, button="left", buttons=1)
    browser.wait_for("kinegraph.position('box')[2] > 0.75")
    force = browser.evaluate("document.querySelector('.force').textContent")
    assert 10 < float(force.split()[0]) < 400, force
    camera = browser.evaluate("kinegraph.camera()")
    assert camera == pytest.approx([0, 3, 1.2])  # the drag has not turned the view
    browser.mouse("mouseReleased", x, y - 80, button="left")
    browser.wait_for("kinegraph.position('box')[2] < 0.66")
    browser.press("q")
    assert program.line("same") == "True"
    assert float(program.line("highest")) > 0.75
    assert program.end() == 0


def test_what_is_moved_on_the_page_is_there_in_the_next_step(config: kg.Config, browser: Browser) -> None:
    config.addFrame("base").setPosition([0, 0, 2])
    config.addFrame("arm", "base").setJoint(kg.JT.hingeZ, [-2, 2]).setShape(kg.ST.box, [0.1, 0.1, 0.1]).setMass(1.0)
    S = show(config)
    S.view()
    browser.open(config.viewer().url)
    S.step()
    slider = "document.querySelector('input[type=range][aria-label=\"arm\"]')"
    browser.wait_for(f"{slider} !== null")
    browser.evaluate(f"{slider}.value = 1.25; {slider}.dispatchEvent(new Event('input'))")
    for _ in range(100):
        if config.viewer().hasEdits():
            break
        browser.wait_for("kinegraph.idle()")
    S.step()
    assert S.get_q() == pytest.approx([1.25], abs=1e-6)
    assert S.get_t() == pytest.approx(0.02)


def test_ctrl_c_ends_a_paused_simulation_before_its_step(
    browser: Browser, start: Callable[..., KinematicModel]
) -> None:
    program = start(
        WATCHED
        + """
try:
    print('runs')
    while True:
        S.step()
except KeyboardInterrupt:
    print('stopped', round(S.get_t() / .01, 6) == round(S.get_t() / .01))
"""
    )
    browser.open_page(program.url())  # which never rests
    program.line("runs")
    browser.wait_for(f"kinegraph.run() && {TIME} > 0")
    browser.press_alt("K")
    browser.wait_for(PAUSED)
    program.interrupt()
    assert program.line("stopped") == "True"
    assert program.end() == 0


def test_a_run_keeps_real_time_while_somebody_watches_and_gives_the_same_bits(
    config: kg.Config, browser: Browser
) -> None:
    S = show(config)
    S.view()
    browser.open(config.viewer().url)
    begin = time.monotonic()
    assert S.run(0.5) == 0
    assert time.monotonic() - begin > 0.45
    begin = time.monotonic()
    S.run(0.5, speed=4)
    assert time.monotonic() - begin > 0.1
    alone = show(kg.Config())
    for _ in range(100):
        alone.step([], 0.01, kg.ControlMode.spline)
    assert alone.getState() == S.getState()


def test_the_contacts_of_a_robot_are_shown_without_buttons(config: kg.Config, browser: Browser) -> None:
    show(config)
    config.addFrame("post").setPosition([1, 0, 0.5])
    config.addFrame("arm", "post").setJoint(kg.JT.hingeZ).setMass(1.0)
    config.view()
    browser.open(config.viewer().url)
    bot = kg.BotOp(config)
    bot.sync(config, 0.3)
    arrows = len(bot.getContacts())
    assert arrows >= 4
    browser.wait_for(f"kinegraph.run()?.arrows === {arrows}")
    visible = "[...document.querySelectorAll('#run button, #run output')].filter((e) => e.offsetParent).map((e) => e.textContent)"
    shown = browser.evaluate(visible)
    assert len(shown) == 1 and "of arrow" in shown[0]
    bot.close()
    browser.wait_for("kinegraph.run() === null")
