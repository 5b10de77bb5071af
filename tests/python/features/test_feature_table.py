"""The formulas on the page of features hold: y and the columns of its Jacobian, by NumPy."""

import sys
from pathlib import Path

import numpy as np
import pytest

import kinegraph as ry

ROOT = Path(__file__).parents[3]
sys.path.insert(0, str(ROOT / "site"))

import features_page  # noqa: E402
from feature_formulas import FORMULAS  # noqa: E402

SCENE = """
world: {}
hinge(world): { pre: "t(.2 .1 .3) d(20 1 2 3)", joint: hingeX, q: .4, limits: [-1 2] }
slide(hinge): { pre: "t(0 .2 .1) d(40 0 1 1)", joint: transY, q: .3, limits: [-1 1] }
a(slide): { Q: "t(.3 .2 .1) d(35 1 0 2)", shape: sphere, size: [.1], mass: 2 }
turn(world): { pre: "t(1 .4 .2) d(15 0 1 0)", joint: hingeZ, q: -.2, limits: [-2 2] }
b(turn): { Q: "t(.1 .3 .2) d(50 0 2 1)", shape: ssBox, size: [.5 .4 .3 .02], mass: 3 }
"""


@pytest.fixture(scope="module")
def C():
    scene = ry.Config()
    scene.addText(SCENE)
    return scene


def dof_motions(C, frame):
    """v and w of a frame per dof, by differences of its pose."""
    q, h = C.getJointState(), 1e-6
    motions = []
    for i in range(len(q)):
        poses = []
        for sign in (1, -1):
            C.setJointState(q + sign * h * np.eye(len(q))[i])
            poses.append((C.getFrame(frame).getPosition(), C.getFrame(frame).getRotationMatrix()))
        C.setJointState(q)
        spin = (poses[0][1] - poses[1][1]) / (2 * h) @ C.getFrame(frame).getRotationMatrix().T
        motions.append(((poses[0][0] - poses[1][0]) / (2 * h), np.array([spin[2, 1], spin[0, 2], spin[1, 0]])))
    return motions


def product(p, q):
    return np.concatenate([[p[0] * q[0] - p[1:] @ q[1:]], p[0] * q[1:] + q[0] * p[1:] + np.cross(p[1:], q[1:])])


def geometric(name, C):
    """y, and its column for v_a, w_a, v_b, w_b, as the page says, of features of frames a and b."""
    a, b = C.getFrame("a"), C.getFrame("b")
    (p, R, q), (pb, Rb, qb) = ((f.getPosition(), f.getRotationMatrix(), f.getQuaternion()) for f in (a, b))

    def half(w, q):
        return 0.5 * product(np.array([0, *w]), q)

    sign = 1 if q @ qb >= 0 else -1
    inverse = qb * [1, -1, -1, -1]
    table = {
        "position": (p, lambda v, w, vb, wb: v),
        "positionDiff": (p - pb, lambda v, w, vb, wb: v - vb),
        "positionRel": (Rb.T @ (p - pb), lambda v, w, vb, wb: Rb.T @ (v - vb - np.cross(wb, p - pb))),
        "quaternion": (q, lambda v, w, vb, wb: half(w, q)),
        "quaternionDiff": (q - sign * qb, lambda v, w, vb, wb: half(w, q) - sign * half(wb, qb)),
        "quaternionRel": (
            product(inverse, q),
            lambda v, w, vb, wb: half(Rb.T @ (w - wb), product(inverse, q)),
        ),
    }
    for kind in ("", "Diff", "Rel"):
        (y, J), (z, K) = table[f"position{kind}"], table[f"quaternion{kind}"]
        table[f"pose{kind}"] = (
            np.concatenate([y, z]),
            lambda v, w, vb, wb, J=J, K=K: np.concatenate([J(v, w, vb, wb), K(v, w, vb, wb)]),
        )
    y, J = table["positionRel"]
    half_side = np.array([0.25, 0.2, 0.15])
    table["gazeAt"] = (y[:2], lambda v, w, vb, wb: J(v, w, vb, wb)[:2])
    above = half_side[:2] - 0.02
    table["aboveBox"] = (
        np.concatenate([y[:2] - above, -y[:2] - above]),
        lambda v, w, vb, wb: np.concatenate([J(v, w, vb, wb)[:2], -J(v, w, vb, wb)[:2]]),
    )
    inside = half_side - 0.01
    table["insideBox"] = (
        np.concatenate([y - inside, -y - inside]),
        lambda v, w, vb, wb: np.concatenate([J(v, w, vb, wb), -J(v, w, vb, wb)]),
    )
    table["standingAbove"] = ([p[2] - pb[2] - 0.5 * (0.2 + 0.3)], lambda v, w, vb, wb: [v[2] - vb[2]])
    for i, axis in enumerate("XYZ"):
        x, xb = R[:, i], Rb[:, i]
        table[f"vector{axis}"] = (x, lambda v, w, vb, wb, x=x: np.cross(w, x))
        table[f"vector{axis}Diff"] = (
            x - xb,
            lambda v, w, vb, wb, x=x, xb=xb: np.cross(w, x) - np.cross(wb, xb),
        )
        table[f"vector{axis}Rel"] = (Rb.T @ x, lambda v, w, vb, wb, x=x: Rb.T @ np.cross(w - wb, x))
        for j, other in enumerate("XYZ"):
            u = Rb[:, j]
            table[f"scalarProduct{axis}{other}"] = (
                [x @ u],
                lambda v, w, vb, wb, x=x, u=u: [(w - wb) @ np.cross(x, u)],
            )
    return table[name]


GEOMETRIC = [
    name
    for name in FORMULAS
    if name.startswith(("position", "quaternion", "pose", "vector", "scalarProduct"))
    or name in ("gazeAt", "aboveBox", "insideBox", "standingAbove")
]


@pytest.mark.parametrize("name", GEOMETRIC)
def test_a_formula_of_the_page_is_the_feature(C, name):
    info = next(
        row for row in features_page.tableRows((ROOT / "docs" / "features.md").read_text()) if f"`{name}`" in row[0]
    )
    y, J = C.eval(ry.FS[name], ["a", "b"][: len(info[1].split())])
    value, column = geometric(name, C)
    assert y == pytest.approx(np.array(value), abs=1e-9)
    assert len(y) == int(info[2])  # the dimension on the page
    motions = zip(dof_motions(C, "a"), dof_motions(C, "b"))
    expected = np.array([column(v, w, vb, wb) for (v, w), (vb, wb) in motions]).T
    assert pytest.approx(expected, abs=1e-6) == J


def test_the_formulas_of_distances_joints_and_masses(C):
    distance = -C.eval(ry.FS.distance, ["a", "b"])[0]
    points = [C.eval(ry.FS[f"pairCollision_{name}"], ["a", "b"])[0] for name in ("p1", "p2", "vector", "normal")]
    assert points[2] == pytest.approx(points[0] - points[1])
    assert points[2] == pytest.approx(distance * points[3])
    q = C.getJointState()
    lower, upper = C.getJointLimits()
    assert C.eval(ry.FS.qItself, [])[0] == pytest.approx(q)
    limits = C.eval(ry.FS.jointLimits, [])[0]
    assert sorted(limits) == pytest.approx(sorted([*(lower - q), *(q - upper)]))
    centers = [C.getFrame(name).getPosition() for name in "ab"]
    offset = C.eval(ry.FS.EqCenterOfMass, ["a", "a", "b"])[0]
    assert offset == pytest.approx(centers[0] - (2 * centers[0] + 3 * centers[1]) / 5)


def test_every_available_feature_has_a_formula_and_a_picture():
    rows = features_page.tableRows((ROOT / "docs" / "features.md").read_text())
    available = [row[0].split("`")[1] for row in rows if row[3]]
    assert set(available) == set(FORMULAS)
    for name in FORMULAS:
        assert features_page.ORANGE in features_page.picture(name), name
