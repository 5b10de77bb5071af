"""A mirrored mesh looks like the same mesh modeled mirrored: the light falls on its outside."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

import kinegraph as kg

from .browser import Browser

CORNERS = np.array([[0, 0, 0], [0.4, 0, 0], [0.4, 0.3, 0], [0, 0.3, 0], [0, 0, 0.2], [0, 0.3, 0.5]])
TRIANGLES = [(0, 2, 1), (0, 3, 2), (0, 1, 4), (1, 2, 5), (1, 5, 4), (2, 3, 5), (3, 0, 4), (3, 4, 5)]
SCALES = [(-1, 1, 1), (1, -0.8, 1), (-1.2, -1, -1)]


def write_wedge(path: Path, scale: tuple[float, ...]) -> None:
    is_mirrored = np.prod(scale) < 0
    lines = ["v {} {} {}".format(*corner) for corner in CORNERS * scale]
    lines += ["f {} {} {}".format(*(i + 1 for i in (t[::-1] if is_mirrored else t))) for t in TRIANGLES]
    path.write_text("\n".join(lines))


def pictures(tmp_path: Path, scale: tuple[float, ...], look: Callable[[kg.Config], np.ndarray]) -> list[np.ndarray]:
    """Pictures of a wedge that is scaled in three formats, and of one that is modeled so."""
    write_wedge(tmp_path / "wedge.obj", (1, 1, 1))
    write_wedge(tmp_path / "modeled.obj", scale)
    numbers = " ".join(map(str, scale))
    color = ".8 .5 .2"
    files = {
        "scaled.g": f"wedge: {{ X: [0 0 .7], mesh: <wedge.obj>, meshscale: [{numbers}], color: [{color}] }}",
        "scaled.urdf": '<robot name="r"><link name="wedge"><visual><origin xyz="0 0 .7"/><geometry>'
        f'<mesh filename="wedge.obj" scale="{numbers}"/></geometry><material name="m"><color rgba="{color} 1"/>'
        "</material></visual></link></robot>",
        "scaled.xml": f'<mujoco><asset><mesh name="m" file="wedge.obj" scale="{numbers}"/></asset><worldbody>'
        f'<geom type="mesh" mesh="m" pos="0 0 .7" rgba="{color} 1" contype="0" conaffinity="0"/></worldbody></mujoco>',
        "modeled.g": f"wedge: {{ X: [0 0 .7], mesh: <modeled.obj>, color: [{color}] }}",
    }
    seen = []
    for name, text in files.items():
        (tmp_path / name).write_text(text)
        config = kg.Config()
        config.addFile(tmp_path / name)
        seen.append(look(config))
        config.view_close()
    return seen


def assert_same(seen: list[np.ndarray]) -> None:
    assert seen[-1].astype(int).std() > 5  # something is seen
    for picture in seen[:-1]:
        difference = np.abs(picture.astype(int) - seen[-1].astype(int)).max(axis=2)
        assert (difference > 3).mean() < 1e-4


@pytest.mark.parametrize("scale", SCALES)
def test_mirrored_meshes_in_pictures_without_a_browser(tmp_path: Path, scale: tuple[float, ...]) -> None:
    assert_same(pictures(tmp_path, scale, lambda config: np.asarray(config.viewer().getRgb())))


@pytest.mark.parametrize("scale", SCALES[:2])
@pytest.mark.parametrize("saved", [False, True])
def test_mirrored_meshes_on_the_page(tmp_path: Path, browser: Browser, scale: tuple[float, ...], saved: bool) -> None:
    def look(config: kg.Config) -> np.ndarray:
        config.view()
        config.viewer().setCamera([1.5, -1.2, 1.5], [0, 0, 0.8])
        if saved:
            config.viewer().saveHtml(tmp_path / "saved.html")
        browser.open((tmp_path / "saved.html").as_uri() if saved else config.viewer().url)
        browser.wait_for("kinegraph.idle()")
        return np.asarray(browser.picture())

    assert_same(pictures(tmp_path, scale, look))
