"""What a program can do in each viewer, as lines of Python that `look.py` runs.

A snippet of a viewer may use its own object `v` (made by SETUP) and numpy as `np`. None: there is no such call. The
count of a snippet's lines is what the table shows; a snippet that raises counts as absent.
"""

from __future__ import annotations

import os

os.environ.setdefault("MUJOCO_GL", "egl")  # before MuJoCo is imported: it draws without a display

SETUP = {
    "kinegraph": "import kinegraph as kg\nC = kg.Config()\nC.addFrame('f')\nC.view()\nv = C.viewer()",
    "viser": "import viser\nv = viser.ViserServer(port=8773, verbose=False)",
    "meshcat": "import meshcat, meshcat.geometry as g\nv = meshcat.Visualizer()",
    "rerun": "import rerun as v\nv.init('look', spawn=False)\nv.memory_recording()",
    "mujoco": (
        'import mujoco\nm = mujoco.MjModel.from_xml_string(\'<mujoco><worldbody><body name="f"><joint type="hinge"/>'
        '<geom size=".1"/></body><camera name="c" pos="0 0 3"/></worldbody></mujoco>\')\n'
        "d = mujoco.MjData(m)\nmujoco.mj_forward(m, d)\nv = mujoco.Renderer(m, 60, 80)\nv.update_scene(d)"
    ),
}
POINTS = "np.zeros((4, 3))"
ROTATED = "[[1, 0, 0], [0, 1, 0], [0, 0, 1]]"

FEATURES: dict[str, dict[str, str | None]] = {
    "button with a callback": {
        "kinegraph": "v.button('go').onClick(print)",
        "viser": "v.gui.add_button('go').on_click(print)",
        "meshcat": None,
        "rerun": None,
        "mujoco": None,
    },
    "slider with a value": {
        "kinegraph": "v.slider('width', 0, 1, .5).value",
        "viser": "v.gui.add_slider('width', 0, 1, .01, .5).value",
        "meshcat": None,
        "rerun": None,
        "mujoco": None,
    },
    "check box, choice, text, folder": {
        "kinegraph": "with v.folder('a'):\n    v.check('b'), v.choice('c', ['x', 'y']), v.text('d', 'e')",
        "viser": (
            "with v.gui.add_folder('a'):\n    v.gui.add_checkbox('b', False), v.gui.add_dropdown('c', ['x', 'y']), "
            "v.gui.add_text('d', 'e')"
        ),
        "meshcat": None,
        "rerun": None,
        "mujoco": None,
    },
    "callback of clicks on shapes": {
        "kinegraph": "v.onClick(print)",
        "viser": "v.scene.add_box('b', (1, 1, 1)).on_click(print)",
        "meshcat": None,
        "rerun": None,
        "mujoco": None,
    },
    "arrow": {
        "kinegraph": "v.arrow('a', [0, 0, 0], [0, 0, 1])",
        "viser": "v.scene.add_arrows('a', np.array([[[0, 0, 0], [0, 0, 1]]], float), (255, 0, 0))",
        "meshcat": None,
        "rerun": "v.log('a', v.Arrows3D(vectors=[[0, 0, 1]]))",
        "mujoco": (
            "s = v.scene\ngeom = s.geoms[s.ngeom]\nmujoco.mjv_initGeom(geom, mujoco.mjtGeom.mjGEOM_ARROW, "
            "np.array([.02, .02, 1]), np.zeros(3), np.eye(3).ravel(), np.ones(4, np.float32))\ns.ngeom += 1"
        ),
    },
    "line of a width": {
        "kinegraph": "v.line('l', [[0, 0, 0], [0, 0, 1]], width=4)",
        "viser": "v.scene.add_line_segments('l', np.array([[[0, 0, 0], [0, 0, 1]]], float), (255, 0, 0), line_width=4)",
        "meshcat": None,
        "rerun": "v.log('l', v.LineStrips3D([[[0, 0, 0], [0, 0, 1]]], radii=.01))",
        "mujoco": (
            "s = v.scene\ngeom = s.geoms[s.ngeom]\nmujoco.mjv_initGeom(geom, mujoco.mjtGeom.mjGEOM_LINE, np.zeros(3), "
            "np.zeros(3), np.eye(3).ravel(), np.ones(4, np.float32))\nmujoco.mjv_connector(geom, "
            "mujoco.mjtGeom.mjGEOM_LINE, 4, np.zeros(3), np.array([0, 0, 1.]))\ns.ngeom += 1"
        ),
    },
    "text at a point": {
        "kinegraph": "v.label('t', [0, 0, 1], 'here')",
        "viser": "v.scene.add_label('t', 'here', position=(0, 0, 1))",
        "meshcat": None,
        "rerun": "v.log('t', v.Points3D([[0, 0, 1]], labels='here'))",
        "mujoco": "v.scene.geoms[0].label = 'here'",
    },
    "points of a size and colors": {
        "kinegraph": f"v.points('p', {POINTS}, {POINTS}, size=.01)",
        "viser": f"v.scene.add_point_cloud('p', {POINTS}, {POINTS}, point_size=.01)",
        "meshcat": f"v['p'].set_object(g.PointCloud({POINTS}.T, {POINTS}.T, size=.01))",
        "rerun": f"v.log('p', v.Points3D({POINTS}, colors={POINTS}, radii=.01))",
        "mujoco": None,
    },
    "what a camera sees, with its image": {
        "kinegraph": "v.frustum('c', 'f', image=np.zeros((4, 4, 3), np.uint8))",
        "viser": "v.scene.add_camera_frustum('c', .8, 1., image=np.zeros((4, 4, 3), np.uint8))",
        "meshcat": None,
        "rerun": (
            f"v.log('c', v.Pinhole(focal_length=4, width=4, height=4), v.Transform3D(mat3x3={ROTATED}))\n"
            "v.log('c/image', v.Image(np.zeros((4, 4, 3), np.uint8)))"
        ),
        "mujoco": None,
    },
    "growing plot of numbers": {
        "kinegraph": "v.log('cost', 1.)",
        "viser": (
            "import viser.uplot as u\nv.gui.add_uplot(data=(np.zeros(2), np.ones(2)), series=(u.Series(label='t'), "
            "u.Series(label='cost')))"
        ),
        "meshcat": None,
        "rerun": "v.log('cost', v.Scalars(1.))",
        "mujoco": None,
    },
    "notification": {
        "kinegraph": "v.notify('done')",
        "viser": "for client in v.get_clients().values():\n    client.add_notification('done', '')",
        "meshcat": None,
        "rerun": "v.log('log', v.TextLog('done'))",
        "mujoco": None,
    },
    "picture without a browser or window": {
        "kinegraph": "v.getRgb()[0, 0]",
        "viser": None,
        "meshcat": None,
        "rerun": None,
        "mujoco": "v.render()[0, 0]",
    },
    "page that needs no program": {
        "kinegraph": "v.asHtml()[0]",
        "viser": "v.get_scene_serializer().serialize()[0]",
        "meshcat": "v.static_html()[0]",
        "rerun": None,
        "mujoco": None,
    },
}


def lines_needed(viewer: str, setup: dict[str, object], snippet: str | None) -> int:
    """Runs a snippet; returns the number of its lines, or 0 if there is none or it raises."""
    if snippet is None:
        return 0
    try:
        exec(snippet, setup)
    except Exception as error:  # whatever the version at hand says
        print(f"{viewer}: {snippet.splitlines()[0]} ...: {error!r}")
        return 0
    return len(snippet.splitlines())


def features(viewers: list[str]) -> dict[str, dict[str, int]]:
    """Returns the lines needed for each feature in each viewer; 0: it is absent."""
    import numpy as np

    table: dict[str, dict[str, int]] = {name: {} for name in FEATURES}
    for viewer in viewers:
        scope: dict[str, object] = {"np": np}
        exec(SETUP[viewer], scope)
        for name, snippets in FEATURES.items():
            table[name][viewer] = lines_needed(viewer, scope, snippets[viewer])
    return table
