#pragma once

#include "kinegraph/math/look_at.h"
#include "kinegraph/scene/frame.h"

namespace kinegraph {

/// A pinhole or orthographic camera. Its axes: x to the right of the image, y down, z forward.
/// The center of the image is on the z axis; pixels are square.
struct Camera {
  Pose pose;        ///< in the world
  int width = 640;  ///< pixels
  int height = 480;
  double focal_length = 2.41421356;  ///< in image heights: fx = fy = focal_length * height pixels
  double ortho_height = 0.;          ///< if > 0: orthographic, this many m high
  double near = .1, far = 10.;       ///< visible range, m along z
  bool has_range = false;            ///< `near` and `far` were set explicitly: pages are limited to them, too

  /// fx, fy, cx, cy in pixels.
  Vector4d fxycxy() const { return {focal_length * height, focal_length * height, .5 * width, .5 * height}; }

  /// Throws ValueError for invalid sizes, focal lengths and ranges.
  void validate() const;
};

/// Reads a camera from a frame's attributes, at the frame's pose: `focalLength`, `heightAngle` (the image's vertical
/// angle, degrees) or `orthoAbsHeight` / `heightAbs` (m); `width`, `height`, `zRange` [near far]. The defaults are
/// those of Camera. Throws ValueError for invalid attributes.
Camera cameraOf(const Frame& frame);

/// Tells whether a frame describes a camera: its shape is `camera`, or it has one of these attributes.
bool isCamera(const Frame& frame);

/// The initial camera of a viewer: 600 x 500 pixels, from (2, 5, 1.7) towards (0, 0, 1).
Camera defaultViewCamera();

}  // namespace kinegraph
