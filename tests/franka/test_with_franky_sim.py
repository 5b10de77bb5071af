"""FrankaDriver against the simulator franky-sim, which has the protocol of an FR3. `make test-franka` runs this test.

The simulator falls behind on a busy machine, and its arm follows commands about 100 ms late, for any client. So the
control time follows the clock of the simulated robot here, and the test compares what the driver sends.
"""

from __future__ import annotations

import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest

pytest.importorskip("pylibfranka", reason="needs pylibfranka and franky-sim; make test-franka installs them")

import kinegraph as ry
from kinegraph.robots import FrankaDriver

HOST, PERIOD = "127.0.0.1", 0.01
RISE = np.array([0.3, 0, 0, 0.2, 0, 0, 0.4])


@pytest.fixture
def simulator() -> Iterator[subprocess.Popen]:
    command = [str(Path(sys.executable).parent / "franky-sim"), "-s", "mujoco", "--hostname", HOST]
    with subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as process:
        time.sleep(8)
        yield process
        process.kill()


def connected(hand: bool = False) -> tuple[ry.Config, FrankaDriver]:
    C = ry.Config()
    C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
    return C, FrankaDriver(C, HOST, hand=hand, realtime=False)


def test_a_plan_is_sent_within_two_milliradians(simulator: subprocess.Popen) -> None:
    C, driver = connected()
    bot = ry.BotOp(C, driver=driver)
    start = bot.stepObservation().qpos
    limits = {"velocity": [1.0] * 7, "acceleration": [4.0] * 7, "jerk": [400.0] * 7}
    plan = ry.planMotion(C, start + RISE, start=start, **limits)
    rows: list[tuple[float, ...]] = []
    setpoints = driver._setpoints
    assert setpoints is not None
    advance = setpoints.advance

    def logged(dt: float) -> list[float]:
        q = advance(dt)
        rows.append((setpoints._clock, *q))
        return q

    setpoints.advance = logged  # type: ignore[method-assign]
    began, cycles = driver.read().time, driver.cycles
    bot.follow(plan)
    for k in range(1, round(plan.duration / PERIOD) + 60):
        while driver.read().time < began + k * PERIOD:
            time.sleep(0.0002)
        bot.sync(C, PERIOD)
    sent = np.array(rows)
    times, q = sent[:, 0] - sent[0, 0], sent[:, 1:]
    apart = {d: np.abs(q - plan.eval(np.maximum(times - d, 0.0))[0]).max() for d in np.arange(0, 0.06, 5e-4)}
    delay = min(apart, key=lambda d: apart[d])
    print(f"sent: {1e3 * apart[delay]:.2f} mrad apart, {1e3 * delay:.1f} ms late; {len(rows)} cycles")
    assert apart[delay] < 2e-3 and delay < 0.04
    assert driver.late_cycles <= 0.01 * (driver.cycles - cycles) and bot.getFault() == ""
    rates = np.diff(q, axis=0) / 1e-3
    assert np.abs(rates).max() < 1.1
    assert np.abs(bot.stepObservation().qpos - start - RISE).max() < 5e-3  # the simulated arm
    bot.close()


def test_the_end_of_the_connection_is_a_fault_and_recovery_needs_the_robot(simulator: subprocess.Popen) -> None:
    C, driver = connected()
    bot = ry.BotOp(C, True, driver=driver)
    bot.sync(C, 0.3)
    simulator.send_signal(signal.SIGKILL)
    with pytest.raises(ry.RobotFault):
        bot.sync(C, 5.0)
        bot.sync(C, 5.0)
    assert bot.getFault() != ""
    bot.close()


def test_an_arm_that_does_not_answer_is_named() -> None:
    C, driver = connected()
    with pytest.raises(ry.RobotFault, match=r"no connection to an FR3 at 127\.0\.0\.1 with pylibfranka"):
        ry.BotOp(C, True, driver=driver)
