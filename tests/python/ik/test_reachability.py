"""Reachability, compared with results on paper."""

from pathlib import Path

import numpy as np
import pytest

import kinegraph as ry
from kinegraph.cli import main


@pytest.fixture
def arm() -> ry.Config:
    """Two links of 0.5 and 0.3 m in a plane: the tip reaches the ring between 0.2 and 0.8 m."""
    C = ry.Config()
    C.addFrame("base")
    C.addFrame("shoulder", "base").setJoint(ry.JT.hingeZ, [-3.2, 3.2])
    C.addFrame("elbow_at", "shoulder").setRelativePosition([0.5, 0, 0])
    C.addFrame("elbow", "elbow_at").setJoint(ry.JT.hingeZ, [-3.2, 3.2])
    C.addFrame("tip", "elbow").setRelativePosition([0.3, 0, 0])
    return C


def test_a_planar_arm_reaches_its_ring(arm: ry.Config) -> None:
    found = ry.reachability(arm, spacing=0.05)
    assert found.frame == "tip"
    radius = np.linalg.norm(found.points, axis=1)
    assert (np.abs(found.points[:, 2]) < 0.06).all()
    reached = found.share == 1
    on_ring = (radius > 0.2 + 1e-3) & (radius < 0.8 - 1e-3) & (np.abs(found.points[:, 2]) < 1e-9)
    assert (reached == on_ring).mean() > 0.99 and not reached[(radius < 0.19) | (radius > 0.81)].any()
    assert found.volume == pytest.approx(reached.sum() * 0.05**3)


def test_directions_that_an_arm_cannot_have_count_as_missed(arm: ry.Config) -> None:
    found = ry.reachability(arm, "tip", spacing=0.2, directions=10)
    assert not found.share.any()  # its z axis is upright always, which none of the ten is
    assert np.linalg.norm(found.directions, axis=1) == pytest.approx(np.ones(10))
    assert "from 10 directions" in str(found)


def test_the_same_cells_on_any_engine() -> None:
    C = ry.Config()
    C.addFile(ry.raiPath("panda/panda.g"))
    found = [ry.reachability(C, "gripper", 0.3, 4, workers=w, engine=e) for w, e in ((1, "threads"), (2, "processes"))]
    assert (found[0].share == found[1].share).all() and 0 < found[0].share.mean() < 1


def test_the_command_writes_cells_and_a_picture(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    pq = pytest.importorskip("pyarrow.parquet")
    scene = ry.raiPath("panda/panda.g")
    command = ["reachability", scene, "--frame", "gripper", "--spacing", "0.25", "--no-view"]
    assert main([*command, "-o", str(tmp_path / "cells.csv"), "--picture", str(tmp_path / "cells.png")]) == 0
    assert main([*command, "-o", str(tmp_path / "cells.parquet")]) == 0
    assert "'gripper' reaches" in capsys.readouterr().out
    rows = np.loadtxt(tmp_path / "cells.csv", delimiter=",", skiprows=1)
    table = pq.read_table(tmp_path / "cells.parquet")
    assert table.column_names == ["x", "y", "z", "share"]
    assert np.allclose(np.column_stack([table[name].to_numpy() for name in "xyz"]), rows[:, :3], atol=1e-5)
    assert (tmp_path / "cells.png").stat().st_size > 1000


def test_mistakes_are_reported(arm: ry.Config, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(ry.ArgumentError, match="spacing is 0"):
        ry.reachability(arm, spacing=0)
    with pytest.raises(ry.ArgumentError, match="directions is nan; expected a whole number >= 0"):
        ry.reachability(arm, directions=float("nan"))  # type: ignore[arg-type]
    with pytest.raises(ry.ArgumentError, match="seed is -1; expected a whole number >= 0"):
        ry.reachability(arm, seed=-1)
    with pytest.raises(ry.ArgumentError, match="no joint moves frame 'base'"):
        ry.reachability(arm, "base")
    with pytest.raises(ry.FrameNotFound, match="similar names: tip"):
        ry.reachability(arm, "tipp")
    with pytest.raises(ry.ArgumentError, match=r"ends in \.csv or \.parquet"):
        ry.reachability(arm, spacing=0.4).save(tmp_path / "cells.txt")
    assert main(["reachability", str(tmp_path / "no.urdf")]) == 1
    assert "does not exist" in capsys.readouterr().err


def test_endless_hinges_take_any_angle_and_endless_slides_are_refused() -> None:
    C = ry.Config()
    C.addText("""base: {}
j1 (base): { joint: hingeZ }
j2 (j1): { joint: hingeY, limits: [-.1 .1] }
tip (j2): { Q: [.5 0 0] }""")
    cells = ry.reachability(C, "tip", spacing=0.2, progress=False)
    assert (cells.points.min(axis=0)[:2] < -0.4).all() and (cells.points.max(axis=0)[:2] > 0.4).all()  # all around
    D = ry.Config()
    D.addText("base: {}\nrail (base): { joint: transX }\ncart (rail): { Q: [0 0 .1] }")
    with pytest.raises(ry.ArgumentError, match="the joints rail have no limits"):
        ry.reachability(D, "cart", progress=False)
