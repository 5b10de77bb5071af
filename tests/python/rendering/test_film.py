"""Motions as films."""

import numpy as np
import pytest

import kinegraph as ry


@pytest.fixture
def arm() -> ry.Config:
    C = ry.Config()
    C.addFrame("world")
    C.addFrame("joint", "world").setJoint(ry.JT.hingeZ)
    C.addFrame("bar", "joint").setShape(ry.ST.box, [0.6, 0.1, 0.1]).setColor([1, 0, 0]).setRelativePosition([0.3, 0, 0])
    C.viewer().setWindow("", 161, 121)
    return C


def pictures(path: str) -> list[np.ndarray]:
    av = pytest.importorskip("av")
    with av.open(path) as film:
        return [frame.to_ndarray(format="rgb24") for frame in film.decode(video=0)]


@pytest.mark.parametrize("ending", ["mp4", "webm"])
def test_a_film_shows_the_motion(arm: ry.Config, tmp_path, ending: str) -> None:
    pytest.importorskip("av")
    arm.setJointState([0.2])
    file = ry.saveFilm(tmp_path / "made" / f"film.{ending}", arm, [[0.0], [np.pi / 2]], seconds=1.0, rate=8)
    film = pictures(str(file))
    assert len(film) == 8 and film[0].shape == (120, 160, 3)
    assert arm.getJointState() == [0.2]
    arm.setJointState([np.pi / 2])
    last = arm.viewer().getRgb()[:120, :160].astype(int)
    assert np.abs(film[-1] - last).mean() < 10 < np.abs(film[0].astype(int) - film[-1]).max()
    assert [f.name for f in file.parent.iterdir()] == [file.name]


def test_poses_of_all_frames_are_a_motion_as_well(arm: ry.Config, tmp_path) -> None:
    pytest.importorskip("av")
    komo = ry.KOMO(arm, 1, 5, 2, False)
    file = ry.saveFilm(tmp_path / "film.mp4", arm, komo.getPathFrames(), seconds=0.5, rate=10)
    assert len(pictures(str(file))) == 5


def test_invalid_arguments_are_reported_and_leave_no_file(arm: ry.Config, tmp_path) -> None:
    with pytest.raises(ry.ArgumentError, match=r"\.mp4 or \.webm"):
        ry.saveFilm(tmp_path / "film.gif", arm, [[0.0]])
    with pytest.raises(ry.ArgumentError, match="seconds is 0"):
        ry.saveFilm(tmp_path / "film.mp4", arm, [[0.0]], seconds=0)
    pytest.importorskip("av")
    with pytest.raises(ry.ArgumentError, match=r"shape \(1, 3\); expected \(T, 1\)"):
        ry.saveFilm(tmp_path / "film.mp4", arm, [[0.0, 1.0, 2.0]])
    assert list(tmp_path.iterdir()) == []
