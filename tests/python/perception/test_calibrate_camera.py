"""Poses of cameras and markers from images of the marker at several configurations."""

import numpy as np
import pytest

import kinegraph as ry

F = np.array([600.0, 600.0, 320.0, 240.0])
CORNERS = 0.03 * np.array([[-1.0, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]])


def matrix(pose):
    w, x, y, z = pose[3:]
    R = np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )
    T = np.eye(4)
    T[:3, :3], T[:3, 3] = R, pose[:3]
    return T


def errors(found, true):
    """Distance in m, and angle in degrees."""
    D = np.linalg.inv(matrix(true)) @ matrix(found)
    return np.linalg.norm(D[:3, 3]), np.rad2deg(np.arccos(np.clip((np.trace(D[:3, :3]) - 1) / 2, -1, 1)))


def arm(on_hand):
    """A Panda with a camera on the hand and a marker on the table, or vice versa."""
    C = ry.Config()
    C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
    hand, table = ("cam", "marker") if on_hand else ("marker", "cam")
    C.addFrame(hand, "l_panda_hand_joint").setRelativePose([0.05, 0.02, 0.04, 0.7, 0.05, -0.03, 0.71])
    if on_hand:
        C.addFrame(table).setPose([0.0, 0.45, 0.66, 1, 0.02, 0, 0.3])
    else:
        C.addFrame(table).setPose([0.0, 1.3, 1.2, 0, 0, 0.8, -0.6])
    return C


def images(C, count, seed, on_hand=True, pixel=0.1, joint=3e-4, spread=0.6):
    """Draws configurations at which the camera sees the marker, and the pixels of its corners with errors."""
    rng = np.random.default_rng(seed)
    home, Q, pixels = C.getJointState(), [], []
    target = C.getFrame("marker").getPosition()
    for _ in range(2000):
        q = home + spread * rng.normal(size=7) * [0.3, 0.3, 0.3, 0.3, 1, 1, 1]
        if on_hand:
            away = [0, 0, 1] + rng.normal(size=3) * [spread, spread, 0]
            eye = target + rng.uniform(0.35, 0.5) * away / np.linalg.norm(away)
            C.setJointState(home + 0.3 * rng.normal(size=7))
            r = ry.solveIk(C, {"cam": {"position": list(eye), "gaze": list(target + 0.02 * rng.normal(size=3))}})
            if not r.feasible:
                continue
            q = r.q
        C.setJointState(q + joint * rng.normal(size=7))  # the true angles of the arm
        M, T = matrix(C.getFrame("marker").getPose()), matrix(C.getFrame("cam").getPose())
        x = (CORNERS @ M[:3, :3].T + M[:3, 3] - T[:3, 3]) @ T[:3, :3]
        if (x[:, 2] < 0.1).any() or M[:3, 2] @ (T[:3, 3] - M[:3, 3]) < 0.05:
            continue
        uv = x[:, :2] / x[:, 2:] * F[:2] + F[2:]
        if (uv > 0).all() and (uv < [640, 480]).all():
            Q.append(q)
            pixels.append(uv + pixel * rng.normal(size=uv.shape))
        if len(Q) == count:
            break
    C.setJointState(home)
    assert len(Q) == count
    return np.array(Q), np.array(pixels)


def placeOf(C, name):
    frame = C.getFrame(name)
    return frame.getRelativePose() if frame.getParent() else frame.getPose()


def displaced(C):
    """Forgets the poses of camera and marker."""
    for name in ("cam", "marker"):
        frame = C.getFrame(name)
        (frame.setRelativePose if frame.getParent() else frame.setPose)([0.1, 0.2, 0.3, 1, 0, 0, 0])


@pytest.mark.parametrize("on_hand", [True, False])
def test_exact_images_give_the_exact_poses_without_a_start(on_hand):
    C = arm(on_hand)
    cam, marker = placeOf(C, "cam"), placeOf(C, "marker")
    Q, pixels = images(C, 6, 1, on_hand, pixel=0, joint=0)
    displaced(C)
    result = ry.calibrateCamera(C, "cam", "marker", CORNERS, F, Q, pixels)
    assert max(errors(result.camera, cam)) < 1e-5
    assert max(errors(result.marker, marker)) < 1e-5
    assert errors(placeOf(C, "cam"), cam)[0] < 1e-6
    assert result.pixel_error < 1e-4 and result.warnings == []


def test_ten_views_with_errors_of_joints_are_within_a_millimeter_and_the_covariance():
    found, angles, share = [], [], []
    for seed in range(8):
        C = arm(True)
        cam = placeOf(C, "cam")
        Q, pixels = images(C, 10, 200 + seed)
        displaced(C)
        result = ry.calibrateCamera(C, "cam", "marker", CORNERS, F, Q, pixels)
        distance, angle = errors(result.camera, cam)
        found.append(distance)
        angles.append(angle)
        step = result.camera[:3] - cam[:3]
        share.append(step @ np.linalg.solve(result.covariance[:3, :3], step))
    assert np.median(found) < 1.2e-3 and np.median(angles) < 0.2
    assert max(found) < 4e-3
    assert 0.3 < np.mean(share) < 8  # 3 is expected


def test_rotations_about_one_axis_do_not_determine_the_camera():
    C = arm(True)
    Q, _ = images(C, 1, 3)
    Q = np.repeat(Q, 8, 0)
    Q[:, 6] += np.linspace(-0.3, 0.3, 8)
    many = []
    for q in Q:
        C.setJointState(q)
        M, T = matrix(C.getFrame("marker").getPose()), matrix(C.getFrame("cam").getPose())
        x = (CORNERS @ M[:3, :3].T + M[:3, 3] - T[:3, 3]) @ T[:3, :3]
        many.append(x[:, :2] / x[:, 2:] * F[:2] + F[2:])
    with pytest.warns(UserWarning, match="do not determine"):
        result = ry.calibrateCamera(C, "cam", "marker", CORNERS, F, Q, many)
    assert len(result.free_directions) >= 1


def test_a_wrong_order_of_corners_is_a_warning():
    C = arm(True)
    Q, pixels = images(C, 8, 4)
    pixels[3] = pixels[3][[1, 2, 3, 0]]
    with pytest.warns(UserWarning, match="fit .* times worse"):
        ry.calibrateCamera(C, "cam", "marker", CORNERS, F, Q, pixels)


def test_invalid_images_are_refused_and_leave_the_scene():
    C = arm(True)
    Q, pixels = images(C, 4, 5)
    before = C.getFrameState()
    for points, q, uv, text in (
        (1000 * CORNERS, Q, pixels, "in meters"),
        (CORNERS[:3], Q, pixels, "n >= 4"),
        (CORNERS, Q[:2], pixels[:2], "at least 3"),
        (CORNERS, Q, pixels[:3], "expected one each"),
        (CORNERS, Q[:, :6], pixels, "joint angles"),
        (CORNERS, np.full_like(Q, np.nan), pixels, "finite"),
        (CORNERS, np.repeat(Q[:1], 4, 0), pixels, "do not move camera"),
    ):
        with pytest.raises(ry.ArgumentError, match=text):
            ry.calibrateCamera(C, "cam", "marker", points, F, q, uv)
    with pytest.raises(ry.FrameNotFound):
        ry.calibrateCamera(C, "cam", "nothing", CORNERS, F, Q, pixels)
    assert np.array_equal(C.getFrameState(), before)
