"""Recorded runs: whatever a viewer shows and logs, played later."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import kinegraph as kg
from kinegraph.run_player import pageOfRuns

from .browser import Browser

BALL = "ball: { shape: sphere, size: [.1], mass: 1, pose: [0 0 1] }\nfloor: { shape: box, size: [4 4 .1], pose: [0 0 -.05], contact: 1 }"


def open_runs(browser: Browser, folder: Path, *files: str) -> None:
    (folder / "runs.html").write_text(pageOfRuns([str(folder / file) for file in files]))
    if len(files) == 1:
        browser.open((folder / "runs.html").as_uri())
        browser.wait_for("kinegraph.slice() !== null")
    else:
        browser.navigate((folder / "runs.html").as_uri())


def seek(browser: Browser, part: float) -> None:
    browser.evaluate(
        f"(() => {{ const slider = document.querySelector('#motion input[type=range]');"
        f" slider.valueAsNumber = {part} * slider.max; slider.dispatchEvent(new Event('input')); }})()"
    )


def simulate(folder: Path, file: str, height: float = 1.0) -> list[tuple[float, float]]:
    """Records a ball in free fall; returns times and heights."""
    config = kg.Config()
    config.addFrame("base").setPosition([0, 0, 0])
    config.addFrame("ball").setShape(kg.ST.sphere, [0.1]).setMass(1.0).setPosition([0, 0, height])
    simulation = kg.Simulation(config, engine=kg.SimulationEngine.physx, verbose=0)
    viewer, heights = config.viewer(), []
    simulation.view()
    with viewer.record(folder / file):
        for step in range(40):
            simulation.step([], 0.01, kg.ControlMode.none)
            simulation.view()
            z = config.getFrame("ball").getPosition()[2]
            viewer.log("height", z)
            heights.append(((step + 1) * 0.01, z))
            if step == 19:
                viewer.label("half", [0, 0, 1], "half time")
            config.view(False, f"step {step}")
    config.view_close()
    return heights


def test_a_simulation_is_recorded_with_its_times(browser: Browser, tmp_path: Path) -> None:
    heights = simulate(tmp_path, "fall.kgr")
    open_runs(browser, tmp_path, "fall.kgr")
    seconds = browser.evaluate("kinegraph.seconds()")
    assert seconds == pytest.approx(0.4, abs=0.03)
    for part in (0.9, 0.25, 0.6):
        seek(browser, part)
        expected = np.interp(part * seconds, *zip(*heights))
        assert browser.evaluate("kinegraph.position('ball')[2]") == pytest.approx(expected, abs=0.08)
    assert browser.evaluate("kinegraph.drawings()") == ["half"]
    seek(browser, 0.2)
    assert browser.evaluate("kinegraph.drawings()") == []
    assert browser.evaluate("kinegraph.plots()") == {"height": 40}
    step = int(browser.evaluate("kinegraph.message()").split()[1])
    seek(browser, 0.8)
    assert int(browser.evaluate("kinegraph.message()").split()[1]) > step + 10


def test_a_motion_takes_its_time_in_a_recording(config: kg.Config, browser: Browser, tmp_path: Path) -> None:
    config.addFrame("base")
    config.addFrame("one", "base").setJoint(kg.JT.transX, [-3, 3]).setShape(kg.ST.box, [0.2, 0.2, 0.2])
    with config.viewer().record(tmp_path / "plan.kgr"):
        config.view()
        config.view_path(np.linspace([0], [2], 21), 3.0)
        config.setJointState([1.0])
        config.view()
    open_runs(browser, tmp_path, "plan.kgr")
    assert browser.evaluate("kinegraph.seconds()") == pytest.approx(3, abs=0.6)
    seek(browser, 1.5 / browser.evaluate("kinegraph.seconds()"))
    assert browser.evaluate("kinegraph.position('one')[0]") == pytest.approx(1, abs=0.35)
    assert browser.evaluate("document.querySelector('#joint-rows input[type=range]').valueAsNumber") == pytest.approx(
        browser.evaluate("kinegraph.position('one')[0]"), abs=1e-6
    )
    seek(browser, 1)
    assert browser.evaluate("kinegraph.position('one')[0]") == pytest.approx(1, abs=1e-6)


def test_frames_that_come_later_are_there_from_then_on(config: kg.Config, browser: Browser, tmp_path: Path) -> None:
    config.addFrame("first").setShape(kg.ST.box, [0.2, 0.2, 0.2])
    config.view()
    viewer = config.viewer()
    recording = viewer.record(tmp_path / "growing.kgr").start()
    config.addFrame("second").setMesh(np.eye(4, 3), np.array([[0, 1, 2], [0, 2, 3]], np.uint32)).setPosition([1, 2, 3])
    config.view_path(np.zeros((2, 0)), 1.0)
    config.view()
    recording.stop()
    recording.stop()
    open_runs(browser, tmp_path, "growing.kgr")
    seek(browser, 1)
    assert browser.evaluate("kinegraph.position('second')") == [1, 2, 3]
    seek(browser, 0)
    browser.wait_for("kinegraph.frames() === 1")
    seek(browser, 1)
    browser.wait_for("kinegraph.frames() === 2 && kinegraph.meshes() === 1")


def test_two_runs_play_in_step(browser: Browser, tmp_path: Path) -> None:
    simulate(tmp_path, "one.kgr")
    simulate(tmp_path, "other.kgr", height=2.0)
    open_runs(browser, tmp_path, "one.kgr", "other.kgr")
    height = "document.querySelectorAll('iframe')[{}].contentWindow.kinegraph?.position('ball')[2]"
    browser.wait_for(f"{height.format(0)} > 0.9 && {height.format(1)} > 1.9")
    browser.evaluate(
        "(() => { const page = document.querySelectorAll('iframe')[1].contentWindow, slider = page.document.querySelector('#motion input[type=range]');"
        " slider.valueAsNumber = 0.9 * slider.max; slider.dispatchEvent(new page.Event('input')); })()"
    )
    browser.wait_for(f"{height.format(0)} < 0.8 && {height.format(1)} < 1.8")


def test_errors_name_the_file(config: kg.Config, tmp_path: Path) -> None:
    config.addFrame("base")
    with pytest.raises(kg.FileError, match="missing/run.kgr"):
        config.viewer().record(tmp_path / "missing/run.kgr").start()
    recording = config.viewer().record(tmp_path / "run.kgr").start()
    with pytest.raises(kg.ArgumentError, match="already"):
        config.viewer().record(tmp_path / "other.kgr").start()
    recording.stop()
    (tmp_path / "text.kgr").write_text("no run")
    with pytest.raises(kg.ArgumentError, match=r"text.kgr: .*not a recorded run"):
        pageOfRuns([str(tmp_path / "text.kgr")])


def test_the_command_writes_a_page(config: kg.Config, tmp_path: Path, capsys: pytest.CaptureFixture) -> None:
    from kinegraph.cli import main

    config.addFrame("base")
    with config.viewer().record(tmp_path / "run.kgr"):
        config.view()
    assert main(["view", str(tmp_path / "run.kgr"), "--html", str(tmp_path / "run.html")]) == 0
    assert "<!doctype html>" in (tmp_path / "run.html").read_text()[:20]
    assert main(["view", str(tmp_path / "none.kgr"), "--html", str(tmp_path / "none.html")]) == 1
    assert "none.kgr" in capsys.readouterr().err
