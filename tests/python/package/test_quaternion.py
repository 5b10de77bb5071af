"""Quaternion: numbers of spec tables, and laws."""

from __future__ import annotations

import numpy as np
import pytest

import kinegraph as ry


def q(*wxyz: float) -> ry.Quaternion:
    return ry.Quaternion(wxyz)


def close(a: ry.Quaternion, *wxyz: float) -> None:
    np.testing.assert_allclose(a.asArr(), wxyz, atol=1e-5)


HALF = np.sqrt(0.5)


def test_numbers_recorded_from_the_reference() -> None:
    close(ry.Quaternion(), 1, 0, 0, 0)
    close(ry.Quaternion().setRollPitchYaw([0.1, 0.2, 0.3]), 0.98186, 0.06407, 0.09116, 0.15344)
    close(ry.Quaternion().setRollPitchYaw([0.1, 0.2, 0.3], reverse=True), 0.98335, 0.03427, 0.10602, 0.14357)
    close(ry.Quaternion().setEuler([0.1, 0.2, 0.3]), 0.97517, 0.09933, -0.00997, 0.19768)
    close(ry.Quaternion().setDiff([1, 0, 0], [-1, 0, 0]), 0, 0, 0, 1)
    start, end = q(HALF, HALF, 0, 0), q(HALF, 0, 0, HALF)
    close(ry.Quaternion().setInterpolateProper(0.3, start, end), 0.79865, 0.54634, 0, 0.25231)
    close(ry.Quaternion().setInterpolateEmbedded(0.3, start, end), 0.79556, 0.55689, 0, 0.23867)
    np.testing.assert_allclose(q(-0.5, 0.5, 0.5, 0.5).getLog(), -1.2092 * np.ones(3), atol=1e-4)


def random_ones() -> list[ry.Quaternion]:
    ry.rnd_seed(3)
    return [ry.Quaternion().setRandom() for _ in range(20)]


def test_random_ones_are_rotations_that_differ_and_can_be_repeated() -> None:
    first, again = random_ones(), random_ones()
    assert first == again
    assert all(abs(one.sqrNorm() - 1) < 1e-12 for one in first)
    assert len({one.w for one in first}) == 20


@pytest.mark.parametrize("one", random_ones(), ids=repr)
def test_getters_undo_setters(one: ry.Quaternion) -> None:
    for other in (
        ry.Quaternion().setMatrix(one.getMatrix()),
        ry.Quaternion().setExp(one.getLog()),
        ry.Quaternion().setRollPitchYaw(one.getRollPitchYaw()),
        ry.Quaternion().setRad(one.getRad(), one.asArr()[1:]),
    ):
        assert abs(abs(other.asArr() @ one.asArr()) - 1) < 1e-12
    np.testing.assert_allclose((one * -one).asArr(), [1, 0, 0, 0], atol=1e-12)
    np.testing.assert_allclose((one * one).getMatrix(), one.getMatrix() @ one.getMatrix(), atol=1e-12)
    np.testing.assert_allclose(one.applyOnPointArray(np.eye(3)), one.getMatrix().T, atol=1e-12)
    start = np.array([0.3, -1, 0.2])
    end = one.getMatrix() @ start
    np.testing.assert_allclose(ry.Quaternion().setDiff(start, end).getMatrix() @ start, end, atol=1e-12)


def test_the_jacobian_is_that_of_angular_velocity() -> None:
    ry.rnd_seed(1)
    one, rate, step = ry.Quaternion().setRandom(), np.array([0.1, -0.3, 0.2, 0.4]), 1e-6
    rate -= rate @ one.asArr() * one.asArr()  # stays of length 1
    after = ry.Quaternion(one.asArr() + step * rate).normalize()
    np.testing.assert_allclose(one.getJacobian() @ rate, (after * -one).getLog() / step, atol=1e-5)


def test_changes_in_place_can_be_chained() -> None:
    one = ry.Quaternion().setRad(0.4, [0, 0, 2]).append(ry.Quaternion().setRad(0.2, [0, 0, 1]))
    assert one.getRad() == pytest.approx(0.6)
    assert one.multiply(0.5) is None
    assert one.getRad() == pytest.approx(0.3)
    np.testing.assert_allclose(one.invert().getLog(), [0, 0, -0.3], atol=1e-12)
    assert one.set([2, 0, 0, 0]).normalize().w == 1
    one.x = 0.5
    assert one.x == 0.5 and one.flipSign().w == -1


def test_mistakes_are_explained() -> None:
    with pytest.raises(ry.ArgumentError, match=r"a quaternion has shape \(3,\); expected \(4,\)"):
        ry.Quaternion().set([1, 0, 0])
    with pytest.raises(ry.ArgumentError, match="not a rotation"):
        ry.Quaternion().setMatrix(np.ones((3, 3)))
    with pytest.raises(ry.ArgumentError, match="length 0"):
        ry.Quaternion().setRad(1, [0, 0, 0])
    with pytest.raises(ry.ArgumentError, match="zero"):
        ry.Quaternion([0, 0, 0, 0]).normalize()


def test_numbers_of_a_script_may_be_a_row_or_flat() -> None:
    close(ry.Quaternion().set([np.array([0.0, 1, 0, 0])]), 0, 1, 0, 0)
    close(ry.Quaternion().setMatrix([1, 0, 0, 0, 0, -1, 0, 1, 0]), HALF, HALF, 0, 0)
    with pytest.raises(ry.ArgumentError, match=r"the matrix has shape \(3, 2\)"):
        ry.Quaternion().setMatrix(np.zeros((3, 2)))
    with pytest.raises(ry.ArgumentError, match=r"a quaternion is 'abcd'; expected numbers, shape \(4,\)"):
        ry.Quaternion().set("abcd")


@pytest.mark.parametrize(
    "call",
    [
        lambda q: q.append(3),
        lambda q: q.setInterpolateProper(0.5, q, [1, 0, 0, 0]),
        lambda q: q.setInterpolateEmbedded(0.5, "a", q),
        lambda q: q.applyOnPointArray({}),
    ],
)
def test_other_values_than_rotations_and_points_are_refused(call) -> None:
    with pytest.raises(ry.ArgumentError, match="expected a Quaternion|expected numbers"):
        call(ry.Quaternion())
    with pytest.raises(TypeError):
        ry.Quaternion() * 3
