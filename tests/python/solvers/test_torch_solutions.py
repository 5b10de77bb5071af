"""kinegraph.torch: gradients through solutions equal differences, in batches."""

import numpy as np
import pytest

torch = pytest.importorskip("torch", reason="needs the extra torch")

import kinegraph as ry  # noqa: E402
from kinegraph.torch import solve, solveIk  # noqa: E402


@pytest.fixture
def panda():
    C = ry.Config()
    C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
    C.addFrame("box").setPosition([0.3, 0.3, 1.0])
    return C


def test_through_inverse_kinematics(panda):
    rng = np.random.default_rng(1)
    positions = torch.tensor([0.3, 0.3, 1.1] + 0.05 * rng.normal(size=(3, 3)), requires_grad=True)
    weights = rng.normal(size=(3, 7))
    q = solveIk(panda, {"l_gripper": positions}, home_weight=1.0, threads=2)
    assert q.shape == (3, 7)
    (torch.from_numpy(weights) * q).sum().backward()
    expected = [
        ry.solveIk(panda, {"l_gripper": p}, home_weight=1.0).sensitivity().gradient(w)
        for p, w in zip(positions.detach().numpy(), weights)
    ]
    np.testing.assert_allclose(positions.grad, expected, atol=1e-12)


def test_single_precision_stays(panda):
    positions = torch.tensor([[0.3, 0.3, 1.1]], dtype=torch.float32, requires_grad=True)
    q = solveIk(panda, {"l_gripper": positions})
    q.sum().backward()
    assert q.dtype == positions.grad.dtype == torch.float32


def test_through_a_motion_problem(panda):
    def make(position, target):
        panda.getFrame("box").setPosition(position)
        komo = ry.KOMO(panda, 1, 4, 2, False)
        komo.addControlObjective([], 2, 1.0)
        komo.addObjective([1.0], ry.FS.positionDiff, ["l_gripper", "box"], ry.OT.eq, [10], target)
        return komo

    values = [
        torch.tensor([[0.3, 0.3, 1.0], [0.2, 0.35, 1.1]], dtype=torch.float64, requires_grad=True),
        torch.tensor([[0.0, 0.0, 0.1], [0.01, 0.0, 0.0]], dtype=torch.float64, requires_grad=True),
    ]
    assert torch.autograd.gradcheck(
        lambda *v: solve(make, v, ["box", "positionDiff"], threads=2)[:, -7:], values, eps=1e-5, atol=1e-4
    )
