"""A Firefox on a virtual display, driven through WebDriver BiDi. Without a display, it has no WebGL."""

from __future__ import annotations

import json
import math
import os
import re
import shutil
import subprocess
import tempfile
import time
from contextlib import ExitStack
from pathlib import Path
from typing import Any

from websockets.sync.client import connect

from .browser import Browser
from .camera import HEIGHT, WIDTH

NAMES = ("firefox", "firefox-esr")
DISPLAY = ["Xvfb", "-screen", "0", "1280x1024x24", "-nolisten", "tcp", "-displayfd"]
SETTINGS = {
    "app.update.enabled": False,
    "browser.shell.checkDefaultBrowser": False,
    "datareporting.policy.dataSubmissionEnabled": False,
    "layout.css.prefers-color-scheme.content-override": 1,  # light
    "network.captive-portal-service.enabled": False,
    "network.connectivity-service.enabled": False,
    "toolkit.telemetry.enabled": False,
    "ui.key.menuAccessKeyFocuses": False,  # Alt belongs to the page
    "webgl.force-enabled": True,  # without a graphics card, too
}
KEYS = {"Enter": "\ue007", "Shift": "\ue008", "Escape": "\ue00c", "End": "\ue010", "Home": "\ue011"}
KEYS |= {"ArrowLeft": "\ue012", "ArrowUp": "\ue013", "ArrowRight": "\ue014", "ArrowDown": "\ue015", "F1": "\ue031"}
THROWN = re.compile(r"(Uncaught )?\w*Error: ")  # other entries of the log are reports of the browser
BUTTONS = {"mousePressed": "pointerDown", "mouseReleased": "pointerUp"}
NUMBERS = {"NaN": math.nan, "Infinity": math.inf, "-Infinity": -math.inf, "-0": -0.0}


def find() -> str | None:
    """The path of a Firefox on this machine, or None; it needs Xvfb, too."""
    return shutil.which(DISPLAY[0]) and next((path for name in NAMES if (path := shutil.which(name))), None)


def start(cleanup: ExitStack, command: list[str], **options: Any) -> None:
    """Starts a program that ends with `cleanup`."""
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, **options)
    cleanup.callback(process.wait, 20)
    cleanup.callback(process.terminate)


def start_display(cleanup: ExitStack) -> str:
    """Starts a virtual display; returns its name."""
    here, there = os.pipe()
    start(cleanup, [*DISPLAY, str(there)], pass_fds=[there])
    os.close(there)
    with os.fdopen(here) as lines:
        return f":{lines.readline().strip()}"


def python_value(remote: dict[str, Any]) -> Any:
    """A value of a script, from its description in the protocol."""
    value = remote.get("value")
    if remote["type"] == "number":
        return NUMBERS[value] if isinstance(value, str) else value
    if remote["type"] == "array":
        return [python_value(x) for x in value]
    if remote["type"] == "object":
        return {key: python_value(x) for key, x in value}
    return value if remote["type"] in ("string", "boolean", "null", "undefined") else remote


class Firefox(Browser):
    """One page. Use as a context manager."""

    def __enter__(self) -> Firefox:
        with ExitStack() as cleanup:
            folder = cleanup.enter_context(tempfile.TemporaryDirectory(prefix="browser-", ignore_cleanup_errors=True))
            settings = "".join(f"user_pref({json.dumps(k)}, {json.dumps(v)});\n" for k, v in SETTINGS.items())
            (Path(folder) / "user.js").write_text(settings)
            program = find()
            assert program, "no Firefox found"
            command = [program, "--no-remote", "--profile", folder, "--remote-debugging-port=0", "about:blank"]
            start(cleanup, command, env={**os.environ, "HOME": folder, "DISPLAY": start_display(cleanup)})
            address = self._address(Path(folder) / "WebDriverBiDiServer.json")
            self._socket = cleanup.enter_context(connect(address, max_size=None, open_timeout=30))
            self.call("session.new", capabilities={})
            self.call("session.subscribe", events=["log.entryAdded"])
            self._page = self.call("browsingContext.getTree")["contexts"][0]["context"]
            window = {"width": WIDTH, "height": HEIGHT}
            self.call("browsingContext.setViewport", context=self._page, viewport=window, devicePixelRatio=1)
            self._cleanup = cleanup.pop_all()
        return self

    def _address(self, file: Path) -> str:
        deadline = time.monotonic() + 60
        while time.monotonic() < deadline:
            if file.exists() and (text := file.read_text()):
                server = json.loads(text)
                return f"ws://{server['ws_host']}:{server['ws_port']}/session"
            time.sleep(0.05)
        raise TimeoutError("Firefox did not start")

    def call(self, method: str, **parameters: Any) -> dict[str, Any]:
        self._next_id += 1
        self._socket.send(json.dumps({"id": self._next_id, "method": method, "params": parameters}))
        while True:
            answer = json.loads(self._socket.recv(60))
            if answer.get("method") == "log.entryAdded" and THROWN.match(answer["params"]["text"] or ""):
                self.errors.append(answer["params"]["text"])
            if answer.get("id") == self._next_id:
                if answer["type"] == "error":
                    raise RuntimeError(answer["message"])
                return answer["result"]

    def navigate(self, url: str) -> None:
        self.call("browsingContext.navigate", context=self._page, url=url, wait="complete")

    def evaluate(self, script: str) -> Any:
        answer = self.call("script.evaluate", expression=script, target={"context": self._page}, awaitPromise=True)
        if answer["type"] == "exception":
            raise RuntimeError(answer["exceptionDetails"]["text"])
        return python_value(answer["result"])

    def screenshot(self) -> str:
        return self.call("browsingContext.captureScreenshot", context=self._page)["data"]

    def _perform(self, kind: str, actions: list[dict[str, Any]]) -> None:
        self.call("input.performActions", context=self._page, actions=[{"type": kind, "id": kind, "actions": actions}])

    def press(self, key: str, **more: Any) -> None:
        keys = ["\ue00a"] if more.get("modifiers") == 1 else []  # Alt
        keys.append(KEYS.get(key, key))
        actions = [{"type": "keyDown", "value": one} for one in keys]
        self._perform("key", actions + [{"type": "keyUp", "value": one} for one in reversed(keys)])

    def mouse(self, kind: str, x: float, y: float, **more: Any) -> None:
        actions: list[dict[str, Any]] = [{"type": "pointerMove", "x": round(x), "y": round(y)}]
        if kind in BUTTONS:
            actions.append({"type": BUTTONS[kind], "button": 0})
        self._perform("pointer", actions)

    def click(self, x: float, y: float) -> None:
        self.mouse("mousePressed", x, y)
        self.mouse("mouseReleased", x, y)
