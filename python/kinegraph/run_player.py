"""Plays recorded runs in the browser: one, or two side by side in step."""

from __future__ import annotations

import html
import os
import webbrowser
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path

from ._core import runPage
from .errors import ArgumentError

_FIRST_PORT = 7000

# Passes the time and the camera of each run on to the other one.
_TWO = """<!doctype html>
<html lang="en"><head><meta charset="utf-8"><title>{title}</title>
<style>
body {{ margin: 0; display: grid; grid-template-columns: 1fr 1fr; grid-template-rows: auto 1fr; height: 100vh; font: 14px system-ui, sans-serif; }}
h1 {{ font-size: 13px; font-weight: 600; margin: 4px 12px; }}
iframe {{ border: 0; width: 100%; height: 100%; }}
iframe + iframe {{ border-left: 1px solid #8884; }}
</style></head><body>{names}{frames}
<script>
const frames = [...document.querySelectorAll("iframe")];
addEventListener("message", ({{ source, data }}) => {{
  for (const frame of frames) if (frame.contentWindow !== source) frame.contentWindow.postMessage(data, "*");
}});
</script></body></html>
"""


def pageOfRuns(files: list[str]) -> str:
    """Returns a page that plays runs without a program.

    Args:
        files: One or two files written by `viewer.record`. Two have one time slider each, which move together, as the
            cameras do.
    Returns:
        The page, HTML.
    Raises:
        ArgumentError: A file is not a recorded run.
        OSError: A file cannot be read.
    """
    pages = []
    for file in files:
        try:
            pages.append(runPage(Path(file).read_bytes()))
        except ArgumentError as error:
            raise ArgumentError(f"{file}: {error}") from None
    if len(pages) == 1:
        return pages[0]
    frames = "".join(
        f'<iframe title="{html.escape(file)}" srcdoc="{html.escape(page)}"></iframe>'
        for file, page in zip(files, pages)
    )
    names = "".join(f"<h1>{html.escape(Path(file).name)}</h1>" for file in files)
    return _TWO.format(title=html.escape(" | ".join(Path(file).name for file in files)), names=names, frames=frames)


def _server(page: bytes) -> ThreadingHTTPServer:
    """Returns a server of the page, for browsers on this machine, at the first free port."""

    class Handler(BaseHTTPRequestHandler):
        def do_GET(self) -> None:
            self.send_response(200 if self.path == "/" else 404)
            self.send_header("Content-Type", "text/html; charset=utf-8")
            self.send_header("Content-Length", str(len(page) if self.path == "/" else 0))
            self.end_headers()
            if self.path == "/":
                self.wfile.write(page)

        def log_message(self, *_: object) -> None:
            pass

    for port in range(_FIRST_PORT, _FIRST_PORT + 100):
        try:
            return ThreadingHTTPServer(("127.0.0.1", port), Handler)
        except OSError:
            continue
    return ThreadingHTTPServer(("127.0.0.1", 0), Handler)


def playRuns(files: list[str], output: str | None = None) -> None:
    """Plays one run, or two in step, in the browser until Ctrl-C.

    Args:
        files: Files written by `viewer.record`.
        output: Writes the page to this file, and shows nothing.
    Raises:
        ArgumentError: A file is not a recorded run.
        OSError: A file cannot be read or written.
    """
    page = pageOfRuns(files)
    if output is not None:
        Path(output).write_text(page, encoding="utf-8")
        print(output)
        return
    server = _server(page.encode())
    url = f"http://localhost:{server.server_port}"
    print(f"Viewer: {url} (Ctrl-C ends)", flush=True)
    if os.environ.get("KINEGRAPH_HEADLESS", "0") in ("", "0") and (
        os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY")
    ):
        webbrowser.open(url)
    server.serve_forever()
