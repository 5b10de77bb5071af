"""A headless Chromium, driven through its DevTools protocol."""

from __future__ import annotations

import base64
import json
import shutil
import subprocess
import tempfile
import time
import urllib.request
from contextlib import ExitStack
from pathlib import Path
from typing import Any

import numpy as np
from websockets.sync.client import connect

from .camera import HEIGHT, WIDTH

NAMES = ("chromium", "chromium-browser", "google-chrome", "chrome")
FLAGS = [
    "--headless=new",
    "--no-sandbox",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--disable-extensions",
    "--mute-audio",
    "--use-gl=angle",
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
    "--remote-debugging-port=0",
]

# the browser decodes its own pictures: rgba bytes in base64
DECODE_PNG = """(async () => {
  const picture = await createImageBitmap(await (await fetch("data:image/png;base64,PNG")).blob());
  const context = new OffscreenCanvas(picture.width, picture.height).getContext("2d");
  context.drawImage(picture, 0, 0);
  const bytes = context.getImageData(0, 0, picture.width, picture.height).data;
  let text = "";
  for (let i = 0; i < bytes.length; i += 8192) text += String.fromCharCode(...bytes.subarray(i, i + 8192));
  return btoa(text);
})()"""


def find() -> str | None:
    """The path of a Chromium on this machine, or None."""
    return next((path for name in NAMES if (path := shutil.which(name))), None)


def reason(details: dict[str, Any]) -> str:
    """An error in a script."""
    return details.get("exception", {}).get("description", details["text"])


HIDE_TOOLS = "for (const x of document.querySelectorAll('#gizmo, #toolbar')) x.style.visibility = '{}'"


class Browser:
    """One page. Use as a context manager."""

    def __init__(self) -> None:
        self._next_id = 0
        self.errors: list[str] = []  # thrown by scripts of the page

    def __enter__(self) -> Browser:
        with ExitStack() as cleanup:
            self._profile = cleanup.enter_context(
                tempfile.TemporaryDirectory(prefix="browser-", ignore_cleanup_errors=True)
            )
            program = find()
            assert program, "no Chromium found"
            process = subprocess.Popen(
                [program, *FLAGS, f"--user-data-dir={self._profile}", "about:blank"],
                stdout=subprocess.DEVNULL,
                stderr=subprocess.DEVNULL,
            )
            self.process_id = process.pid
            cleanup.callback(process.wait, 20)
            cleanup.callback(process.terminate)
            self._socket = cleanup.enter_context(connect(self._page_address(), max_size=None, open_timeout=30))
            self.call("Page.enable")
            self.call("Runtime.enable")
            self.call(
                "Emulation.setDeviceMetricsOverride", width=WIDTH, height=HEIGHT, deviceScaleFactor=1, mobile=False
            )
            self.call("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": "light"}])
            self._cleanup = cleanup.pop_all()
        return self

    def __exit__(self, *_: object) -> None:
        self._cleanup.close()

    def _page_address(self) -> str:
        port_file = Path(self._profile) / "DevToolsActivePort"
        deadline = time.monotonic() + 60
        while time.monotonic() < deadline:
            if port_file.exists() and (lines := port_file.read_text().splitlines()):
                with urllib.request.urlopen(f"http://127.0.0.1:{lines[0]}/json") as answer:
                    pages = [page for page in json.load(answer) if page["type"] == "page"]
                if pages:
                    return pages[0]["webSocketDebuggerUrl"]
            time.sleep(0.05)
        raise TimeoutError("Chromium did not start")

    def call(self, method: str, **parameters: Any) -> dict[str, Any]:
        self._next_id += 1
        self._socket.send(json.dumps({"id": self._next_id, "method": method, "params": parameters}))
        while True:
            answer = json.loads(self._socket.recv(60))
            if answer.get("method") == "Runtime.exceptionThrown":
                self.errors.append(reason(answer["params"]["exceptionDetails"]))
            if answer.get("id") == self._next_id:
                if "error" in answer:
                    raise RuntimeError(answer["error"])
                return answer["result"]

    def open_page(self, url: str) -> None:
        self.call("Page.navigate", url=url)
        self.wait_for("window.kinegraph && !kinegraph.ended()")

    def open(self, url: str) -> None:
        """Opens a viewer's page, and waits until it shows a scene."""
        self.open_page(url)
        self.wait_for("kinegraph.frames() > 0 && kinegraph.idle()")

    def close_page(self) -> None:
        self.evaluate("location.protocol === 'http:' && localStorage.clear()")
        self.call("Page.navigate", url="about:blank")

    def evaluate(self, script: str) -> Any:
        result = self.call("Runtime.evaluate", expression=script, returnByValue=True, awaitPromise=True)
        if "exceptionDetails" in result:
            raise RuntimeError(reason(result["exceptionDetails"]))
        return result["result"].get("value")

    def wait_for(self, script: str, seconds: float = 60) -> Any:
        """Waits until `script` is true; returns its value."""
        deadline = time.monotonic() + seconds
        state: Any = None
        while time.monotonic() < deadline:
            try:
                if state := self.evaluate(script):
                    return state
            except RuntimeError as error:  # the page may not be there yet
                state = error
            time.sleep(0.05)
        raise TimeoutError(f"never true, but {state!r}: {script}")

    def press(self, key: str, **more: Any) -> None:
        """Presses a key, as KeyboardEvent.key names it."""
        for kind in ("keyDown", "keyUp"):
            self.call("Input.dispatchKeyEvent", type=kind, key=key, **more)

    def press_alt(self, letter: str) -> None:
        self.press(letter.lower(), code=f"Key{letter}", modifiers=1)

    def type(self, text: str) -> None:
        """Types into the focused element."""
        for letter in text:
            self.press(letter, text=letter)

    def click(self, x: float, y: float) -> None:
        for kind in ("mousePressed", "mouseReleased"):
            self.call("Input.dispatchMouseEvent", type=kind, x=x, y=y, button="left", clickCount=1)

    def mouse(self, kind: str, x: float, y: float, **more: Any) -> None:
        self.call("Input.dispatchMouseEvent", type=kind, x=x, y=y, **more)

    def drag(self, start: tuple[float, float], end: tuple[float, float], steps: int = 8, modifiers: int = 0) -> None:
        """Moves the pointer there, presses, moves on in steps, and lets go. `modifiers`: 2 is Ctrl."""
        points = np.linspace(start, end, steps + 1)
        self.mouse("mouseMoved", *points[0], modifiers=modifiers)
        self.mouse("mousePressed", *points[0], button="left", modifiers=modifiers)
        for place in points[1:]:
            self.mouse("mouseMoved", *place, button="left", buttons=1, modifiers=modifiers)
        self.mouse("mouseReleased", *points[-1], button="left", modifiers=modifiers)

    def click_button(self, text: str) -> None:
        """Clicks the button with that text; one that is to be seen, if there are several."""
        named = f"[...document.querySelectorAll('button')].filter((x) => x.textContent === {json.dumps(text)})"
        self.evaluate(f"(({named}).find((x) => x.checkVisibility()) ?? ({named}).at(-1)).click()")

    def pixel(self, point: Any) -> tuple[float, float]:
        """Returns the place of a point of the scene on the page: x and y."""
        return tuple(self.evaluate(f"kinegraph.pixel(...{json.dumps(list(point))})"))

    def upper_handle(self, frame: str) -> tuple[float, float]:
        """Returns the place of the handle above a selected frame, which moves it upwards."""
        x, y, z = self.evaluate(f"kinegraph.position({json.dumps(frame)})")
        foot, tip = self.pixel([x, y, z]), self.pixel([x, y, z + 0.15])
        return foot[0], foot[1] + 0.8 * (tip[1] - foot[1])

    def is_visible(self, selector: str) -> bool:
        return self.evaluate(f"document.querySelector({json.dumps(selector)}).checkVisibility()")

    def decode(self, png: str, height: int) -> np.ndarray:
        """The rgb bytes of a picture in base64, shape (height, width, 3)."""
        pixels = self.evaluate(DECODE_PNG.replace("PNG", png))
        return np.frombuffer(base64.b64decode(pixels), np.uint8).reshape(height, -1, 4)[..., :3]

    def picture(self) -> np.ndarray:
        """The page as people see it, without the colored axes in the corner and the toolbar, since tests find shapes by
        their colors: rgb bytes, shape (HEIGHT, WIDTH, 3)."""
        self.evaluate(HIDE_TOOLS.format("hidden"))
        png = self._still()
        self.evaluate(HIDE_TOOLS.format(""))
        return self.decode(png, HEIGHT)

    def _still(self) -> str:
        """A picture in full resolution, in base64: one during which the page has drawn nothing, as when warnings
        arrive a second after a change."""
        drawn = "kinegraph.idle() ? kinegraph.pictures() : -1"
        while True:
            self.wait_for("kinegraph.idle()")
            before = self.evaluate(drawn)
            png = self.call("Page.captureScreenshot", format="png")["data"]
            if before != -1 and before == self.evaluate(drawn):
                return png
