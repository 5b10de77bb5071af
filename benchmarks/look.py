"""Compares viewers: pictures of five scenes, bytes and time until a scene is seen, and what a program can do.

    python benchmarks/look.py FOLDER                       all viewers that are installed, all scenes
    python benchmarks/look.py FOLDER --only kinegraph,viser --scenes panda,hall --dark

viser, meshcat, rerun (its web viewer) and mujoco are compared; install them in an environment of their own:
`pip install viser meshcat rerun-sdk mujoco websockets`. All get the same triangles with one color each, without points
and lines, and the same camera. Lights, materials and floors are those of each viewer; MuJoCo gets the checker floor and
the sky of its own example scenes. Pictures have 960x720 pixels and are FOLDER/<viewer>_<scene>.png. Prints the table of
docs/viewer.md:

    bytes     received by a new browser until the first scene stands still, compressed as they come
    seconds   until then, from the moment the browser asks for the page
    lines     of Python for a task, each of which has run in this process; - if there is no call

Needs Chromium. Times are worse on a busy machine.
"""

from __future__ import annotations

import argparse
import base64
import importlib.metadata
import importlib.util
import socket
import sys
import threading
import time
import urllib.parse
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from look_features import FEATURES, features  # first: it chooses how MuJoCo draws

import kinegraph as kg

sys.path.append(str(Path(__file__).parent.parent))

from tests.viewer.browser import Browser
from tests.viewer.five_scenes import SCENES

from kinegraph.png import writePng

WIDTH, HEIGHT = 960, 720
FIELD_OF_VIEW = float(np.rad2deg(2 * np.arctan(0.5 / np.sqrt(3))))  # degrees, vertical; Kinegraph's default
MODULES = {"kinegraph": "kinegraph", "viser": "viser", "meshcat": "meshcat", "rerun": "rerun-sdk", "mujoco": "mujoco"}


@dataclass
class Part:
    """Triangles of one color, in world coordinates."""

    name: str
    vertices: np.ndarray
    triangles: np.ndarray
    color: np.ndarray  # rgba in 0..1


@dataclass
class View:
    """A scene, and where it is seen from."""

    config: kg.Config
    position: np.ndarray
    target: np.ndarray
    parts: list[Part]


def parts_of(config: kg.Config) -> list[Part]:
    """Returns the visible surfaces of a scene."""
    parts = []
    for frame in config.getFrames():
        if frame.getShapeType() in (kg.ST.none, kg.ST.marker, kg.ST.camera, kg.ST.lines, kg.ST.pointCloud):
            continue
        color = np.array([*frame.asDict().get("color", [0.8, 0.8, 0.8]), 1.0][:4], float)
        if color[3] <= 0.25 and frame.asDict().get("contact", 0) != 0:  # a shape for collisions
            continue
        vertices, triangles, _ = frame.getMesh()
        vertices = vertices @ frame.getRotationMatrix().T + frame.getPosition()
        parts.append(Part(f"{frame.name}_{frame.ID}", vertices, triangles, color))
    return parts


def view_of(name: str) -> View:
    config, position, target = SCENES[name]()
    return View(config, np.array(position), np.array(target), parts_of(config))


class Proxy:
    """Passes connections on to a port of this machine and counts what comes back."""

    def __init__(self, port: int) -> None:
        self.target, self.received = port, 0
        self.listener = socket.create_server(("127.0.0.1", 0))
        self.port = self.listener.getsockname()[1]
        threading.Thread(target=self._accept, daemon=True).start()

    def _accept(self) -> None:
        while True:
            try:
                client = self.listener.accept()[0]
            except OSError:
                return
            server = socket.create_connection(("localhost", self.target))
            threading.Thread(target=self._pass, args=(client, server, False), daemon=True).start()
            threading.Thread(target=self._pass, args=(server, client, True), daemon=True).start()

    def _pass(self, source: socket.socket, to: socket.socket, counts: bool) -> None:
        try:
            while data := source.recv(1 << 16):
                if counts:
                    self.received += len(data)
                elif data.startswith(b"GET "):  # servers check the host
                    data = data.replace(b":%d" % self.port, b":%d" % self.target)
                to.sendall(data)
            to.shutdown(socket.SHUT_WR)
        except OSError:
            pass


def free_port() -> int:
    with socket.create_server(("127.0.0.1", 0)) as probe:
        return int(probe.getsockname()[1])


def shoot(browser: Browser) -> bytes:
    return base64.b64decode(browser.call("Page.captureScreenshot", format="png")["data"])


def watch(url: str, proxies: list[Proxy], file: Path, dark: bool, limit: float = 60.0) -> tuple[float, int]:
    """Opens a page, and saves its picture as soon as it has been the same for 3 s. Returns the seconds until it was
    seen and the bytes that came."""
    with Browser() as browser:
        browser.call(
            "Emulation.setDeviceMetricsOverride", width=WIDTH, height=HEIGHT, deviceScaleFactor=1, mobile=False
        )
        scheme = {"name": "prefers-color-scheme", "value": "dark" if dark else "light"}
        browser.call("Emulation.setEmulatedMedia", features=[scheme])
        before = sum(proxy.received for proxy in proxies)
        start = time.monotonic()
        browser.call("Page.navigate", url=url)
        picture, since = b"", start
        while time.monotonic() < start + limit and time.monotonic() < max(since + 3, start + 8):
            time.sleep(0.25)
            try:
                now = shoot(browser)
            except RuntimeError:  # the page is being replaced
                continue
            if now != picture:
                picture, since = now, time.monotonic()
        file.write_bytes(picture)
        return since - start, sum(proxy.received for proxy in proxies) - before


def show_kinegraph(view: View, file: Path, dark: bool) -> tuple[float, int]:
    view.config.view()
    viewer = view.config.viewer()
    viewer.setCamera(view.position, view.target)
    proxy = Proxy(urllib.parse.urlsplit(viewer.url).port or 80)
    try:
        return watch(f"http://localhost:{proxy.port}/", [proxy], file, dark)
    finally:
        view.config.view_close()


def show_viser(view: View, file: Path, dark: bool) -> tuple[float, int]:
    import viser

    server = viser.ViserServer(port=8771, verbose=False)
    server.gui.configure_theme(dark_mode=dark)
    server.scene.set_up_direction("+z")
    server.scene.add_grid("/grid", infinite_grid=True)

    def place(client: Any) -> None:
        client.camera.up_direction = (0.0, 0.0, 1.0)
        client.camera.position, client.camera.look_at = view.position, view.target
        client.camera.fov = np.deg2rad(FIELD_OF_VIEW)

    server.on_client_connect(place)
    for part in view.parts:
        color, opacity = tuple(float(x) for x in part.color[:3]), float(part.color[3])
        server.scene.add_mesh_simple(
            f"/{part.name}", part.vertices, part.triangles, color=color, opacity=None if opacity == 1 else opacity
        )
    proxy = Proxy(8771)
    try:
        return watch(f"http://localhost:{proxy.port}", [proxy], file, dark)
    finally:
        server.stop()


def show_meshcat(view: View, file: Path, dark: bool) -> tuple[float, int]:
    import meshcat
    import meshcat.geometry as g

    vis = meshcat.Visualizer()
    for part in view.parts:
        red, green, blue = (round(255 * x) for x in part.color[:3])
        material = g.MeshPhongMaterial(
            color=red << 16 | green << 8 | blue, opacity=float(part.color[3]), transparent=bool(part.color[3] < 1)
        )
        vertices = part.vertices - view.target  # its target is the origin
        corners = vertices[part.triangles].reshape(-1, 3)  # flat triangles: it has no normals of its own
        vis[part.name].set_object(g.TriangularMeshGeometry(corners, np.arange(len(corners)).reshape(-1, 3)), material)
    eye = view.position - view.target
    vis["/Cameras/default/rotated/<object>"].set_property("position", [eye[0], eye[2], -eye[1]])
    vis["/Cameras/default/rotated/<object>"].set_property("fov", FIELD_OF_VIEW)
    address = urllib.parse.urlsplit(vis.url())
    proxy = Proxy(address.port or 80)
    return watch(f"http://localhost:{proxy.port}{address.path}", [proxy], file, dark)


def show_rerun(view: View, file: Path, dark: bool) -> tuple[float, int]:
    import rerun as rr
    import rerun.blueprint as rrb

    rr.init("look", recording_id=f"look{time.monotonic()}")
    ports = [free_port() for _ in range(2)]  # of former scenes, they are not freed
    address = rr.serve_grpc(grpc_port=ports[0], cors_allow_origin=["*"])
    rr.serve_web_viewer(web_port=ports[1], open_browser=False)
    eye = rrb.EyeControls3D(position=view.position, look_target=view.target, eye_up=(0.0, 0.0, 1.0))
    rr.send_blueprint(rrb.Blueprint(rrb.Spatial3DView(eye_controls=eye), collapse_panels=True))
    rr.log("/", rr.ViewCoordinates.RIGHT_HAND_Z_UP, static=True)
    for part in view.parts:
        rr.log(
            part.name,
            rr.Mesh3D(
                vertex_positions=part.vertices, triangle_indices=part.triangles, albedo_factor=[*map(float, part.color)]
            ),
            static=True,
        )
    data, page = (Proxy(port) for port in ports)
    url = urllib.parse.quote(address.replace(str(ports[0]), str(data.port)), safe="")
    try:
        return watch(f"http://localhost:{page.port}/?url={url}", [page, data], file, dark)
    finally:
        rr.disconnect()


def show_mujoco(view: View, file: Path, dark: bool) -> tuple[float, int]:
    import mujoco

    def numbers(values: Any) -> str:
        return " ".join(f"{x:.6g}" for x in np.ravel(values))

    start = time.monotonic()
    forward = (view.target - view.position) / np.linalg.norm(view.target - view.position)
    right = np.cross(forward, [0, 0, 1])
    right /= np.linalg.norm(right)
    meshes, geoms = [], []
    for i, part in enumerate(view.parts):
        if len(part.vertices) < 4:
            continue
        arrays = f'vertex="{numbers(part.vertices)}" face="{numbers(part.triangles)}"'
        meshes.append(f'<mesh name="m{i}" inertia="shell" {arrays}/>')
        geoms.append(f'<geom type="mesh" mesh="m{i}" rgba="{numbers(part.color)}"/>')
    size = np.ptp(np.concatenate([part.vertices for part in view.parts]), axis=0).max()
    model = mujoco.MjModel.from_xml_string(f"""<mujoco><visual>
      <headlight diffuse="0.6 0.6 0.6" ambient="0.3 0.3 0.3" specular="0 0 0"/><rgba haze="0.15 0.25 0.35 1"/>
      <global offwidth="{WIDTH}" offheight="{HEIGHT}"/><quality shadowsize="4096" offsamples="8"/></visual>
      <statistic extent="{size}"/><asset>
      <texture type="skybox" builtin="gradient" rgb1="0.3 0.5 0.7" rgb2="0 0 0" width="512" height="3072"/>
      <texture type="2d" name="ground" builtin="checker" mark="edge" rgb1="0.2 0.3 0.4" rgb2="0.1 0.2 0.3"
       markrgb="0.8 0.8 0.8" width="300" height="300"/>
      <material name="ground" texture="ground" texuniform="true" texrepeat="5 5" reflectance="0.2"/>
      {"".join(meshes)}</asset><worldbody><light pos="0 0 3.5" dir="0 0 -1" directional="true"/>
      <geom type="plane" size="0 0 .05" material="ground"/>{"".join(geoms)}
      <camera name="eye" pos="{numbers(view.position)}" fovy="{FIELD_OF_VIEW}"
       xyaxes="{numbers(right)} {numbers(np.cross(right, forward))}"/></worldbody></mujoco>""")
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    with mujoco.Renderer(model, HEIGHT, WIDTH) as renderer:
        renderer.update_scene(data, camera="eye")
        writePng(str(file), renderer.render())
    return time.monotonic() - start, 0


VIEWERS = {
    "kinegraph": show_kinegraph,
    "viser": show_viser,
    "meshcat": show_meshcat,
    "rerun": show_rerun,
    "mujoco": show_mujoco,
}


@contextmanager
def reported(viewer: str, scene: str) -> Iterator[None]:
    """Goes on with the next viewer if one fails."""
    try:
        yield
    except Exception as error:
        print(f"{viewer}, {scene}: {error!r}", file=sys.stderr)


def table(viewers: list[str], shown: dict[str, dict[str, tuple[float, int]]], lines: dict[str, dict[str, int]]) -> str:
    """Returns the results as Markdown; `shown` has seconds and bytes by scene and viewer."""

    def row(name: str, cells: list[str]) -> str:
        return f"| {' | '.join([name, *cells])} |"

    versions = [
        f"{viewer} {importlib.metadata.version(MODULES[viewer])}" for viewer in viewers if viewer != "kinegraph"
    ]
    rows = [
        row("", [*(["Kinegraph"] if "kinegraph" in viewers else []), *versions]),
        row("---", ["---"] * len(viewers)),
    ]
    for scene, results in shown.items():
        cells = []
        for viewer in viewers:
            seconds, received = results.get(viewer, (0.0, 0))
            size = f"{received / 1e6:.2f} MB, " if received else ""
            cells.append(f"{size}{seconds:.1f} s" if viewer in results else "failed")
        rows.append(row(f"opening `{scene}`", cells))
    for name in FEATURES:
        rows.append(row(name, [str(lines[name][viewer] or "-") for viewer in viewers]))
    return "\n".join(rows)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--only", default=",".join(VIEWERS))
    parser.add_argument("--scenes", default=",".join(SCENES))
    parser.add_argument("--dark", action="store_true")
    options = parser.parse_args()
    options.folder.mkdir(parents=True, exist_ok=True)
    installed = [name for name in options.only.split(",") if importlib.util.find_spec(name)]
    shown: dict[str, dict[str, tuple[float, int]]] = {}
    for scene in options.scenes.split(","):
        shown[scene] = {}
        for viewer in installed:
            file = options.folder / f"{viewer}_{scene}{'_dark' if options.dark else ''}.png"
            with reported(viewer, scene):
                shown[scene][viewer] = VIEWERS[viewer](view_of(scene), file, options.dark)
    print(table(installed, shown, features(installed)))


if __name__ == "__main__":
    main()
