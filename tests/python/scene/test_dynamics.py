"""Dynamics in velocities."""

import json
from pathlib import Path

import numpy as np
import pytest

import kinegraph as ry

# The leg of the recorded scene is no possible body: its inertia counts as it is, as in Pinocchio.
pytestmark = pytest.mark.filterwarnings("ignore:.*its principal moments of inertia")
RECORDED = json.loads((Path(__file__).parent.parent.parent / "data/dynamics_pinocchio.json").read_text())


@pytest.mark.parametrize("sample", RECORDED["samples"])
def test_all_terms_are_those_of_pinocchio(sample):
    C = ry.Config()
    C.addText(RECORDED["scene"])
    C.setJointState(sample["q"])
    M, coriolis, g = C.rigidBodyDynamics(sample["v"])
    np.testing.assert_allclose(M, sample["M"], atol=1e-9)
    np.testing.assert_allclose(coriolis, sample["C"], atol=1e-9)
    np.testing.assert_allclose(g, sample["g"], atol=1e-9)
    np.testing.assert_allclose(C.centroidalMomentumMatrix(), sample["A"], atol=1e-9)


def test_the_map_leads_to_the_equation_of_motion_in_q():
    C = ry.Config()
    C.addText(RECORDED["scene"])
    C.setJointState(RECORDED["samples"][0]["q"])
    v = 0.1 * np.arange(C.velocityDimension())
    M, coriolis, g = C.rigidBodyDynamics(v)
    assert M.shape == (11, 11) and np.linalg.eigvalsh(M)[0] > 1e-6
    T = C.velocityMap()
    in_q, forces = C.dyn_MF(T @ v)
    np.testing.assert_allclose(M, T.T @ in_q @ T, atol=1e-9)
    np.testing.assert_allclose(coriolis @ v + g, T.T @ forces, atol=1e-9)
    assert np.allclose(C.rigidBodyDynamics(v, gravity=False)[2], 0)


def test_velocities_of_another_size_are_an_error():
    C = ry.Config()
    C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
    with pytest.raises(ry.errors.ArgumentError, match="3 numbers"):
        C.rigidBodyDynamics([1, 2, 3])
