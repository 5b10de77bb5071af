"""view() and watchFile() without a browser: they do not wait without a user, and Ctrl-C ends them otherwise."""

import os
import signal
import subprocess
import sys
import time

import numpy as np
import pytest
from websockets.sync.client import connect

import kinegraph as ry

PROGRAM = """
import kinegraph as ry
C = ry.Config()
C.addFile(ry.raiPath('scenarios/pandaSingle.g'))
print('READY', C.viewer().url, flush=True)
try:
    key = {call}
    print('KEY', key, flush=True)
except KeyboardInterrupt:
    print('INTERRUPTED', C.getJointDimension(), flush=True)
"""


class Viewing:
    """A program that has a page open; it ends with the block."""

    def __init__(self, call):
        environment = {
            name: value
            for name, value in os.environ.items()
            if name not in ("KINEGRAPH_HEADLESS", "DISPLAY", "WAYLAND_DISPLAY", "SSH_CONNECTION")
        }
        self.program = subprocess.Popen(
            [sys.executable, "-c", PROGRAM.replace("{call}", call)],
            env=environment,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
        )
        self.url = self.line("READY").split()[1]

    def line(self, start):
        for line in self.program.stdout:
            if line.startswith(start):
                return line
        raise AssertionError(self.program.communicate()[1])

    def connect(self):
        return connect(self.url.replace("http", "ws").rstrip("/") + "/ws", max_size=None, origin=self.url.rstrip("/"))

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.program.kill()
        self.program.communicate()


def test_nothing_waits_without_a_display():
    C = ry.Config()
    C.addFrame("a").setShape("box", [1, 1, 1])
    started = time.monotonic()
    assert C.view(True, "press a key") == 0
    C.watchFile(ry.raiPath("panda/panda.g"))
    C.view_close()
    assert time.monotonic() - started < 20


def test_without_a_gui_nothing_opens_and_views_return_escape(monkeypatch):
    monkeypatch.setattr("kinegraph.compatibility.parameters._values", {"disableGui": True})
    monkeypatch.setenv("KINEGRAPH_HEADLESS", "0")
    C = ry.Config()
    C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
    komo = ry.KOMO(C, 1, 2, 1, False)
    assert C.view(True, "press a key") == 27 and C.view() == 0
    assert C.viewer().view(True) == 27
    assert C.view_path([C.getJointState()], pause=True) == 27
    assert komo.view(True) == komo.view_play(True) == komo.view_slice(0, True) == 27
    assert ry.ImageViewer().view(np.zeros((4, 4), np.uint8), wait=True) == 27
    C.animate()
    C.animateSpline()
    C.viewer().setQuad(-1, np.zeros((4, 4), np.uint8), 0, 0, 0.1)
    C.viewer().visualsOnly()
    C.viewer().setCamera([1, 1, 1], [0, 0, 0])
    D = ry.Config()
    D.watchFile(ry.raiPath("panda/panda.g"))
    assert D.getJointDimension() == 7
    for config in (C, D, komo):
        assert not config.get_viewer().isOpen()


def test_without_interactivity_pages_are_shown_and_nothing_waits(monkeypatch, tmp_path):
    monkeypatch.setattr("kinegraph.compatibility.parameters._values", {"noInteractivity": True})
    monkeypatch.setenv("KINEGRAPH_HEADLESS", "0")
    for name in ("DISPLAY", "WAYLAND_DISPLAY"):
        monkeypatch.delenv(name, raising=False)
    (tmp_path / "scene.g").write_text("a: {}")
    C = ry.Config()
    started = time.monotonic()
    C.watchFile(tmp_path / "scene.g")
    with connect(C.viewer().url.replace("http", "ws"), max_size=None):
        assert C.viewer().waitForClient(20)
        assert C.view(True, "press a key") == 0
        C.animateSpline(100)
    assert C.viewer().isOpen() and C.getFrameNames() == ["a"]
    C.view_close()
    assert time.monotonic() - started < 20


def test_a_forked_process_leaves_the_viewer_alone_and_has_its_own():
    program = """
import os, sys
import kinegraph as ry
C = ry.Config()
C.addFrame('a').setShape('box', [1, 1, 1])
C.view()
url = C.viewer().url
child = os.fork()
if child == 0:
    C.view(True)
    print('other', C.viewer().url != url, flush=True)
    del C
    sys.exit(0)
status = os.waitpid(child, 0)[1]
from websockets.sync.client import connect
with connect(url.replace('http', 'ws'), max_size=None) as page:
    received = [page.recv(20), page.recv(20)]
    C.getFrame('a').setPosition([1, 2, 3])
    C.view()
    moved = page.recv(20)
print('status', status, C.viewer().url == url, bool(moved))
"""
    environment = {**os.environ, "KINEGRAPH_HEADLESS": "1"}
    run = [sys.executable, "-W", "ignore::DeprecationWarning", "-c", program]
    done = subprocess.run(run, env=environment, capture_output=True, text=True, timeout=60)
    assert done.returncode == 0, done.stderr
    assert "other True" in done.stdout and "status 0 True True" in done.stdout, done.stdout


def test_what_cannot_be_shown_is_an_error_that_says_why():
    C = ry.Config()
    C.addFrame("one")
    for frame in (-1, 1):
        with pytest.raises(ry.ArgumentError, match=f"no frame has the ID {frame}; expected 0 to 0"):
            C.viewer().select(frame)
    with pytest.raises(ry.ArgumentError, match=r"shape \(3, 5, 4\); expected \(height, width, 3\)"):
        ry.ImageViewer().view(np.zeros((3, 5, 4), np.uint8))


def test_two_viewers_take_two_ports():
    one, two = ry.Config(), ry.Config()
    one.view()
    two.view()
    assert one.viewer().url != two.viewer().url


def test_a_configuration_can_be_shown_in_anothers_viewer():
    one, two = ry.Config(), ry.Config()
    two.set_viewer(one.get_viewer())
    assert one.viewer().url == two.viewer().url


WAITING = [
    "C.view(True)",
    "C.viewer().view(True)",
    "C.view_path([C.getJointState()] * 9, 60, True)",
    "C.watchFile(ry.raiPath('scenarios/pandaSingle.g'))",
    "ry.interactiveIk(C, 'l_gripper')",
]


@pytest.mark.parametrize("call", WAITING)
def test_ctrl_c_ends_the_waiting(call):
    waiting = "C.view(), C.viewer().waitForClient(60), print('WAITING', flush=True)"
    with Viewing(f"({waiting}, {call})") as viewing, viewing.connect():
        viewing.line("WAITING")
        time.sleep(0.3)
        assert viewing.program.poll() is None
        viewing.program.send_signal(signal.SIGINT)
        assert viewing.line("INTERRUPTED") == "INTERRUPTED 7\n"
        assert viewing.program.wait(20) == 0


def test_ctrl_c_ends_the_waiting_for_a_browser():
    with Viewing("(C.view(), print('WAITING', flush=True), C.viewer().waitForClient(60))") as viewing:
        viewing.line("WAITING")
        time.sleep(0.3)
        viewing.program.send_signal(signal.SIGINT)
        assert viewing.line("INTERRUPTED") == "INTERRUPTED 7\n"
        assert viewing.program.wait(20) == 0
