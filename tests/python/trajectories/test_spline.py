"""The bindings of BSpline."""

from __future__ import annotations

import pickle

import numpy as np
import pytest

import kinegraph as ry
import robotic


def test_a_spline_takes_lists_and_arrays_and_gives_arrays_of_the_shapes_that_it_says() -> None:
    spline = ry.BSpline().set(2, [[0.0, 1.0], [1.0, 1.0], [2.0, 0.0]], [0, 1, 3])
    assert spline.getKnots() == pytest.approx([0, 0, 0, 0.5, 2, 3, 3, 3])
    assert spline.getCtrlPoints().shape == (5, 2) and spline.degree == 2
    assert spline.eval([0.0, 0.5, 1.0]).shape == (3, 2) and spline.eval3(0.5).shape == (3, 2)
    np.testing.assert_allclose(spline.eval(np.array([2.0]))[0, 0], 1.6)  # recorded from robotic 0.4.2
    np.testing.assert_allclose(spline.eval3(0.5)[:, 0], [0.25, 1.0, -0.4 / 3])
    B = spline.getBmatrix([0.3, 0.7], True, True)
    np.testing.assert_allclose(B @ [[0.0, 1.0], [1.0, 1.0], [2.0, 0.0]], spline.eval([0.3, 0.7]))
    assert spline.getBmatrix([0.3]).shape == (1, 5)


def test_a_flat_list_is_a_point_per_time() -> None:
    assert ry.BSpline().set(3, [0, 1, 2], [0, 1, 3]).eval(0.5).shape == (1, 1)
    several = ry.BSpline().set(2, np.zeros((2, 7)), [0, 1]).append(np.ones(7), [1.0])
    assert several.getCtrlPoints().shape == (6, 7)
    assert ry.BSpline().setKnots(2, [0, 1]).setCtrlPoints([0, 1]).append([2, 3], [1, 2]).eval(3.0) == 3.0


def test_setters_change_the_spline_and_return_it() -> None:
    spline = ry.BSpline()
    assert spline.set(degree=2, points=[[0.0], [1.0]], times=[0.0, 1.0], setStartVel=[1.0], setEndVel=[]) is spline
    assert spline.eval([0.0, 0.5], 1)[:, 0] == pytest.approx([1.0, 1.5])
    assert spline.append([[2.0]], [1.0], inside=True) is spline
    velocity = spline.eval3(0.5)[1]
    assert spline.overwriteSmooth([[0.0]], [1.0], time_cut=0.5) is spline
    assert spline.eval(1.5) == 0.0 and velocity > 1.0 and spline.eval3(0.5)[1] == pytest.approx(velocity)


def test_a_spline_is_pickled_and_shown() -> None:
    spline = ry.BSpline().set(3, np.random.default_rng(0).normal(size=(5, 3)), [0, 1, 2, 4, 5], [1, 0, 0])
    again = pickle.loads(pickle.dumps(spline))
    np.testing.assert_array_equal(again.eval(np.linspace(-1, 6, 30)), spline.eval(np.linspace(-1, 6, 30)))
    assert repr(again) == "<BSpline of degree 3: 7 control points of 3 numbers, 0 to 5 s>"
    assert "without points" in repr(pickle.loads(pickle.dumps(ry.BSpline())))
    assert robotic.BSpline is ry.BSpline


def test_what_does_not_fit_is_an_error_and_changes_nothing() -> None:
    spline = ry.BSpline().set(2, [[0.0], [1.0]], [0.0, 1.0])
    with pytest.raises(ry.ArgumentError, match="3 points and 2 times"):
        spline.set(2, [[0.0], [1.0], [2.0]], [0.0, 1.0])
    with pytest.raises(ry.ArgumentError, match=r"times\[1\] = 1 is before 2"):
        spline.append([[0.0], [1.0]], [2.0, 1.0])
    with pytest.raises(ry.ArgumentError, match="no control points yet"):
        ry.BSpline().eval(0.0)
    assert spline.getCtrlPoints()[:, 0] == pytest.approx([0, 0, 1, 1])
