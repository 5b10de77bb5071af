"""Measures the speed of the viewer and the cameras.

    python benchmarks/viewer.py                 all parts, or some of: bundle, first, client, server, frames,
                                                 notebook, ik, camera
    python benchmarks/viewer.py client --seconds 20 --size 1280x720

    bundle    size of the served page, compressed
    first     time from the call of view() until a browser with an open page shows the Panda
    client    200 shapes (boxes, spheres, capsules, cylinders, meshes), all moved 60 times per second by a program;
              pictures per second of a headless Chromium that draws in software, with shadows, and the number of the 60
              that arrive
    server    share of one core for the server of 1000 frames at 60 Hz, with kinematics and a connected browser that
              reads everything
    frames    10,000 frames with shapes added one by one, without a page and with one that is updated each time; then
              all are moved while a browser draws them; counts changes of its canvas size
    notebook  size of a Panda and of a motion in a notebook, and the number of copies of the page's script
    ik        a target is dragged by its handles while `interactiveIk` runs: rates of poses, of drawings, and of changes
              of the drawn arm
    camera    RGB and depth, 640x360, of pandaSingle

Figures are worse on a busy machine. Needs Chromium and the package `websockets` (first, client, server).
"""

import argparse
import contextlib
import gzip
import os
import socket
import statistics
import subprocess
import sys
import threading
import time
import urllib.parse
import urllib.request
from pathlib import Path

import numpy as np

import kinegraph as kg

sys.path.append(str(Path(__file__).parent.parent))

from tests.viewer.browser import Browser

MOVING = """
import sys, time
import numpy as np
import kinegraph as kg

count, moves = int(sys.argv[1]), sys.argv[2] == "moving"
C = kg.Config()
shapes = [(kg.ST.box, [.05, .08, .1]), (kg.ST.sphere, [.05]), (kg.ST.capsule, [.1, .03]), (kg.ST.cylinder, [.1, .04]),
          (kg.ST.ssBox, [.08, .08, .08, .02])]
side = int(np.ceil(np.sqrt(count)))
places = np.array([[(i % side) / side * 2.5 - 1.25, (i // side) / side * 2.5 - 1.25, .4] for i in range(count)])
for i, place in enumerate(places):
    shape, size = shapes[i % len(shapes)]
    C.addFrame(f"f{i}").setShape(shape, size).setPosition(place).setColor([.3 + .6 * (i % 7) / 6, .5, .9 - .6 * (i % 11) / 10])
poses = C.getFrameState()
C.view()
C.viewer().waitForClient(120)
start, used, step = time.monotonic(), time.process_time(), 0
while True:
    poses[:, 2] = .4 + .2 * np.sin(2 * step / 60 + places[:, 0] * 3 + places[:, 1] * 2)
    if moves:
        C.setFrameState(poses)
        C.view()
    step += 1
    now = time.monotonic()
    if step % 300 == 0:
        print("core", (time.process_time() - used) / (now - start) if step > 300 else 0, flush=True)
        start, used, base = now, time.process_time(), step
        next_time = now
    elif step < 300:
        next_time = start + step / 60
    next_time += 1 / 60
    time.sleep(max(0, next_time - time.monotonic()))
"""


DRAGGED = """
import kinegraph as kg
C = kg.Config()
C.addFile(kg.raiPath("scenarios/pandaSingle.g"))
C.view()
C.viewer().setCamera([1.6, 1.2, 1.6], [0, 0, .9])
C.viewer().waitForClient(120)
kg.interactiveIk(C, "l_gripper")
"""

# The pointer draws a figure around a point, 60 times per second; the page's clock gives the first sight of the gripper
# at a position.
DRAG = """
const canvas = document.getElementById("canvas");
const point = (kind, x, y) => canvas.dispatchEvent(new PointerEvent(kind,
  { clientX: x, clientY: y, button: kind === "pointermove" ? -1 : 0, buttons: 1, pointerId: 1, pointerType: "mouse", isPrimary: true, bubbles: true }));
canvas.setPointerCapture = canvas.releasePointerCapture = () => {};
window.places = [];
window.moves = 0;
point("pointermove", ...PLACE);
point("pointerdown", ...PLACE);
setInterval(() => {
  const now = performance.now() / 1000;
  point("pointermove", PLACE[0] + 40 * Math.sin(3 * now), PLACE[1] + 30 * Math.sin(2 * now));
  ++moves;
}, 1000 / 60);
(function look(last) {
  const place = String(kinegraph.position("l_gripper"));
  if (place !== last) places.push(performance.now());
  requestAnimationFrame(() => look(place));
})("");
"""


def start(code: str, *arguments: str) -> tuple[subprocess.Popen, str]:
    """Returns a program and the address of its viewer."""
    environment = {k: v for k, v in os.environ.items() if k not in ("KINEGRAPH_HEADLESS", "DISPLAY", "WAYLAND_DISPLAY")}
    model = subprocess.Popen(
        [sys.executable, "-u", "-c", code, *arguments],
        env=environment,
        stdout=subprocess.PIPE,
        text=True,
        stdin=subprocess.DEVNULL,
    )
    assert model.stdout
    for line in model.stdout:
        if line.startswith("Viewer: "):
            return model, line.split()[1]
    raise RuntimeError("the program has not started its viewer")


def set_size(browser: Browser, width: int, height: int) -> None:
    browser.call("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=False)


def processor_time(process: int) -> float:
    """Returns the processor time of a process and its children, s."""
    times, parents = {}, {}
    for entry in Path("/proc").glob("[0-9]*/stat"):
        try:
            fields = entry.read_text().rsplit(")", 1)[1].split()
        except OSError:
            continue
        number = int(entry.parent.name)
        parents[number] = int(fields[1])
        times[number] = (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")
    inside = {process}
    while more := {child for child, parent in parents.items() if parent in inside} - inside:
        inside |= more
    return sum(times.get(number, 0.0) for number in inside)


def bundle() -> None:
    C = kg.Config()
    C.addFrame("world")
    C.view()
    page = urllib.request.urlopen(C.viewer().url).read()
    C.view_close()
    print(f"bundle: {len(page) / 1000:.0f} kB, {len(gzip.compress(page, 9)) / 1000:.0f} kB compressed")


def first_picture() -> None:
    times = []
    with Browser() as browser:
        for _ in range(5):
            C = kg.Config()
            C.addFrame("world")
            C.view()
            browser.open_page(C.viewer().url)
            browser.wait_for("kinegraph.idle()")
            D = kg.Config()
            D.addFile(kg.raiPath("scenarios/pandaSingle.g"))
            D.set_viewer(C.viewer())
            before = time.monotonic()
            D.view()
            browser.wait_for("kinegraph.position('l_gripper') && kinegraph.idle()")
            times.append(time.monotonic() - before)
            C.view_close()
    print(
        f"first picture of the Panda: {statistics.median(times):.2f} s (median of {len(times)}; worst {max(times):.2f} s)"
    )


def client(seconds: float, width: int, height: int, shadows: bool) -> None:
    model, url = start(MOVING, "200", "moving")
    try:
        with Browser() as browser:
            set_size(browser, width, height)
            browser.open_page(url)
            browser.wait_for("kinegraph.frames() == 200")
            if not shadows:
                browser.press_alt("S")
            time.sleep(3)
            counters = "[kinegraph.pictures(), kinegraph.poses(), performance.now()]"
            before, used = browser.evaluate(counters), processor_time(browser.process_id)
            time.sleep(seconds)
            used = processor_time(browser.process_id) - used
            pictures, messages, milliseconds = (b - a for a, b in zip(before, browser.evaluate(counters)))
            share = browser.evaluate("kinegraph.resolution()")
    finally:
        model.kill()
        model.wait()
    rate, arrived = 1e3 * pictures / milliseconds, 1e3 * messages / milliseconds
    print(
        f"client, 200 moving shapes, {width}x{height}, software: "
        f"{rate:.1f} pictures/s, {arrived:.1f} messages/s arrive; "
        f"{1e3 * used / pictures:.0f} ms of processor time per picture, {share:.2f} pixels drawn per pixel across"
    )


def server() -> None:
    from websockets.sync.client import connect

    for moves in ("moving", "still"):
        model, url = start(MOVING, "1000", moves)
        with connect(url.replace("http", "ws"), max_size=None) as socket:
            received = 0

            def read() -> None:
                nonlocal received
                try:
                    for _ in socket:
                        received += 1
                except Exception:
                    pass

            threading.Thread(target=read, daemon=True).start()
            shares = []
            while len(shares) < 4:
                line = model.stdout.readline()
                if line.startswith("core"):
                    shares.append(float(line.split()[1]))
            model.kill()
            model.wait()
        print(
            f"server, 1000 frames at 60 Hz, {moves}: {100 * statistics.median(shares[1:]):.1f} % of a core, {received} messages"
        )


ADDED = """
import sys, time
import numpy as np
import kinegraph as kg

count, shown = int(sys.argv[1]), sys.argv[2] == "shown"
C = kg.Config()
C.view()
C.viewer().waitForClient(120)
start, side = time.perf_counter(), int(np.ceil(np.sqrt(count)))
for i in range(count):
    C.addFrame(f"f{i}").setShape(kg.ST.box, [.02, .02, .02]).setPosition([i % side / side * 3 - 1.5, i // side / side * 3 - 1.5, .4])
    if shown:
        C.view()
    if (i + 1) % (count // 5) == 0:
        print("added", i + 1, time.perf_counter() - start, flush=True)
C.view(False, "all are there")
time.sleep(600)
"""

SIZES = """window.sizes = 0;
new MutationObserver((changes) => (sizes += changes.length)).observe(document.getElementById("canvas"),
  { attributes: true, attributeFilter: ["width"] });"""


def adding(how: str) -> None:
    count = 10000 if how == "silent" else 2000
    model, url = start(ADDED, str(count), how)
    try:
        with Browser() as browser:
            browser.open_page(url)
            browser.evaluate(SIZES)
            lines = []
            while len(lines) < 5:
                line = model.stdout.readline()
                if line.startswith("added"):
                    lines.append([float(word) for word in line.split()[1:]])
            last = lines[-1][1]
            browser.wait_for("kinegraph.message() == 'all are there'", 300)
            browser.wait_for(f"kinegraph.frames() == {count} && kinegraph.idle()", 300)
            sizes = browser.evaluate("sizes")
    finally:
        model.kill()
        model.wait()
    parts = np.diff([[0.0, 0.0], *lines], axis=0)
    print(
        f"frames, {count} added one by one{', each shown' if how == 'shown' else ''}: {last:.2f} s; us per frame in fifths of them: "
        f"{', '.join(f'{1e6 * seconds / frames:.0f}' for frames, seconds in parts)}; canvas sized {sizes} times"
    )


def many(seconds: float, width: int, height: int) -> None:
    model, url = start(MOVING, "10000", "moving")
    try:
        with Browser() as browser:
            set_size(browser, width, height)
            browser.open_page(url)
            browser.wait_for("kinegraph.frames() == 10000", 120)
            time.sleep(5)
            browser.evaluate(SIZES)
            counters = "[kinegraph.pictures(), kinegraph.poses(), sizes, performance.now()]"
            before = browser.evaluate(counters)
            time.sleep(seconds)
            pictures, messages, sizes, milliseconds = (b - a for a, b in zip(before, browser.evaluate(counters)))
            share = browser.evaluate("kinegraph.resolution()")
    finally:
        model.kill()
        model.wait()
    print(
        f"frames, 10000 that all move, {width}x{height}, software: {1e3 * messages / milliseconds:.1f} messages/s, "
        f"{1e3 * pictures / milliseconds:.1f} pictures/s, {share:.2f} pixels drawn per pixel across; in {milliseconds / 1e3:.0f} s the "
        f"canvas got another size {sizes} times"
    )


def frames(seconds: float, width: int, height: int) -> None:
    adding("silent")
    adding("shown")
    many(seconds, width, height)


class CountingSocket(socket.socket):
    """A connection that counts the received bytes."""

    received = 0

    def recv(self, *arguments: int) -> bytes:
        data = super().recv(*arguments)
        self.received += len(data)
        return data


def bytes_to_open(url: str) -> int:
    """Returns the bytes that a browser receives until it shows the scene: the page and all messages, compressed."""
    from websockets.sync.client import connect

    page = urllib.request.urlopen(urllib.request.Request(url, headers={"Accept-Encoding": "gzip"})).read()
    place = urllib.parse.urlsplit(url)
    tcp = CountingSocket()
    tcp.connect((place.hostname, place.port))
    with connect(url.replace("http", "ws"), sock=tcp, max_size=None) as messages:
        try:
            while True:
                messages.recv(2)
        except TimeoutError:
            pass
    return len(page) + tcp.received


def sizes() -> None:
    scenes = {"scenarios/pandaSingle.g": kg.raiPath("scenarios/pandaSingle.g")}
    with contextlib.suppress(kg.FileError, kg.ArgumentError):  # needs the extra `meshes`
        scenes["Panda of example-robot-data"] = kg.robotPath("example-robot-data/panda")
    for name, file in scenes.items():
        C = kg.Config()
        C.addFile(file)
        C.view()
        viewer = C.viewer()
        print(
            f"sizes, {name}: saved page {len(viewer.asHtml()) / 1e3:.0f} kB, in a notebook "
            f"{len(viewer._repr_html_()) / 1e3:.0f} kB, opening the live page {bytes_to_open(viewer.url) / 1e3:.0f} kB"
        )
        C.view_close()


def notebook() -> None:
    C = kg.Config()
    C.addFile(kg.raiPath("scenarios/pandaSingle.g"))
    komo = kg.KOMO(C, 3, 30, 2, False)
    komo.addControlObjective([], 2, 1e-1)
    meshes = kg.Config()
    meshes.addFile(kg.raiPath("panda/panda.g"))
    for name, shown in {"Panda on its table": C, "Panda alone": meshes}.items():
        viewer = shown.viewer()
        whole, element = viewer.asHtml(), viewer._repr_html_()
        print(f"notebook, {name}: {len(whole) / 1e3:.0f} kB as a page, {len(element) / 1e3:.0f} kB in a notebook")
    print(
        f"notebook, a motion of 90 slices of it: {len(komo._repr_html_()) / 1e3:.0f} kB; a Config: {len(C._repr_html_()) / 1e3:.0f} kB"
    )


def dragging(seconds: float, width: int, height: int) -> None:
    model, url = start(DRAGGED)
    try:
        with Browser() as browser:
            set_size(browser, width, height)
            browser.open_page(url)
            browser.wait_for("kinegraph.position('ik_target') && kinegraph.selected() == 'ik_target'")
            browser.wait_for("kinegraph.idle()")
            x, y = browser.pixel(browser.evaluate("kinegraph.position('ik_target')"))
            browser.evaluate(DRAG.replace("PLACE", f"[{x}, {y}]"))
            time.sleep(2)
            counters = "[places.length, moves, kinegraph.pictures(), kinegraph.poses(), performance.now()]"
            before, used = browser.evaluate(counters), [processor_time(p) for p in (model.pid, browser.process_id)]
            time.sleep(seconds)
            used = [processor_time(p) - u for p, u in zip((model.pid, browser.process_id), used)]
            places, moves, pictures, messages, passed = (b - a for a, b in zip(before, browser.evaluate(counters)))
            apart = np.diff(browser.evaluate("places")[before[0] :])
            share = browser.evaluate("kinegraph.resolution()")
    finally:
        model.kill()
        model.wait()
    passed /= 1e3
    print(
        f"ik, {width}x{height}, {moves / passed:.0f} moves/s of the pointer: {messages / passed:.1f} messages/s with "
        f"poses of the target or the arm arrive at the page, {pictures / passed:.1f} pictures/s are drawn; the arm is somewhere else in {places / passed:.1f} "
        f"pictures/s, {np.median(apart):.0f} ms apart, 9 of 10 within {np.quantile(apart, 0.9):.0f} ms; processor time per "
        f"picture: program {1e3 * used[0] / pictures:.1f} ms, browser {1e3 * used[1] / pictures:.1f} ms; {share:.2f} pixels "
        "drawn per pixel across"
    )


def camera() -> None:
    C = kg.Config()
    C.addFile(kg.raiPath("scenarios/pandaSingle.g"))
    view = kg.CameraView(C)
    view.setCamera("cameraTop")
    times = []
    q = C.getJointState()
    for i in range(40):
        C.setJointState(q + 0.01 * np.sin(i))
        before = time.monotonic()
        view.computeImageAndDepth(C)
        times.append(time.monotonic() - before)
    print(
        f"camera, RGB and depth, 640x360 of pandaSingle: {1e3 * statistics.median(times[5:]):.1f} ms (first {1e3 * times[0]:.0f} ms)"
    )


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument(
        "what",
        nargs="*",
        default=["bundle", "first", "client", "server", "frames", "sizes", "notebook", "ik", "camera"],
    )
    parser.add_argument("--seconds", type=float, default=8.0)
    parser.add_argument("--size", default="640x480")
    parser.add_argument("--no-shadows", action="store_true")
    options = parser.parse_args()
    width, height = map(int, options.size.split("x"))
    jobs = {
        "bundle": bundle,
        "first": first_picture,
        "client": lambda: client(options.seconds, width, height, not options.no_shadows),
        "server": server,
        "frames": lambda: frames(options.seconds, width, height),
        "sizes": sizes,
        "notebook": notebook,
        "ik": lambda: dragging(options.seconds, width, height),
        "camera": camera,
    }
    for what in options.what:
        jobs[what]()


if __name__ == "__main__":
    main()
