"""RosBridge against others: rclpy of another distribution, and Cyclone DDS without ROS, in processes of their own."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest

pytest.importorskip("rclpy", reason="needs ROS 2; make test-ros installs its wheels")

from ros_client import Client, move, scene

import kinegraph as ry
from kinegraph.ros import RosBridge

pytestmark = pytest.mark.filterwarnings("ignore::DeprecationWarning")  # of packages of ROS
HERE = Path(__file__).parent
BUILD = Path(os.environ.get("KINEGRAPH_ROS_PEERS", HERE.parent.parent / "build"))


@pytest.fixture(autouse=True)
def only_this_machine(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST")


@pytest.fixture
def robot() -> Iterator[tuple[ry.Config, ry.BotOp]]:
    C = scene()
    bot = ry.BotOp(C, driver=ry.KinematicDriver(C), realtime=True)
    with RosBridge(bot):
        yield C, bot
    bot.close()


def others(environment: str, script: str, *arguments: str) -> dict:
    python = BUILD / environment / "bin" / "python"
    if not python.exists():
        pytest.skip(f"needs {python}; make test-ros makes it")
    clean = {k: v for k, v in os.environ.items() if k not in ("PYTHONPATH", "LD_LIBRARY_PATH", "AMENT_PREFIX_PATH")}
    clean.pop("_ROS_WHEELS_BOOTSTRAP_COMPLETE", None)
    run = subprocess.run(
        [python, HERE / script, *arguments], stdout=subprocess.PIPE, timeout=90, check=True, text=True, env=clean
    )
    return json.loads(run.stdout.splitlines()[-1])


def test_another_distribution_sees_and_moves_the_robot(robot: tuple[ry.Config, ry.BotOp]) -> None:
    _, bot = robot
    seen = others("ros_jazzy", "peer_rclpy.py", "0.2", "2.0")
    assert seen["urdf"] and seen["states"] > 100
    np.testing.assert_allclose(seen["q"], seen["goal"], atol=1e-9)
    np.testing.assert_allclose(bot.get_q(), seen["goal"], atol=1e-9)


def test_a_reader_of_another_dds_sees_the_robot(robot: tuple[ry.Config, ry.BotOp]) -> None:
    C, bot = robot
    seen = others("ros_dds", "peer_dds.py", "2.0")
    assert seen["urdf"] and seen["states"] > 100
    assert seen["names"][:7] == C.getJointNames()
    np.testing.assert_allclose(seen["q"][:7], bot.get_q(), atol=1e-12)


CLIENT = """
import sys
sys.path.insert(0, sys.argv[1])
from ros_client import *
client = Client()
client.send(trajectory(list(client.states[-1].name)[:7], [3.0], [[float(x) for x in sys.argv[2:]]]))
print("sent", flush=True)
time.sleep(60)
"""


def test_the_robot_survives_the_death_of_a_client(robot: tuple[ry.Config, ry.BotOp]) -> None:
    C, bot = robot
    goal = bot.get_q() + 0.3 * np.eye(7)[0]
    with subprocess.Popen(
        [sys.executable, "-c", CLIENT, str(HERE), *map(repr, goal.tolist())], stdout=subprocess.PIPE, text=True
    ) as process:
        assert process.stdout is not None and process.stdout.readline() == "sent\n"
        process.send_signal(signal.SIGKILL)
    end = time.monotonic() + 10
    while np.abs(bot.get_q() - goal).max() > 1e-9:  # the accepted goal is reached
        assert time.monotonic() < end
        time.sleep(0.05)
    client = Client()
    assert client.result(client.send(move(bot, C, -0.1, 1.0)))[1:] == (0, "")
    client.close()
