"""Judges motions along tool paths by its own kinematics (from URDF), differences, and collision checks of samples."""

import warnings
import xml.etree.ElementTree as ET

import numpy as np

from tool_path_problems.curves import at, lengths, matrix


def chain(C, tip="tool"):
    """[(origin 4x4, axis or None, dof)] from the root to the tip."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        root = ET.fromstring(C.writeURDF())
    up, names = {}, list(C.getJointNames())
    for j in root.iter("joint"):
        o = j.find("origin")
        T = np.eye(4)
        if o is not None:
            r, p, y = [float(x) for x in o.get("rpy", "0 0 0").split()]
            cr, sr, cp, sp, cy, sy = np.cos(r), np.sin(r), np.cos(p), np.sin(p), np.cos(y), np.sin(y)
            T[:3, :3] = [
                [cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
                [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr],
                [-sp, cp * sr, cp * cr],
            ]
            T[:3, 3] = [float(x) for x in o.get("xyz", "0 0 0").split()]
        axis = None
        if j.get("type") in ("revolute", "continuous"):
            axis = np.array([float(x) for x in j.find("axis").get("xyz").split()])
        up[j.find("child").get("link")] = (
            j.find("parent").get("link"),
            T,
            axis,
            names.index(j.get("name")) if axis is not None else -1,
        )
    out, link = [], tip
    while link in up:
        link, T, axis, dof = up[link]
        out.append((T, axis, dof))
    return out[::-1]


def fk(links, Q):
    T = np.tile(np.eye(4), (len(Q), 1, 1))
    for origin, axis, dof in links:
        T = T @ origin
        if axis is not None:
            a, K = Q[:, dof][:, None, None], np.cross(np.eye(3), axis / np.linalg.norm(axis))
            M = np.tile(np.eye(4), (len(Q), 1, 1))
            M[:, :3, :3] = np.eye(3) + np.sin(a) * K + (1 - np.cos(a)) * (K @ K)
            T = T @ M
    return T


def judge(C, P, t, Q, free=None, tilt=0.0, speed=None, v=None, a=None, j=None, back=False, links=None):
    """Judges configurations Q at times t (even steps): deviation (mm, deg), jumps, shares of limits, free, speed."""
    links = chain(C) if links is None else links
    P = P[::-1] if back else P
    T = fk(links, Q)
    X = T[:, :3, 3]
    S = lengths(P)
    d = np.empty(len(X))
    where = np.empty(len(X))
    k = 0
    for i, x in enumerate(X):  # goes forward along the curve
        w = np.sum((P[k : k + 60, :3] - x) ** 2, 1)
        k += int(np.argmin(w))
        best = np.inf
        for b in (k - 1, k):
            if 0 <= b < len(P) - 1:
                e = P[b + 1, :3] - P[b, :3]
                u = np.clip((x - P[b, :3]) @ e / max(e @ e, 1e-18), 0, 1)
                q = np.linalg.norm(P[b, :3] + u * e - x)
                if q < best:
                    best, where[i] = q, S[b] + u * (S[b + 1] - S[b])
        d[i] = best
    R, G = T[:, :3, :3], matrix(at(P, S, where)[:, 3:])
    if free is None:
        w = np.arccos(np.clip((np.einsum("kij,kij->k", R, G) - 1) / 2, -1, 1))
    else:
        w = np.maximum(0, np.arccos(np.clip(np.sum(R[:, :, 2] * G[:, :, 2], 1), -1, 1)) - tilt)
    h = t[1] - t[0]
    D = [np.diff(Q, m, axis=0) / h**m for m in (1, 2, 3)]
    lo, hi = C.getJointLimits()
    tip = np.linalg.norm(np.diff(X, axis=0), axis=1) / h
    out = {
        "mm": 1e3 * d.max(),
        "deg": np.degrees(w.max()),
        "step": np.abs(np.diff(Q, axis=0)).max(),
        "v": np.max(np.abs(D[0]) / v),
        "a": np.max(np.abs(D[1])) / a,
        "j": np.max(np.abs(D[2])) / j,
        "inside": bool(np.all(lo - 2e-5 < Q) and np.all(hi + 2e-5 > Q)),
        "free": bool(C.isValid(Q).all()),
        "done": where[-1] / S[-1],
        "duration": float(t[-1] - t[0]),
    }
    if speed:
        out["fast"] = tip.max() / speed
        # the share of the way that is done within 1 % of the speed
        near = np.abs(tip / speed - 1) < 0.01
        out["steady"] = float(np.sum(tip[near]) / max(np.sum(tip), 1e-12))
    return out
