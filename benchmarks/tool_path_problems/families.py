"""Draws tool path problems by a seed, for benchmarks/tool_paths.py: robots and families.

A problem is a dict: name, family, robot ("panda", "ur10"), boxes [(name, center, size)], paths [poses (K, 7)], free
(None, or "axis": the rotation about the tool's z axis), tilt (rad, a cone around z), speed (m/s), expect ("motion", or
"reach", "collision", "limits"), `where` ((from, to), m: the interval of the failure), order (True: free). The tool's z
axis points back into the hand.

    a  lines of 10 to 60 cm, half of them with a rotation     d  circle, arc, spiral, blended polygon
    b  lines that need another branch than that next to home  e  rasters on plane, cylinder, sphere between clamps
    c  lines near a singularity                               f  5 to 20 seams in any order
                                                              g  impossible ones

Families a to d have a certificate: the generator followed the curve from a configuration.
"""

import numpy as np

import kinegraph as ry
from tool_path_problems.curves import STEP, arc, at, frames, lengths, matrix, quat, sequence, straight, unroll

ACC, JERK = 6.0, 120.0  # rad/s^2, rad/s^3, all joints


def scene(robot, boxes=()):
    C = ry.Config()
    if robot == "panda":
        C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
        hand, base = "l_gripper", "table"
        C.addFrame("pen", hand).setShape(ry.ST.capsule, [0.06, 0.008]).setRelativePosition([0, 0, -0.032]).setContact(
            -2
        )
        C.addFrame("tool", hand).setRelativePosition([0, 0, -0.08])
    else:
        C.addFile(ry.raiPath("ur10/ur10.g"))
        hand, base = "ur_ee_fixed_joint", "world_base"
        C.addFrame(base).setPosition([0, 0, -0.05]).setShape(ry.ST.ssBox, [2.4, 2.4, 0.06, 0.005]).setContact(1)
        for name in C.getFrameNames():
            if name.startswith("ur_") and C.getFrame(name).info().get("shape"):
                C.getFrame(name).setContact(-2)
        out = outward(C, hand)
        C.addFrame("mount", hand).setRelativeQuaternion(quat(out))
        C.addFrame("pen", "mount").setShape(ry.ST.capsule, [0.13, 0.012]).setRelativePosition(
            [0, 0, -0.075]
        ).setContact(-2)
        C.addFrame("tool", "mount").setRelativePosition([0, 0, -0.16])
    for name, center, size in boxes:
        C.addFrame(name, base).setShape(ry.ST.ssBox, [*size, 0.002]).setPosition(list(center)).setContact(1)
    return C


def outward(C, hand):
    """Returns the rotation of a frame, in the flange's coordinates, whose -z axis points outwards along wrist_3."""
    a = C.getFrame(hand).getPosition() - C.getFrame("ur_wrist_3_joint").getPosition()
    R = matrix(C.getFrame(hand).getQuaternion())
    axes = R.T @ (a / np.linalg.norm(a))
    k = int(np.argmax(np.abs(axes)))
    z = np.zeros(3)
    z[k] = -np.sign(axes[k])
    x = np.roll(np.abs(z), 1)
    return np.stack([x, np.cross(z, x), z], -1)


def limits(C):
    return np.array(C.getVelocityLimits()), ACC, JERK


# -- certificates ------------------------------------------------------------------------------------------------------


def rows(C, Q, P, free=None, tilt=0.0):
    """Returns errors and Jacobians of the tool at Q for the poses P."""
    y, J = C.evalBatch(ry.FS.pose, ["tool"], Q)
    e, Jr = y[:, :3] - P[:, :3], J[:, :3]
    q, dq = y[:, 3:], J[:, 3:]
    w, v = q[:, :1], q[:, 1:]
    Jw = 2 * (w[..., None] * dq[:, 1:] - v[..., None] * dq[:, :1] + np.cross(v[:, :, None], dq[:, 1:], axis=1))
    R, T = matrix(q), matrix(P[:, 3:])
    if free is None:
        E = 0.5 * sum(np.cross(T[:, :, k], R[:, :, k]) for k in range(3))
        return np.hstack([e, E]), np.concatenate([Jr, Jw], 1), R
    z, zt = R[:, :, 2], T[:, :, 2]
    n = np.cross(zt, z)
    s = np.linalg.norm(n, axis=1)
    angle = np.arctan2(s, np.sum(z * zt, 1))
    u = n / np.maximum(s, 1e-12)[:, None]
    if tilt == 0:
        E = u * angle[:, None]
        return np.hstack([e, E]), np.concatenate([Jr, Jw - (z[:, :, None] * (z[:, None, :] @ Jw))], 1), R
    over = np.maximum(0, angle - tilt)
    E = over[:, None]
    Ja = np.where((over > 0)[:, None, None], u[:, None, :] @ Jw, 0)
    return np.hstack([e, E]), np.concatenate([Jr, Ja], 1), R


def project(C, Q, P, free=None, tilt=0.0, steps=8, tolerance=1e-8):
    """Projects each row to the curve by Newton steps. Returns Q and the worst error of each row."""
    Q = np.array(Q, float)
    for _ in range(steps):
        e, J, _ = rows(C, Q, P, free, tilt)
        bad = np.max(np.abs(e), 1)
        if bad.max() < tolerance:
            break
        A = J @ J.transpose(0, 2, 1) + 1e-10 * np.eye(J.shape[1])
        d = -(J.transpose(0, 2, 1) @ np.linalg.solve(A, e[..., None]))[..., 0]
        d *= np.minimum(1, 0.3 / np.maximum(np.max(np.abs(d), 1), 1e-9))[:, None]
        Q = Q + d
    e, J, _ = rows(C, Q, P, free, tilt)
    return Q, np.max(np.abs(e), 1)


def follow(C, q, P, ds=4e-3):
    """Follows P from q. Returns the configurations or None, the least singular value, and the share followed."""
    S = lengths(P)
    X = at(P, S, np.linspace(0, S[-1], int(np.ceil(S[-1] / ds)) + 1))
    Q, least = [np.array(q)], np.inf
    lo, hi = C.getJointLimits()
    for k in range(len(X)):
        guess = Q[-1] if len(Q) < 2 else 2 * Q[-1] - Q[-2]
        new, bad = project(C, guess[None], X[k : k + 1])
        if bad[0] > 1e-6 or np.max(np.abs(new[0] - Q[-1])) > 0.25 or np.any(new[0] < lo) or np.any(new[0] > hi):
            return None, least, k / len(X)
        _, J, _ = rows(C, new, X[k : k + 1])
        least = min(least, np.linalg.svd(J[0], compute_uv=False)[-1])
        Q.append(new[0])
    Q = np.array(Q[1:])
    return (Q if C.isValid(Q).all() else None), least, 1.0


def configurations(C, rng, many):
    lo, hi = C.getJointLimits()
    lo, hi = np.maximum(lo, -3.1), np.minimum(hi, 3.1)
    Q = rng.uniform(lo, hi, (many, len(lo)))
    return Q[C.isValid(Q, margin=0.02)]


def home(C, robot):
    return np.array([0, -0.5, 0, -2, 0, 2, -0.5]) if robot == "panda" else np.array([0, -2.0, 1.6, -1.2, -1.5, 0])


def tool(C, Q):
    return C.evalBatch(ry.FS.pose, ["tool"], Q)[0]


def problem(**k):
    d = {"boxes": [], "free": None, "tilt": 0.0, "speed": 0.1, "expect": "motion", "where": None, "order": False}
    d.update(k)
    return d


# -- families ---------------------------------------------------------------------------------------------------------


def lines(robot, seed, kind="a"):
    """a: well inside of a branch. b: the branch of the solution next to home fails, another one does it. c: passes near
    a singularity (least singular value of the 6 x n Jacobian below 0.03, m and rad)."""
    rng = np.random.default_rng([seed, ord(kind), robot == "panda"])
    C = scene(robot)
    while True:
        for q in configurations(C, rng, 400):
            P0 = tool(C, q[None])[0]
            if not (0.25 < P0[2] - (0.6 if robot == "panda" else 0) < 1.0):
                continue
            d = rng.normal(size=3)
            L = rng.uniform(0.1, 0.6)
            P1 = P0.copy()
            P1[:3] += L * d / np.linalg.norm(d)
            if kind == "a" and rng.random() < 0.5:  # turns on the way
                w = rng.normal(size=3) * 0.3
                P1[3:] = np.r_[P1[3] - 0.5 * w @ P1[4:], P1[4:] + 0.5 * (P1[3] * w + np.cross(w, P1[4:]))]
                P1[3:] /= np.linalg.norm(P1[3:])
            P = straight(P0, P1)
            Q, least, _ = follow(C, q, P)
            if Q is None or not C.isValid(Q, margin=0.005).all():
                continue
            if (kind == "a" and least < 0.08) or (kind == "c" and not 1e-4 < least < 0.03):
                continue
            if kind == "b":
                C.setJointState(home(C, robot))
                near = ry.solveIk(C, {"tool": {"pose": P0}}, best=True)
                if not near.feasible or follow(C, near.q, P)[0] is not None:
                    continue
            return problem(name=f"{kind}-{robot}-{seed}", family=kind, robot=robot, paths=[P], speed=0.1, certificate=Q)


def rounds(robot, seed):
    """d: circle, arc, spiral, blended polygon, with one orientation."""
    rng = np.random.default_rng([seed, 4, robot == "panda"])
    C = scene(robot)
    kind = ["circle", "arc", "spiral", "polygon"][seed % 4]
    while True:
        for q in configurations(C, rng, 400):
            P0 = tool(C, q[None])[0]
            z = P0[2] - (0.6 if robot == "panda" else 0)
            if not 0.2 < z < 0.9:
                continue
            n = rng.normal(size=3)
            n /= np.linalg.norm(n)
            u = np.cross(n, rng.normal(size=3))
            u /= np.linalg.norm(u)
            r = rng.uniform(0.03, 0.15)
            if kind in ("circle", "arc"):
                P = arc(P0, n, P0[:3] + r * u, 2 * np.pi if kind == "circle" else rng.uniform(1, 4))
            elif kind == "spiral":
                m = int(4 * np.pi * r / STEP)
                a = np.linspace(0, 6 * np.pi, m)[:, None]
                c = (0.2 + 0.8 * a / a[-1]) * r * (np.cos(a) * u + np.sin(a) * np.cross(n, u))
                P = np.hstack([P0[:3] + c - c[0], np.tile(P0[3:], (m, 1))])
            else:
                corners = [P0[:3]]
                for k in range(5):
                    corners.append(
                        corners[-1] + rng.uniform(0.05, 0.15) * (np.cos(2.2 * k) * u + np.sin(2.2 * k) * np.cross(n, u))
                    )
                P = sequence([np.r_[c, P0[3:]] for c in corners], 0.01)
            Q, least, _ = follow(C, q, P)
            if Q is None or least < 0.05 or not C.isValid(Q, margin=0.005).all():
                continue
            return problem(name=f"d-{kind}-{robot}-{seed}", family="d", robot=robot, paths=[P], certificate=Q)


def meander(length, width, lines_):
    """A raster in the plane with half circles between its lines: points (K, 2)."""
    gap = width / (lines_ - 1)
    out = []
    for k in range(lines_):
        y = -width / 2 + k * gap
        x = np.linspace(-length / 2, length / 2, int(length / STEP))
        x = x if k % 2 == 0 else x[::-1]
        out.append(np.stack([x, np.full_like(x, y)], 1))
        if k < lines_ - 1:
            a = np.linspace(-np.pi / 2, np.pi / 2, max(12, int(np.pi * gap / 2 / STEP)))[1:-1]
            s = 1 if k % 2 == 0 else -1
            out.append(np.stack([s * (length / 2 + gap / 2 * np.cos(a)), y + gap / 2 + gap / 2 * np.sin(a)], 1))
    return np.vstack(out)


def part(robot):
    return np.array([0.0, 0.32, 0.85]) if robot == "panda" else np.array([0.75, 0.15, 0.35])


CONE = np.radians(15)


def raster(robot, seed):
    """e: raster on a tilted plane, a cylinder or a sphere. The tool axis is free within a cone; clamps are nearby."""
    rng = np.random.default_rng([seed, 5, robot == "panda"])
    kind = ["plane", "cylinder", "sphere"][seed % 3]
    c = part(robot) + rng.uniform(-0.05, 0.05, 3)
    size = 0.22 if robot == "panda" else 0.35
    xy = meander(size, 0.8 * size, int(rng.integers(4, 9)))
    if kind == "plane":
        a, b = rng.uniform(-0.5, 0.5, 2)
        R = matrix(np.array([np.cos(a / 2), np.sin(a / 2), 0, 0])) @ matrix(
            np.array([np.cos(b / 2), 0, np.sin(b / 2), 0])
        )
        X, N = c + np.c_[xy, 0 * xy[:, 0]] @ R.T, np.tile(R[:, 2], (len(xy), 1))
    elif kind == "cylinder":
        r = size / 1.4
        a = xy[:, 1] / r
        N = np.stack([0 * a, np.sin(a), np.cos(a)], 1)
        X = c + np.stack([xy[:, 0], 0 * a, 0 * a], 1) + r * N - [0, 0, r]
    else:
        r = size
        N = np.stack(
            [xy[:, 0] / r, xy[:, 1] / r, np.sqrt(np.maximum(0.05, 1 - (xy[:, 0] ** 2 + xy[:, 1] ** 2) / r**2))], 1
        )
        N /= np.linalg.norm(N, axis=1, keepdims=True)
        X = c + r * N - [0, 0, r]
    boxes = []
    for k, (x, y) in enumerate(
        [(1, 1), (-1, 1), (1, -1), (-1, -1)][: int(rng.integers(2, 5))]
    ):  # clamps around the raster
        high = (
            0.06 if robot == "panda" or kind == "sphere" else 0.12
        )  # the Panda's hand is wide; on a sphere the tool leans outwards
        boxes.append(
            (
                f"clamp{k}",
                c + np.array([x * (size / 2 + 0.07), y * (size / 2 + 0.06), high / 2 - 0.04]),
                [0.04, 0.04, high],
            )
        )
    return problem(
        name=f"e-{kind}-{robot}-{seed}",
        family="e",
        robot=robot,
        boxes=boxes,
        paths=[frames(X, N)],
        free="axis",
        tilt=CONE,
        speed=float(rng.choice([0.05, 0.1, 0.2])),
    )


def seams(robot, seed):
    """f: 5 to 20 seams on a plate with clamps between them, in any order and from either end."""
    rng = np.random.default_rng([seed, 6, robot == "panda"])
    c = part(robot)
    size = 0.3 if robot == "panda" else 0.6
    boxes = [
        (f"clamp{k}", c + np.r_[size * (np.array([k % 2, k // 2]) - 0.5) * 0.45, 0.0], [0.03, 0.03, 0.1])
        for k in range(4)
    ]
    paths, many = [], int(rng.integers(5, 21))
    while len(paths) < many:
        a, phi, L = rng.uniform(-size / 2, size / 2, 2), rng.uniform(0, 2 * np.pi), rng.uniform(0.03, 0.1)
        b = a + L * np.array([np.cos(phi), np.sin(phi)])
        pts = np.linspace(a, b, max(3, int(L / STEP)))
        if np.abs(b).max() > size / 2 or any(
            np.min(np.linalg.norm(pts + c[:2] - bx[1][:2], axis=1)) < 0.065 for bx in boxes
        ):
            continue
        X = np.c_[pts + c[:2], np.full(len(pts), c[2] - 0.03)]
        paths.append(frames(X, np.tile([0, 0, 1.0], (len(X), 1))))
    return problem(
        name=f"f-{robot}-{seed}",
        family="f",
        robot=robot,
        boxes=boxes,
        paths=paths,
        free="axis",
        tilt=CONE,
        speed=0.05,
        order=True,
    )


def wrong(robot, seed):
    """g: out of reach, or with an obstacle in the way, or with more turns than the last joint has."""
    kind = ["reach", "collision", "limits"][seed % 3]
    rng = np.random.default_rng([seed, 7, robot == "panda"])
    if kind == "limits":  # the tool turns by more than its last joint can
        c = part(robot)
        P = frames(np.tile(c, (400, 1)), np.tile([0, 0, 1.0], (400, 1)))
        total = 13.0 if robot == "panda" else 14.5  # a UR10 has 4 pi, a Panda 5.8 and some more by its elbow
        a = np.linspace(0, total, 400)
        R = matrix(P[:, 3:])
        Rz = np.stack(
            [
                np.stack([np.cos(a), -np.sin(a), 0 * a], -1),
                np.stack([np.sin(a), np.cos(a), 0 * a], -1),
                np.stack([0 * a, 0 * a, 1 + 0 * a], -1),
            ],
            -2,
        )
        P[:, 3:] = quat(R @ Rz)
        return problem(name=f"g-limits-{robot}-{seed}", family="g", robot=robot, paths=[unroll(P)], expect="limits")
    c = part(robot)
    d = np.array([0.2, 1.0, 0.1]) if robot == "panda" else np.array([1.0, 0.3, 0.1])
    d = d / np.linalg.norm(d)
    L = 1.2 if kind == "reach" else 0.3
    base = np.array([0, -0.2, 0.983]) if robot == "panda" else np.array([0, 0, 0.127])
    most = (
        0.855 + 0.21 + 0.08 if robot == "panda" else 1.4
    )  # no tool that points down (to 0.2 rad) can be farther away: sums of links
    X = c + np.linspace(-0.05, L, int(L / STEP))[:, None] * d
    P = frames(X, np.tile([0, 0, 1.0], (len(X), 1)))
    S = lengths(P)
    if kind == "reach":
        far = np.linalg.norm(X - base, axis=1) > most
        return problem(
            name=f"g-reach-{robot}-{seed}",
            family="g",
            robot=robot,
            paths=[P],
            free="axis",
            tilt=0.2,
            expect="reach",
            where=(0.0, S[np.argmax(far)]),
        )
    s = rng.uniform(0.1, 0.2)
    x = at(P, S, np.array([s]))[0, :3]
    boxes = [("block", x + np.array([0, 0, 0.03]), [0.05, 0.05, 0.05])]  # around the tip and the pen above it
    return problem(
        name=f"g-collision-{robot}-{seed}",
        family="g",
        robot=robot,
        boxes=boxes,
        paths=[P],
        free="axis",
        tilt=0.2,
        expect="collision",
        where=(s - 0.06, s + 0.06),
    )


def all_problems(seeds, families="abcdefg", robots=("panda", "ur10")):
    """Draws the problems of these families and robots by seeds."""
    draw = {
        "a": lambda robot, seed: lines(robot, seed, "a"),
        "b": lambda robot, seed: lines(robot, seed, "b"),
        "c": lambda robot, seed: lines(robot, seed, "c"),
        "d": rounds,
        "e": raster,
        "f": seams,
        "g": wrong,
    }
    for robot in robots:
        for seed in seeds:
            for family in families:
                yield draw[family](robot, seed)
