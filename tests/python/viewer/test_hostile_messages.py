"""Hostile and damaged messages of browsers end nothing, move nothing beyond its limits, and do not fill the memory.

The messages are those of viewer/messages.json with hostile values, mutations of them, and noise. The suite sends few;
KINEGRAPH_MESSAGES=10000 sends as many to each program.
"""

from __future__ import annotations

import contextlib
import json
import os
import random
import resource
import struct
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from websockets.exceptions import ConnectionClosed
from websockets.sync.client import ClientConnection, connect

import kinegraph as ry

COUNT = int(os.environ.get("KINEGRAPH_MESSAGES", "400"))
SCHEMA = json.loads((Path(__file__).parents[3] / "viewer" / "messages.json").read_text())["commands"]
KINDS = {name: number for number, name in enumerate(SCHEMA, 1)}
INTEGERS = [0, 1, 2, 3, 7, -1, -(2**31), 2**31 - 1, 255, 65536, 1000]
NUMBERS = [
    0.0,
    1.0,
    -1.0,
    0.3,
    1e-300,
    1e3,
    -1e5,
    1e6,
    1.1e6,
    1e9,
    1e200,
    -1e308,
    float("nan"),
    float("inf"),
    -float("inf"),
]
LENGTHS = [0, 1, 2, 3, 4, 6, 7, 8, 300]
TEXTS = [b"", b"grasp", b"\xff\xfe", b"\x00" * 20, "\u202e\U0001f916".encode(), b"x" * 5000, b"<script>", b'{"a": 1}']
GROWTH = 60e6  # bytes of memory that the second half of the messages may add


class Browser:
    """A hostile browser: it reads nothing but what tells it the present structure of the scene."""

    def __init__(self, url: str, chance: random.Random) -> None:
        self.url, self.chance = url, chance
        self.structure = 1
        self.connections = contextlib.ExitStack()
        self.socket = self.open()

    def open(self) -> ClientConnection:
        self.connections.close()
        return self.connections.enter_context(connect(self.url.replace("http", "ws"), max_size=None, max_queue=None))

    def close(self) -> None:
        self.connections.close()

    def learn(self) -> None:
        """Reads what has come, so that the messages to come can be about the present scene."""
        with contextlib.suppress(TimeoutError, ConnectionClosed):
            while True:
                message = self.socket.recv(timeout=0.02)
                if isinstance(message, str) and '"structure"' in message:
                    self.structure = json.loads(message).get("structure", self.structure)

    def field(self, kind: str, name: str) -> bytes:
        chance = self.chance
        if name == "structure":
            return struct.pack("<i", self.structure if chance.random() < 0.9 else chance.choice(INTEGERS))
        if kind == "int":
            return struct.pack("<i", chance.randrange(0, 30) if chance.random() < 0.7 else chance.choice(INTEGERS))
        if kind == "number":
            return struct.pack("<d", chance.choice(NUMBERS) if chance.random() < 0.5 else chance.uniform(-4, 4))
        if kind == "number[]":
            usual = {"pose": 7}.get(name, 3)
            length = usual if chance.random() < 0.8 else chance.choice(LENGTHS)
            wild = chance.random() < 0.4
            numbers = [chance.choice(NUMBERS[:12]) if wild else chance.uniform(-2, 2) for _ in range(length)]
            return struct.pack(f"<i{length}d", length, *numbers)
        text = chance.choice(TEXTS)
        return struct.pack("<i", len(text)) + text

    def command(self) -> bytes:
        name = self.chance.choice(list(SCHEMA))
        fields = (self.field(kind, field) for field, kind in SCHEMA[name].items())
        return struct.pack("<i", KINDS[name]) + b"".join(fields)

    def message(self) -> bytes | str:
        chance = self.chance
        kind = chance.random()
        if kind < 0.55:
            return self.command()
        if kind < 0.85:  # a damaged command
            data = bytearray(self.command())
            for _ in range(chance.randrange(1, 4)):
                at = chance.randrange(len(data) + 1)
                data[at : at + chance.choice([0, 1, 4])] = chance.randbytes(chance.choice([0, 1, 4]))
            return bytes(data)
        if kind < 0.95:
            return chance.randbytes(chance.choice([0, 1, 4, 12, 200, 2000]))
        if kind < 0.99:
            return json.dumps(
                {chance.choice(["kind", "structure", "a"]): chance.choice([None, "scene", [1, {}], 1e300])}
            )
        return b"\x05\0\0\0" * chance.choice([4000, 30000])  # more than the server takes ends the connection

    def send(self, messages: list[bytes | str]) -> None:
        for message in messages:
            try:
                self.socket.send(message)
            except ConnectionClosed:
                self.socket = self.open()
                self.learn()


def memory() -> float:
    """Returns the memory of this process, bytes."""
    pages = int(Path("/proc/self/statm").read_text().split()[1])
    return float(pages * resource.getpagesize())


def attack(url: str, go_on: Callable[[], None], seed: int, count: int = COUNT) -> None:
    """Sends the messages through three connections, in lots of other order than they were made, while the program goes
    on."""
    chance = random.Random(seed)
    browsers = [Browser(url, chance) for _ in range(3)]
    used = [0.0, 0.0]
    lots = max(2, count // 50)
    for lot in range(lots):
        go_on()
        for browser in browsers:
            browser.learn()
        messages = [chance.choice(browsers).message() for _ in range(count // lots)]
        chance.shuffle(messages)
        chance.choice(browsers).send(messages)
        for _ in range(3):
            go_on()
        used[2 * lot // lots] = memory()
    assert used[1] < used[0] + GROWTH
    time.sleep(0.2)
    go_on()
    for browser in browsers:
        browser.close()


@contextlib.contextmanager
def honest(url: str, structure: int) -> Iterator[Callable[..., None]]:
    """Yields a function that sends a command with these fields."""
    with connect(url.replace("http", "ws"), max_size=None, max_queue=None) as socket:

        def send(name: str, *values: Any) -> None:
            kinds = {"int": "i", "number": "d"}
            layout = "<i" + "".join(kinds[kind] for kind in SCHEMA[name].values())
            socket.send(struct.pack(layout, KINDS[name], *values))

        yield send


def structure_of(url: str) -> int:
    browser = Browser(url, random.Random(0))
    browser.learn()
    browser.close()
    return browser.structure


def check(C: ry.Config, excess: float = 1e-6) -> None:
    """Joints are within their limits, and everything is somewhere."""
    q, limits = C.getJointState(), C.getJointLimits()
    assert np.isfinite(C.getFrameState()).all() and np.isfinite(q).all()
    lower, upper = np.asarray(limits)
    bounded = lower < upper
    assert (q[bounded] > lower[bounded] - excess).all() and (q[bounded] < upper[bounded] + excess).all()


def panda() -> ry.Config:
    C = ry.Config()
    C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
    return C


@pytest.fixture
def config() -> Iterator[ry.Config]:
    C = panda()
    yield C
    C.view_close()


def test_a_configuration_withstands_hostile_messages(config: ry.Config) -> None:
    viewer = config.viewer()
    config.view()
    viewer.slider("width", 0, 1, 0.5)
    viewer.button("go").onClick(lambda: None)
    viewer.setupEventHandler(False)

    def go_on() -> None:
        config.view()
        check(config)
        viewer.takeKey()
        viewer.getRgb()

    attack(viewer.url, go_on, 1)
    structure = structure_of(viewer.url)
    with honest(viewer.url, structure) as send:
        send("SetJointCommand", structure, 0, 0.25)
        end = time.monotonic() + 20
        while config.getJointState()[0] != pytest.approx(0.25) and time.monotonic() < end:
            time.sleep(0.01)
            config.view()
    assert config.getJointState()[0] == pytest.approx(0.25)


def test_a_simulation_withstands_hostile_messages() -> None:
    C = panda()
    for i in range(3):
        box = C.addFrame(f"box{i}").setShape(ry.ST.box, [0.07, 0.07, 0.07]).setPosition([0.1 * i, 0.4, 0.7])
        box.setMass(0.2).setContact(1)
    C.addFrame("ball").setShape(ry.ST.sphere, [0.04]).setPosition([-0.3, 0.3, 0.8]).setMass(0.02).setContact(1)
    S = ry.Simulation(C)
    S.view()

    def go_on() -> None:
        for _ in range(5):
            S.step()
        check(C, 0.05)  # limits of a simulation are springs, and hostile users pull

    attack(C.viewer().url, go_on, 2)
    before = S.get_t()
    S.step()
    assert S.get_t() > before
    C.view_close()


def test_a_motion_problem_withstands_hostile_messages(config: ry.Config) -> None:
    komo = ry.KOMO(config, 1, 10, 2, False)
    komo.addControlObjective([], 2, 1e-1)
    komo.addObjective([1.0], ry.FS.position, ["l_gripper"], ry.OT.eq, [1e1], [0.3, 0.3, 1.0])
    assert ry.NLP_Solver(komo.nlp(), verbose=0).solve().feasible
    path = komo.getPath()
    komo.view(False)
    attack(komo.get_viewer().url, lambda: komo.view(False) and None, 3)
    np.testing.assert_array_equal(komo.getPath(), path)
    komo.view_close()


def test_a_robot_withstands_hostile_messages(config: ry.Config) -> None:
    bot = ry.BotOp(config, False)
    home = config.getJointState()

    def go_on() -> None:
        bot.sync(config, 0.01)
        check(config)

    go_on()
    attack(config.viewer().url, go_on, 4)
    bot.moveTo(home)
    end = time.monotonic() + 60
    while bot.getTimeToEnd() > 0 and time.monotonic() < end:
        bot.sync(config, 0.05)
    assert np.abs(bot.get_q() - home).max() < 0.05
