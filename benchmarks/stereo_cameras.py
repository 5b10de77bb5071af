"""Images of scenes as a stereo camera takes them."""

from __future__ import annotations

import numpy as np

import kinegraph as ry


def camera_pose(eye, at):
    """The pose, shape (7,), of an upright camera at `eye` whose axis goes through `at`."""
    z = np.subtract(at, eye) / np.linalg.norm(np.subtract(at, eye))
    x = np.cross(z, [0, 0, 1]) / np.linalg.norm(np.cross(z, [0, 0, 1]))
    frame = ry.Config().addFrame("camera").setRotationMatrix(np.stack([x, np.cross(z, x), z], axis=1))
    return np.concatenate([eye, frame.getQuaternion()])


def image(world, camera, rng):
    """A DepthView of a camera frame, with noise that grows with the depth, and holes at edges and elsewhere."""
    view = ry.CameraView(world)
    view.setCamera(camera)
    depth = view.computeImageAndDepth()[1].astype(float)
    edge = np.zeros(depth.shape, bool)
    edge[:, 1:] |= abs(np.diff(depth, axis=1)) > 0.03
    edge[1:, :] |= abs(np.diff(depth, axis=0)) > 0.03
    depth += 0.0027 * depth**2 * rng.normal(size=depth.shape)
    depth[(edge & (rng.random(depth.shape) < 0.7)) | (rng.random(depth.shape) < 0.01)] = 0
    return ry.DepthView(depth, view.getFxycxy(), camera)
