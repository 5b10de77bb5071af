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


class Swing(ry.Trajectory):
    """A motion whose eval takes one time."""

    duration = 1.0

    def eval(self, t: float) -> tuple[list[float], list[float], list[float]]:
        return [float(t) * np.pi / 2], [np.pi / 2], [0.0]


def test_a_plan_or_trajectory_is_filmed_for_its_duration(arm: ry.Config, tmp_path) -> None:
    pytest.importorskip("av")
    rows = pictures(str(ry.saveFilm(tmp_path / "rows.mp4", arm, [[0.0], [np.pi / 2]], seconds=1.0, rate=8)))
    swing = pictures(str(ry.saveFilm(tmp_path / "swing.mp4", arm, Swing(), rate=8)))
    assert len(swing) == 8 and np.abs(swing[3].astype(int) - rows[3]).mean() < 2
    plan = ry.planMotion(arm, [1.0], velocity=1.0, acceleration=4.0)
    film = pictures(str(ry.saveFilm(tmp_path / "plan.mp4", arm, plan, rate=8)))
    assert plan.duration > 1 and len(film) == round(8 * plan.duration)
    with pytest.raises(ry.ArgumentError, match="has no motion"):
        ry.saveFilm(tmp_path / "none.mp4", arm, ry.planMotion(arm, [0.0], start=[0.0]))


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda C: ry.saveFilm(C, [[0.0]], "film.mp4"), r"file is <Config.*; write saveFilm\(file, C, path\)"),
        (lambda C: ry.saveFilm("film.mp4", [[0.0]], C), r"config is \[\[0.0\]\]; expected Config"),
        (lambda C: ry.saveFilm("film.mp4", C, [[0.0]], size=480), r"size is 480; expected width and height"),
    ],
)
def test_arguments_in_another_order_are_explained(arm: ry.Config, call, message: str) -> None:
    with pytest.raises(ry.ArgumentTypeError, match=message):
        call(arm)
