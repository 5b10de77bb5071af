"""What the tests of tool paths compute of motions."""

import numpy as np

import kinegraph as ry

X, Y, Z = np.eye(3)
LIMITS = {"acceleration": 6.0, "jerk": 120.0}


def poses(C, q, frame="tool"):
    return C.evalBatch(ry.FS.pose, [frame], q)[0]


def samples(plan, rate=1000.0):
    return plan.sample(rate)[:2]


def distance_from_line(p, a, b):
    u = (b - a) / np.linalg.norm(b - a)
    s = np.clip((p - a) @ u, 0, np.linalg.norm(b - a))
    return np.linalg.norm(p - a - s[:, None] * u, axis=1)
