"""Pictures that viewers and the command make without a display."""

import os
import struct
import subprocess
import sys
import time
import zlib
from pathlib import Path

import numpy as np
import pytest

import kinegraph as ry
from camera_scene import FORWARD, HEIGHT, WIDTH, needs_egl, scene


def decoded(file):
    """The pixels of a PNG file as writePng writes it."""
    data = file.read_bytes()
    assert data[:8] == b"\x89PNG\r\n\x1a\n"
    chunks, at = {}, 8
    while at < len(data):
        size, kind = struct.unpack(">I4s", data[at : at + 8])
        body = data[at + 8 : at + 8 + size]
        assert struct.unpack(">I", data[at + 8 + size : at + 12 + size])[0] == zlib.crc32(kind + body)
        chunks[kind] = body
        at += 12 + size
    width, height = struct.unpack(">II", chunks[b"IHDR"][:8])
    lines = np.frombuffer(zlib.decompress(chunks[b"IDAT"]), np.uint8).reshape(height, 1 + 3 * width)
    return lines[:, 1:].reshape(height, width, 3)


@needs_egl
def test_a_viewer_makes_pictures_without_a_browser(tmp_path):
    C, _ = scene("ball: { X: [2 0 2], shape: sphere, size: [.3], color: [1 0 0] }")
    assert C.view(offscreen=True) == 0
    viewer = C.viewer()
    rgb, depth = viewer.getRgb(), viewer.getDepth()
    assert rgb.shape == (500, 600, 3) and depth.shape == (500, 600)
    np.testing.assert_allclose(viewer.getCamera_fxycxy(), [866.03, 866.03, 300, 250], atol=0.01)
    viewer.setCamera("camera")
    assert viewer.getRgb().shape == (HEIGHT, WIDTH, 3)
    assert viewer.getDepth()[HEIGHT // 2, WIDTH // 2] == pytest.approx(1.7, abs=1e-3)
    prefix = str(tmp_path / "video" / "z.")
    assert [viewer.savePng(prefix) for _ in range(2)] == [prefix + "000000.png", prefix + "000001.png"]
    assert viewer.savePng(prefix, 41) == prefix + "000041.png"
    assert viewer.savePng(str(tmp_path / "one.png")) == str(tmp_path / "one.png")
    assert viewer.savePng(str(tmp_path / "two.PNG")) == str(tmp_path / "two.PNG")
    with pytest.raises(ry.ArgumentError, match=r"three.jpg' ends in .jpg, but pictures are saved as PNG"):
        viewer.savePng(str(tmp_path / "three.jpg"))
    np.testing.assert_array_equal(decoded(tmp_path / "one.png"), viewer.getRgb())
    viewer.setCamera(None)
    assert viewer.getRgb().shape == (500, 600, 3)
    assert not viewer.clients()


def reddest(rgb) -> np.ndarray:
    """Returns the mask of red pixels."""
    return np.argwhere((rgb[..., 0] > 100) & (rgb[..., 1] < 60))


@needs_egl
def test_pictures_of_a_motion_show_the_slice_that_is_viewed():
    C = ry.Config()
    C.addText("world: {} arm (world): { joint: transX }")
    C.addFrame("ball", "arm").setRelativePosition([0, 0, 1]).setShape(ry.ST.sphere, [0.3]).setColor([1, 0, 0])
    komo = ry.KOMO(C, 1, 10, 1, False)
    komo.initWithPath(np.linspace(0.1, 1, 10).reshape(10, 1))
    seen = []
    for t in (0, 9):
        komo.view_slice(t)
        seen.append(komo.viewer().getRgb())
        D = komo.getConfiguration(t)
        D.view(offscreen=True)
        np.testing.assert_array_equal(reddest(seen[-1]), reddest(D.viewer().getRgb()))
    assert len(reddest(seen[0])) > 100 and not np.array_equal(reddest(seen[0]), reddest(seen[1]))


@needs_egl
def test_pictures_show_what_is_on_top_of_the_scene():
    C, _ = scene("")
    viewer = C.viewer()
    plain = viewer.getRgb()
    image = np.zeros((10, 20, 3), np.uint8)
    image[:, :10], image[:, 10:] = [250, 0, 0], [0, 0, 250]
    assert viewer.setQuad(-1, image, 0.1, 0.2, 0.1) == 0  # in heights of the picture, which are 500 pixels
    assert viewer.setQuad(-1, image[..., 0].copy(), 0.5, 0.5, 0.02) == 1
    rgb = viewer.getRgb()
    assert (rgb[100:150, 50:100] == [250, 0, 0]).all() and (rgb[100:150, 100:150] == [0, 0, 250]).all()
    assert (rgb[250:260, 250:260] == 250).all() and (rgb[250:260, 260:270] == 0).all()
    rgb[100:150, 50:150], rgb[250:260, 250:270] = plain[100:150, 50:150], plain[250:260, 250:270]
    np.testing.assert_array_equal(rgb, plain)
    assert not viewer.clients()
    with pytest.raises(ry.ArgumentError, match="no pixels"):
        viewer.setQuad(-1, np.zeros((0, 3, 3), np.uint8), 0, 0, 1)


@needs_egl
def test_pictures_show_the_message(monkeypatch):
    C, _ = scene("ball: { X: [2 0 2], shape: sphere, size: [.3], color: [1 0 0] }")
    viewer = C.viewer()
    plain, depth = viewer.getRgb(), viewer.getDepth()
    C.view(False, "slice 3", offscreen=True)
    short = viewer.getRgb()
    changed = np.nonzero((short != plain).any(axis=2))
    assert changed[0].min() >= 12 and changed[0].max() < 12 + 18 + 20  # one line in the corner
    assert changed[1].min() >= 12 and 60 < changed[1].max() < 150
    assert (short[changed].sum(axis=1) < 200).sum() > 15  # dark letters
    np.testing.assert_array_equal(viewer.getDepth(), depth)
    C.view(offscreen=True)  # it stays
    np.testing.assert_array_equal(viewer.getRgb(), short)
    viewer.view(False, "slice 3\n" + "word " * 40, offscreen=True)
    longer = np.nonzero((viewer.getRgb() != plain).any(axis=2))
    assert longer[0].max() > changed[0].max() + 2 * 18
    assert longer[1].max() < 600 - 12
    viewer.visualsOnly()
    np.testing.assert_array_equal(viewer.getRgb(), plain)
    viewer.visualsOnly(False)
    monkeypatch.setattr("kinegraph.compatibility.parameters._values", {"Render/renderText": False})
    np.testing.assert_array_equal(viewer.getRgb(), plain)
    monkeypatch.undo()
    C.view(False, "", offscreen=True)
    np.testing.assert_array_equal(viewer.getRgb(), plain)
    assert not viewer.isOpen()


@needs_egl
def test_pictures_look_as_parameters_say(monkeypatch):
    C, _ = scene("wall: { X: [2 0 2], shape: box, size: [1 9 9], color: [.6 .4 .2] }")
    viewer = C.viewer()
    viewer.setCamera("camera")
    wanted = np.array([153, 102, 51])
    values = {}
    monkeypatch.setattr("kinegraph.compatibility.parameters._values", values)
    lit = viewer.getRgb()[HEIGHT // 2, WIDTH // 2]
    assert np.abs(lit - wanted).max() > 5
    values["Render/flatColors"] = True
    np.testing.assert_allclose(viewer.getRgb()[HEIGHT // 2, WIDTH // 2], wanted, atol=2)
    values.clear()
    values["Render/lights"] = [-5, 0, 0.8]  # right in front of the wall
    assert viewer.getRgb()[HEIGHT // 2, WIDTH // 2].sum() > lit.sum() + 20
    values.clear()
    values["Render/renderPolygonLines"] = True
    assert (np.abs(viewer.getRgb().astype(int) - [223, 227, 234]) < 2).all(axis=2).mean() > 0.5  # one sees through
    for name, value, expected in [
        ("Render/lights", [1, 2], "the 3 coordinates"),
        ("Render/lights", "sun", "list of numbers"),
        ("Render/flatColors", [1, 2], "True or False"),
    ]:
        values.clear()
        values[name] = value
        with pytest.raises(ry.ArgumentError, match=expected):
            viewer.getRgb()


@needs_egl
def test_a_frame_camera_init_is_where_a_viewer_starts():
    C = ry.Config()
    C.addText(
        f"wall: {{ X: [2.5 0 2], shape: box, size: [1 9 9] }}\ncamera_init: {{ X: {FORWARD}, width: 64, height: 48 }}"
    )
    np.testing.assert_allclose(C.viewer().getDepth(), np.full((48, 64), 2.0), atol=1e-4)


@needs_egl
def test_the_command_renders_a_file(tmp_path):
    output = tmp_path / "panda.png"
    arguments = [
        "render",
        ry.raiPath("scenarios/pandaSingle.g"),
        "-o",
        str(output),
        "--camera",
        "cameraTop",
        "--size",
        "160x90",
    ]
    program = subprocess.run([sys.executable, "-m", "kinegraph", *arguments], capture_output=True, text=True)
    assert program.returncode == 0, program.stderr
    assert program.stdout == f"{output}\n"
    picture = decoded(output)
    assert picture.shape == (90, 160, 3) and len(np.unique(picture.reshape(-1, 3), axis=0)) > 20


@needs_egl
def test_an_image_takes_a_fraction_of_a_second(panda):
    """A bound that catches a lost cache; what it takes is in benchmarks."""
    view = ry.CameraView(panda)
    view.setCamera("cameraTop")
    view.computeImageAndDepth()
    times = []
    for _ in range(5):
        started = time.process_time()
        view.computeImageAndDepth()
        times.append(time.process_time() - started)
    assert min(times) < 0.2


def test_without_egl_the_error_names_the_packages(tmp_path):
    """A library path without libEGL cannot be had here, so one that is no library stands in for it."""
    (tmp_path / "libEGL.so.1").write_text("no library")
    code = "import kinegraph as ry; ry.CameraView(ry.Config()).computeImageAndDepth()"
    environment = {**os.environ, "LD_LIBRARY_PATH": f"{tmp_path}:{os.environ.get('LD_LIBRARY_PATH', '')}"}
    program = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, env=environment)
    assert program.returncode == 1
    if "computeImageAndDepth" in program.stderr:
        assert "libEGL.so.1" in program.stderr and "apt-get install libegl1 libgl1-mesa-dri" in program.stderr


@needs_egl
def test_the_examples_of_planning_save_pictures_with_the_paths_in_them(tmp_path):
    """Paths are green, which nothing else in these scenes is."""
    example = Path(__file__).parent.parent.parent.parent / "examples" / "11_plan_motions.py"
    subprocess.run([sys.executable, str(example), str(tmp_path)], check=True, stdout=subprocess.PIPE, timeout=120)
    pictures = sorted(tmp_path.iterdir())
    assert [picture.stem for picture in pictures] == [
        "around_the_column",
        "around_what_was_seen",
        "through_the_door",
        "two_arms",
        "with_a_glass",
    ]
    for picture in pictures:
        colors = decoded(picture)
        red, green, blue = (colors[..., i].astype(int) for i in range(3))
        assert colors.shape == (360, 480, 3)
        assert np.sum((green > red + 40) & (green > blue + 20)) > 60, picture.name


@needs_egl
def test_translucent_shapes_are_mixed_with_what_is_behind_them() -> None:
    def seen(alpha: float, background: list[float]) -> np.ndarray:
        C = ry.Config()
        C.addFrame("box").setShape(ry.ST.box, [0.5, 0.5, 0.5]).setColor([0.1, 0.2, 0.8, alpha]).setPosition([0, 0, 1])
        ry.params_add({"Render/backgroundColor": background})
        C.view(offscreen=True)
        C.viewer().setCamera([0, -3, 1.2], [0, 0, 1.2])
        image = C.viewer().getRgb().astype(float)
        return image[image.shape[0] // 2, image.shape[1] // 2]

    white, green = [1.0, 1.0, 1.0], [0.2, 0.5, 0.3]
    try:
        for background in (white, green):
            assert np.allclose(seen(0.0, background), 255 * np.array(background), atol=1)
        assert np.allclose(seen(1.0, white), seen(1.0, green))
        behind = (seen(0.5, white) - seen(0.5, green)) / (255 * (np.array(white) - green))
    finally:
        ry.params_clear()
    assert np.allclose(behind, 0.5, atol=0.02)


def test_a_problem_has_a_viewer_before_it_has_a_scene() -> None:
    komo = ry.KOMO()
    assert komo.viewer() is komo.get_viewer()
