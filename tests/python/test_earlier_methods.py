"""Methods by the names that scripts of earlier years use."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import kinegraph as ry

SCENE = """world: {} a(world): {joint: hingeX, mass: 1, arm} hand(a): {joint: transX, pre: [0 0 1], shape: sphere, size: [.1]}
table: {X: [0 0 .5]} cup(table): {Q: [0 0 .1], shape: sphere, size: [.05], mass: 1}"""


@pytest.fixture
def C(tmp_path: Path) -> ry.Config:
    (tmp_path / "scene.g").write_text(SCENE)
    config = ry.Config()
    config.addFile(tmp_path / "scene.g")
    return config


def test_dynamics(C: ry.Config) -> None:
    velocity = np.array([0.1, 0.2])
    for ours, theirs in zip(C.equationOfMotion(velocity), C.dyn_MF(velocity), strict=True):
        np.testing.assert_array_equal(ours, theirs)
    np.testing.assert_allclose(C.equationOfMotion(velocity, gravity=False)[1], C.dyn_MF(velocity)[1] - C.dyn_F0())
    q = C.getJointState()
    C.selectJoints(["a"])
    after = C.stepDynamics([0.5], [0.0], 0.1, gravity=False)
    np.testing.assert_allclose(C.getJointState(), [q[0] + 0.05], atol=1e-9)
    np.testing.assert_allclose(after, [0.5], atol=1e-9)


def test_selection_and_free_objects(C: ry.Config) -> None:
    C.selectJointsByTag(["arm"])
    assert C.getJointNames() == ["a"]
    where = C["cup"].getPose()
    C.makeObjectsFree(["cup"])
    assert C["table"].getJointType() == ry.JT.free
    np.testing.assert_allclose(C["cup"].getPose(), where)
    C.sortFrames()
    assert next(iter(C.getFrames())).name == "world"


def test_attributes(C: ry.Config) -> None:
    assert C["cup"].addAttribute("full", True).setAttribute("volume", 0.2).getAttributes()["volume"] == 0.2


def test_pictures(C: ry.Config, tmp_path: Path) -> None:
    assert C.view_fxycxy().shape == (4,) and C.view_pose().shape == (7,) and C.view_focalLength() > 0
    before = C.view_pose()
    C.view_focus("cup", 0.5)
    assert not np.allclose(before, C.view_pose())
    try:
        rgb, depth = C.view_getRgb(), C.view_getDepth()
    except ry.FileError as error:
        pytest.skip(str(error))
    assert rgb.shape == (*depth.shape, 3)
    assert Path(C.view_savePng(f"{tmp_path}/pictures/")).exists()
