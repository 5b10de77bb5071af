"""The command `kinegraph toolpath`."""

import struct
import zlib

import numpy as np
import pytest

import kinegraph as ry
from kinegraph.cli import main
from tool_motion import Y, distance_from_line, poses


def test_the_command_line_writes_the_motion(scene, tmp_path):
    file, rows, motion = tmp_path / "scene.g", tmp_path / "seam.csv", tmp_path / "motion.csv"
    scene.write(file)
    start = scene.getFrame("tool").getPosition()
    np.savetxt(rows, start + np.linspace(0, 0.1, 51)[:, None] * Y, delimiter=",")
    command = ["toolpath", str(file), "--points", str(rows), "--free", "z", "--speed", "0.05", "-o", str(motion)]
    assert main([*command, "--no-view"]) == 0
    table = np.loadtxt(motion, delimiter=",", skiprows=1)
    n = scene.getJointDimension()
    assert table.shape[1] == 1 + 3 * n  # time, q, velocities, accelerations
    x = poses(scene, table[:, 1 : n + 1])[:, :3]
    assert distance_from_line(x, start, start + 0.1 * Y).max() <= 2e-5


def test_the_command_line_does_several_paths_from_where_the_robot_is(scene, tmp_path, capsys):
    file, motion = tmp_path / "scene.g", tmp_path / "motion.csv"
    scene.write(file)
    home = scene.getFrame("tool").getPosition()
    seams = []
    for i, offset in enumerate(([0.0, 0.2, 0.0], [0.05, -0.1, 0.0])):
        seams.append(str(tmp_path / f"seam{i}.csv"))
        np.savetxt(seams[-1], home + offset + np.linspace(0, 0.05, 51)[:, None] * Y, delimiter=",")
    command = ["toolpath", str(file), "--points", *seams, "--order", "free", "--transfer", "--jerk", "200", "--no-view"]
    assert main([*command, "-o", str(motion)]) == 0
    table = np.loadtxt(motion, delimiter=",", skiprows=1)
    n = scene.getJointDimension()
    assert np.abs(table[0, 1 : n + 1] - scene.getJointState()).max() < 1e-6
    x = poses(scene, table[:, 1 : n + 1])[:, :3]
    for seam in seams:
        ends = np.loadtxt(seam, delimiter=",")[[0, -1]]
        assert all(np.linalg.norm(x - end, axis=1).min() < 2e-3 for end in ends)
    assert main([*command, "--touching", "tabel"]) == 1
    assert "tabel" in capsys.readouterr().err


def rgb_of(file):
    """The pixels of a PNG file whose lines have no filter, shape (height, width, 3)."""
    data = file.read_bytes()
    width, height = struct.unpack(">II", data[16:24])
    packed, at = b"", 8
    while at < len(data):
        size, kind = struct.unpack(">I4s", data[at : at + 8])
        packed += data[at + 8 : at + 8 + size] if kind == b"IDAT" else b""
        at += size + 12
    lines = np.frombuffer(zlib.decompress(packed), np.uint8).reshape(height, 1 + 3 * width)
    assert not lines[:, 0].any()
    return lines[:, 1:].reshape(height, width, 3).astype(int)


def test_the_command_line_saves_a_picture_of_the_path_colored_by_speed(tmp_path):
    rows, picture = tmp_path / "seam.csv", tmp_path / "seam.png"
    C = ry.Config()
    C.addFile(ry.raiPath("ur5e/ur5e.g"))
    np.savetxt(rows, C.getFrame("tool0").getPosition() + np.linspace(0, 0.3, 51)[:, None] * Y, delimiter=",")
    command = ["toolpath", "ur5e/ur5e.g", "--frame", "tool0", "--points", str(rows), "--speed", "0.05", "--no-view"]
    assert main([*command, "--picture", str(picture)]) == 0
    rgb = rgb_of(picture)
    green = (rgb[..., 1] > rgb[..., 0] + 60) & (rgb[..., 1] > rgb[..., 2] + 60)
    assert green.sum() > 50


def test_the_command_line_saves_a_film(scene, tmp_path):
    av = pytest.importorskip("av")
    file, rows, film = tmp_path / "scene.g", tmp_path / "seam.csv", tmp_path / "seam.mp4"
    scene.write(file)
    start = scene.getFrame("tool").getPosition()
    np.savetxt(rows, start + np.linspace(0, 0.05, 51)[:, None] * Y, delimiter=",")
    command = ["toolpath", str(file), "--points", str(rows), "--free", "z", "--speed", "0.1", "--no-view"]
    assert main([*command, "--film", str(film)]) == 0
    with av.open(str(film)) as opened:
        assert sum(1 for _ in opened.decode(video=0)) >= 25
