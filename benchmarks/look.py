"""Renders one scene with one camera in several viewers, for comparison by eye.

    python benchmarks/look.py FOLDER                    kinegraph, and the installed ones of viser, meshcat, mujoco
    python benchmarks/look.py FOLDER --dark --only kinegraph,viser

The scene is a Panda (with detailed meshes if example-robot-data is installed) between boxes and a ball on the floor,
960x720. Viewers keep their default lights and materials. MuJoCo gets the checker floor and the sky of its own example
scenes. The pictures are FOLDER/<viewer>.png. Needs Chromium and `websockets`.
"""

from __future__ import annotations

import argparse
import base64
import importlib.util
import sys
import time
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

import kinegraph as kg

sys.path.append(str(Path(__file__).parent.parent))

from tests.viewer.browser import Browser

from kinegraph.png import writePng

WIDTH, HEIGHT = 960, 720
POSITION, TARGET = np.array([1.55, 1.45, 1.15]), np.array([0.12, 0.05, 0.42])
FIELD_OF_VIEW = 40.0  # degrees, vertical
OBJECTS = {
    "crate": ([0.3, 0.3, 0.2], [0.5, -0.35, 0.1], [0.85, 0.55, 0.25]),
    "brick": ([0.12, 0.25, 0.1], [0.55, 0.3, 0.05], [0.75, 0.25, 0.2]),
    "wall": ([0.08, 0.9, 0.5], [-0.5, -0.1, 0.25], [0.55, 0.62, 0.7]),
    "ball": ([0.09], [0.3, 0.55, 0.09], [0.2, 0.5, 0.85]),
}


@dataclass
class Part:
    """Triangles of one color, in world coordinates."""

    name: str
    vertices: np.ndarray
    triangles: np.ndarray
    color: np.ndarray  # rgb in 0..1


def scene() -> kg.Config:
    C = kg.Config()
    C.addFile(kg.raiPath("panda/panda.g"))
    for name, (size, place, color) in OBJECTS.items():
        frame = C.addFrame(name).setPosition(place).setColor(color)
        frame.setShape(kg.ST.sphere if len(size) == 1 else kg.ST.box, size)
    return C


def robot_parts(config: kg.Config) -> list[Part]:
    """Returns the visible parts of the robot in pieces of one color: not every viewer has colors of vertices."""
    parts = []
    for frame in config:
        color = frame.asDict().get("color", [0.8, 0.8, 0.8])
        if frame.name in OBJECTS or frame.getShapeType() in (kg.ST.none, kg.ST.marker) or len(color) > 3:
            continue
        source = kg.Config().addFrame("mesh")
        try:
            source.setMeshFile(frame.asDict()["visual_mesh"].strip("<>"))
        except (KeyError, kg.Error):
            source = frame
        vertices, triangles, colors = source.getMesh()
        vertices = vertices @ frame.getRotationMatrix().T + frame.getPosition()
        if len(colors) != len(vertices):
            colors = np.tile(np.array(color) * 255, (len(vertices), 1))
        of_triangle = np.round(np.asarray(colors, float)[triangles[:, 0], :3]).astype(int)
        for i, shade in enumerate(np.unique(of_triangle, axis=0)):
            own = triangles[(of_triangle == shade).all(axis=1)]
            used, indices = np.unique(own, return_inverse=True)
            parts.append(Part(f"{frame.name}_{i}", vertices[used], indices.reshape(-1, 3), shade / 255))
    return parts


def shoot(browser: Browser, file: Path) -> None:
    file.write_bytes(base64.b64decode(browser.call("Page.captureScreenshot", format="png")["data"]))


def open_browser(browser: Browser, url: str, dark: bool) -> None:
    browser.call("Emulation.setDeviceMetricsOverride", width=WIDTH, height=HEIGHT, deviceScaleFactor=1, mobile=False)
    scheme = {"name": "prefers-color-scheme", "value": "dark" if dark else "light"}
    browser.call("Emulation.setEmulatedMedia", features=[scheme])
    browser.call("Page.navigate", url=url)


def show_kinegraph(parts: list[Part], file: Path, dark: bool) -> None:
    C = scene()
    C.view()
    viewer = C.viewer()
    with Browser() as browser:
        open_browser(browser, viewer.url, dark)
        browser.wait_for("window.kinegraph && kinegraph.frames() > 0")
        viewer.setCamera(POSITION, TARGET)
        time.sleep(2)
        browser.wait_for("kinegraph.idle()")
        shoot(browser, file)
    C.view_close()


def show_viser(parts: list[Part], file: Path, dark: bool) -> None:
    import viser

    server = viser.ViserServer(port=8771, verbose=False)
    server.gui.configure_theme(dark_mode=dark)
    server.scene.set_up_direction("+z")
    server.scene.add_grid("/grid", width=4, height=4)

    def place(client: Any) -> None:
        client.camera.up_direction = (0.0, 0.0, 1.0)
        client.camera.position, client.camera.look_at = POSITION, TARGET
        client.camera.fov = np.deg2rad(FIELD_OF_VIEW)

    server.on_client_connect(place)
    for part in parts:
        server.scene.add_mesh_simple(f"/{part.name}", part.vertices, part.triangles, color=tuple(part.color))
    for name, (size, position, color) in OBJECTS.items():
        if len(size) == 1:
            server.scene.add_icosphere(f"/{name}", size[0], color=tuple(color), subdivisions=4, position=position)
        else:
            server.scene.add_box(f"/{name}", color=tuple(color), dimensions=tuple(size), position=position)
    with Browser() as browser:
        open_browser(browser, "http://localhost:8771", dark)
        time.sleep(25)
        shoot(browser, file)
    server.stop()


def show_meshcat(parts: list[Part], file: Path, dark: bool) -> None:
    import meshcat
    import meshcat.geometry as g
    from meshcat.transformations import translation_matrix

    def material(color: Any) -> Any:
        red, green, blue = (round(255 * x) for x in color)
        return g.MeshPhongMaterial(color=red << 16 | green << 8 | blue)

    vis = meshcat.Visualizer()
    for part in parts:
        corners = part.vertices[part.triangles].reshape(-1, 3)
        triangles = np.arange(len(corners)).reshape(-1, 3)
        vis[part.name].set_object(g.TriangularMeshGeometry(corners, triangles), material(part.color))
    for name, (size, position, color) in OBJECTS.items():
        shape = g.Sphere(size[0]) if len(size) == 1 else g.Box(size)
        vis[name].set_object(shape, material(color))
        vis[name].set_transform(translation_matrix(position))
    eye = POSITION - TARGET
    vis["/Cameras/default"].set_transform(translation_matrix(TARGET))
    vis["/Cameras/default/rotated/<object>"].set_property("position", [eye[0], eye[2], -eye[1]])
    vis["/Cameras/default/rotated/<object>"].set_property("fov", FIELD_OF_VIEW)
    with Browser() as browser:
        open_browser(browser, vis.url(), dark)
        time.sleep(25)
        shoot(browser, file)


def show_mujoco(parts: list[Part], file: Path, dark: bool) -> None:
    import mujoco

    def numbers(values: Any) -> str:
        return " ".join(f"{x:.6g}" for x in np.ravel(values))

    forward = (TARGET - POSITION) / np.linalg.norm(TARGET - POSITION)
    right = np.cross(forward, [0, 0, 1])
    right /= np.linalg.norm(right)
    meshes, geoms = [], []
    for i, part in enumerate(parts):
        if len(part.vertices) < 4:
            continue
        meshes.append(
            f'<mesh name="m{i}" inertia="shell" vertex="{numbers(part.vertices)}" face="{numbers(part.triangles)}"/>'
        )
        geoms.append(f'<geom type="mesh" mesh="m{i}" rgba="{numbers(part.color)} 1"/>')
    for size, position, color in OBJECTS.values():
        kind = "sphere" if len(size) == 1 else "box"
        half = size if len(size) == 1 else np.array(size) / 2
        geoms.append(
            f'<geom type="{kind}" size="{numbers(half)}" pos="{numbers(position)}" rgba="{numbers(color)} 1"/>'
        )
    model = mujoco.MjModel.from_xml_string(f"""<mujoco><visual>
      <headlight diffuse="0.6 0.6 0.6" ambient="0.3 0.3 0.3" specular="0 0 0"/><rgba haze="0.15 0.25 0.35 1"/>
      <global offwidth="{WIDTH}" offheight="{HEIGHT}"/><quality shadowsize="4096" offsamples="8"/></visual><asset>
      <texture type="skybox" builtin="gradient" rgb1="0.3 0.5 0.7" rgb2="0 0 0" width="512" height="3072"/>
      <texture type="2d" name="ground" builtin="checker" mark="edge" rgb1="0.2 0.3 0.4" rgb2="0.1 0.2 0.3"
       markrgb="0.8 0.8 0.8" width="300" height="300"/>
      <material name="ground" texture="ground" texuniform="true" texrepeat="5 5" reflectance="0.2"/>
      {"".join(meshes)}</asset><worldbody><light pos="0 0 3.5" dir="0 0 -1" directional="true"/>
      <geom type="plane" size="0 0 .05" material="ground"/>{"".join(geoms)}
      <camera name="eye" pos="{numbers(POSITION)}" fovy="{FIELD_OF_VIEW}"
       xyaxes="{numbers(right)} {numbers(np.cross(right, forward))}"/></worldbody></mujoco>""")
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    with mujoco.Renderer(model, HEIGHT, WIDTH) as renderer:
        renderer.update_scene(data, camera="eye")
        writePng(str(file), renderer.render())


VIEWERS = {
    "kinegraph": show_kinegraph,
    "viser": show_viser,
    "meshcat": show_meshcat,
    "mujoco": show_mujoco,
}


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--only", default=",".join(VIEWERS))
    parser.add_argument("--dark", action="store_true")
    options = parser.parse_args()
    options.folder.mkdir(parents=True, exist_ok=True)
    parts = robot_parts(scene())
    for name in options.only.split(","):
        if importlib.util.find_spec(name) is None:
            print(f"{name}: not installed")
            continue
        file = options.folder / f"{name}{'_dark' if options.dark else ''}.png"
        VIEWERS[name](parts, file, options.dark)
        print(file)


if __name__ == "__main__":
    main()
