"""Textures are visible and upright on the page and in its saved files."""

from __future__ import annotations

import struct
import zlib
from pathlib import Path

import numpy as np
import pytest

import kinegraph as kg

from .browser import Browser

RED, GREEN, BLUE, YELLOW = (255, 0, 0), (0, 255, 0), (0, 0, 255), (255, 255, 0)


def write_png(path: Path, pixels: np.ndarray) -> Path:
    height, width, _ = pixels.shape
    rows = b"".join(b"\0" + row.tobytes() for row in pixels.astype(np.uint8))

    def chunk(kind: bytes, data: bytes) -> bytes:
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    header = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    path.write_bytes(
        b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b"")
    )
    return path


@pytest.fixture
def four_colors(tmp_path: Path) -> Path:
    """Red and green above, blue and yellow below."""
    return write_png(tmp_path / "four.png", np.repeat(np.repeat([[RED, GREEN], [BLUE, YELLOW]], 8, axis=0), 8, axis=1))


def name(rgb: np.ndarray) -> str:
    return "".join(letter for letter, value in zip("rgb", rgb, strict=True) if value > 90)


def quarters(browser: Browser, center: list[float], right: list[float], up: list[float]) -> list[str]:
    """The colors half way to the corners of a rectangle: above left and right, below left and right."""
    browser.wait_for("kinegraph.idle()")
    picture = browser.picture()
    seen = []
    for v, u in ((1, -1), (1, 1), (-1, -1), (-1, 1)):
        column, row = browser.pixel(np.array(center) + 0.5 * u * np.array(right) + 0.5 * v * np.array(up))
        seen.append(name(picture[round(row), round(column)]))
    return seen


def show(config: kg.Config, browser: Browser) -> None:
    config.view()
    config.viewer().setCamera([0, -0.5, 3], [0, 0, 0])
    browser.open(config.viewer().url)


def test_a_picture_on_a_quad(config: kg.Config, browser: Browser, four_colors: Path) -> None:
    config.addFrame("q").setShape("quad", [1.2, 1.2]).setTextureFile(four_colors)
    show(config, browser)
    assert quarters(browser, [0, 0, 0], [0.6, 0, 0], [0, 0.6, 0]) == ["r", "g", "b", "rg"]


def test_a_mesh_with_colors_and_two_pictures(config: kg.Config, browser: Browser, four_colors: Path) -> None:
    folder = four_colors.parent
    write_png(folder / "green.png", np.full((1, 1, 3), GREEN))
    (folder / "a.mtl").write_text("newmtl a\nmap_Kd four.png\nnewmtl b\nmap_Kd green.png\nnewmtl c\nKd 0 0 1\n")
    (folder / "a.obj").write_text(
        "mtllib a.mtl\nv -1 0 0\nv 0 0 0\nv 0 1 0\nv -1 1 0\nv 1 0 0\nv 1 1 0\nv -1 -1 0\nv 0 -1 0\nv 1 -1 0\n"
        "vt 0 0\nvt 0.5 0\nvt 0.5 0.5\nvt 0 0.5\nvt 0.5 0.5\nvt 1 0.5\nvt 1 1\nvt 0.5 1\n"
        "usemtl a\nf 1/5 2/6 3/7 4/8\nusemtl b\nf 2/1 5/2 6/3 3/4\nusemtl c\nf 7 8 2 1\nusemtl a\nf 8/1 9/2 5/3 2/4\n"
    )
    config.addFrame("m").setMeshFile(folder / "a.obj")
    show(config, browser)
    assert quarters(browser, [0, 0, 0], [1, 0, 0], [0, 1, 0]) == ["g", "g", "b", "b"]
    assert browser.evaluate("kinegraph.frames()") == 1


def test_a_picture_that_is_exchanged(config: kg.Config, browser: Browser, four_colors: Path) -> None:
    frame = config.addFrame("q").setShape("box", [1.2, 1.2, 0.1]).setTextureFile(four_colors)
    show(config, browser)
    assert quarters(browser, [0, 0, 0.05], [0.6, 0, 0], [0, 0.6, 0]) == ["r", "g", "b", "rg"]
    frame.setTextureFile(write_png(four_colors.parent / "blue.png", np.full((1, 1, 3), BLUE)))
    config.view()
    browser.wait_for("kinegraph.idle()")
    assert quarters(browser, [0, 0, 0.05], [0.6, 0, 0], [0, 0.6, 0]) == ["b", "b", "b", "b"]


def test_a_saved_page_has_the_pictures(config: kg.Config, browser: Browser, four_colors: Path, tmp_path: Path) -> None:
    config.addFrame("q").setShape("quad", [1.2, 1.2]).setTextureFile(four_colors)
    config.view()
    config.viewer().setCamera([0, -0.5, 3], [0, 0, 0])
    config.viewer().saveHtml(tmp_path / "scene.html")
    browser.open((tmp_path / "scene.html").as_uri())
    assert quarters(browser, [0, 0, 0], [0.6, 0, 0], [0, 0.6, 0]) == ["r", "g", "b", "rg"]


def test_the_camera_sees_the_same(config: kg.Config, four_colors: Path) -> None:
    config.addFrame("q").setShape("quad", [1.2, 1.2]).setTextureFile(four_colors).setPosition([0, 0, 0.01])
    config.view()
    config.viewer().setCamera([0, -0.5, 3], [0, 0, 0])
    rgb = np.asarray(config.viewer().getRgb())
    height, width, _ = rgb.shape
    step = height // 8
    seen = [name(rgb[height // 2 + v * step, width // 2 + u * step]) for v, u in ((-1, -1), (-1, 1), (1, -1), (1, 1))]
    assert seen == ["r", "g", "b", "rg"]
