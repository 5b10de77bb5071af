"""Curves of tool poses, dense: rows x y z qw qx qy qz. The tool's z axis points back into the hand."""

import numpy as np


def quat(R):
    """Quaternions (..., 4) of rotation matrices (..., 3, 3), by the largest component."""
    R = np.asarray(R, float)
    m = np.empty((*R.shape[:-2], 4, 4))
    t = np.trace(R, axis1=-2, axis2=-1)
    w = np.stack([1 + t, 1 + 2 * R[..., 0, 0] - t, 1 + 2 * R[..., 1, 1] - t, 1 + 2 * R[..., 2, 2] - t], -1)
    a, b, c = R[..., 2, 1] - R[..., 1, 2], R[..., 0, 2] - R[..., 2, 0], R[..., 1, 0] - R[..., 0, 1]
    d, e, f = R[..., 1, 0] + R[..., 0, 1], R[..., 0, 2] + R[..., 2, 0], R[..., 2, 1] + R[..., 1, 2]
    m[..., 0, :] = np.stack([w[..., 0], a, b, c], -1)
    m[..., 1, :] = np.stack([a, w[..., 1], d, e], -1)
    m[..., 2, :] = np.stack([b, d, w[..., 2], f], -1)
    m[..., 3, :] = np.stack([c, e, f, w[..., 3]], -1)
    best = np.argmax(w, -1)
    q = np.take_along_axis(m, best[..., None, None], -2)[..., 0, :]
    return q / np.linalg.norm(q, axis=-1, keepdims=True)


def matrix(q):
    w, x, y, z = np.moveaxis(np.asarray(q, float), -1, 0)
    return np.stack(
        [
            np.stack([1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)], -1),
            np.stack([2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)], -1),
            np.stack([2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)], -1),
        ],
        -2,
    )


def frames(points, normals, forward=None):
    """Poses with z along the normals, and x along `forward` (a fixed direction) as far as possible."""
    z = normals / np.linalg.norm(normals, axis=1, keepdims=True)
    f = np.array([1.0, 0.3, 0.2]) if forward is None else np.asarray(forward, float)
    x = f - (z @ f)[:, None] * z
    x /= np.linalg.norm(x, axis=1, keepdims=True)
    R = np.stack([x, np.cross(z, x), z], -1)
    return unroll(np.hstack([points, quat(R)]))


def unroll(P):
    P = np.array(P, float)
    for i in range(1, len(P)):
        if P[i, 3:] @ P[i - 1, 3:] < 0:
            P[i, 3:] *= -1
    return P


def turn(P, Q, u):
    """Between poses P and Q at shares u (m,): straight, shorter rotation at constant rate."""
    p = (1 - u)[:, None] * P[:3] + u[:, None] * Q[:3]
    a, b = P[3:], Q[3:] if P[3:] @ Q[3:] >= 0 else -Q[3:]
    w = np.arccos(min(1.0, a @ b))
    if w < 1e-9:
        q = np.tile(a, (len(u), 1))
    else:
        q = (np.sin((1 - u) * w)[:, None] * a + np.sin(u * w)[:, None] * b) / np.sin(w)
    return np.hstack([p, q])


STEP = 5e-4  # m between rows


def straight(P, Q):
    n = max(2, int(np.ceil(np.linalg.norm(Q[:3] - P[:3]) / STEP)) + 1)
    return turn(np.asarray(P, float), np.asarray(Q, float), np.linspace(0, 1, n))


def arc(P, axis, center, angle):
    """Around an axis through center, keeping the orientation of P."""
    axis = np.asarray(axis, float) / np.linalg.norm(axis)
    r = P[:3] - center
    n = max(2, int(np.ceil(abs(angle) * np.linalg.norm(r) / STEP)) + 1)
    a = np.linspace(0, angle, n)[:, None]
    p = center + np.cos(a) * r + np.sin(a) * np.cross(axis, r) + (1 - np.cos(a)) * axis * (axis @ r)
    return np.hstack([p, np.tile(P[3:], (n, 1))])


def sequence(poses, blend):
    """Returns straight moves through poses. A quintic with continuous curvature replaces each corner, from `blend` (m)
    before to `blend` after it."""
    poses = [np.asarray(p, float) for p in poses]
    out, last = [], poses[0]
    for i in range(1, len(poses) - 1):
        a, b, c = poses[i - 1], poses[i], poses[i + 1]
        la, lc = np.linalg.norm(b[:3] - a[:3]), np.linalg.norm(c[:3] - b[:3])
        r = min(blend, 0.49 * la, 0.49 * lc)
        s = turn(a, b, np.array([1 - r / la]))[0]
        e = turn(b, c, np.array([r / lc]))[0]
        out.append(straight(last, s)[:-1])
        u = np.linspace(0, 1, max(8, int(2 * r / STEP)))
        h = u**3 * (10 - 15 * u + 6 * u * u)  # from the first line to the second one
        first = turn(a, b, 1 + (u * 2 - 1) * r / la * (u <= 2))  # goes on straight
        first = np.hstack([s[:3] + (2 * u * r / la)[:, None] * (b[:3] - a[:3]), np.zeros((len(u), 4))])
        second = e[:3] - (2 * (1 - u) * r / lc)[:, None] * (c[:3] - b[:3])
        p = (1 - h)[:, None] * first[:, :3] + h[:, None] * second
        q = np.array(
            [turn(turn(s, b, np.array([x]))[0], turn(b, e, np.array([x]))[0], np.array([x]))[0][3:] for x in u]
        )
        out.append(np.hstack([p, q])[:-1])
        last = e
    out.append(straight(last, poses[-1]))
    return unroll(np.vstack(out))


def lengths(P):
    """Way along the curve (m) at each row; a turn on the spot counts 0.1 m per radian."""
    d = np.linalg.norm(np.diff(P[:, :3], axis=0), axis=1)
    w = 2 * np.arccos(np.clip(np.abs(np.sum(P[1:, 3:] * P[:-1, 3:], axis=1)), 0, 1))
    return np.concatenate([[0], np.cumsum(np.where(d > 1e-9, d, 0.1 * w))])


def at(P, S, s):
    """Poses at ways s."""
    i = np.clip(np.searchsorted(S, s, side="right") - 1, 0, len(S) - 2)
    u = ((s - S[i]) / np.maximum(S[i + 1] - S[i], 1e-12))[:, None]
    X = (1 - u) * P[i] + u * P[i + 1]
    X[:, 3:] /= np.linalg.norm(X[:, 3:], axis=1, keepdims=True)
    return X
