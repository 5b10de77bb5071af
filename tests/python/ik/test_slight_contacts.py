"""Overlaps that have nothing to do with the targets."""

import numpy as np
import pytest

import kinegraph as ry


def hand(depth: float) -> ry.Config:
    """An arm in a plane with two fingers that overlap by `depth`."""
    C = ry.Config()
    h = 0.01 - depth / 2
    C.addText(f"""base: {{}}
j1 (base): {{ joint: hingeZ, limits: [-2 2] }}
link (j1): {{ Q: [.5 0 0] }}
j2 (link): {{ joint: hingeZ, limits: [-2 2] }}
hand (j2): {{ Q: [.4 0 0] }}
f (hand): {{ joint: transY, limits: [0 .04] }}
left (f): {{ Q: [.05 {h} 0], shape: box, size: [.06 .02 .02], contact: -1 }}
g (hand): {{ joint: transY, mimic: f, joint_scale: -1 }}
right (g): {{ Q: [.05 {-h} 0], shape: box, size: [.06 .02 .02], contact: -1 }}""")
    C.setJointState([0, 0.5, 0])
    return C


@pytest.mark.parametrize("depth", [0.0, 0.0002, 0.004])
def test_fingers_that_touch_rule_out_no_target(depth: float) -> None:
    C = hand(depth)
    target = {"hand": [0.3, 0.6, 0]}
    if depth > 0:
        with pytest.warns(ry.KinegraphWarning, match="'left' and 'right' overlap by .*so the answer keeps it"):
            result = ry.solveIk(C, target)
        assert len(result.warnings) == 1
    else:
        result = ry.solveIk(C, target)
    assert result.feasible and result.message == "" and result.q[2] == 0
    assert np.allclose(C.getFramePoses([result.q], "hand")[0, 0, :3], target["hand"], atol=1e-5)
    plan = ry.planMotion(C, target)
    assert plan.feasible, plan.message
    assert plan.feasible == ry.planMotion(C, result.q).feasible
    if depth > 0:
        assert any("'left' and 'right' overlap" in warning for warning in plan.warnings)


def test_deep_overlaps_rule_out_every_answer() -> None:
    C = hand(0.008)
    result = ry.solveIk(C, {"hand": [0.3, 0.6, 0]})
    assert result.status == ry.IkStatus.in_collision and "no joint that moves a target separates" in result.message
    with pytest.warns(ry.KinegraphWarning, match="overlap by 0.008"):
        assert ry.solveIk(C, {"hand": [0.3, 0.6, 0]}, max_start_penetration=0.01).feasible
