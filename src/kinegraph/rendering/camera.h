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
  double near = .1, far = 10.;       ///< what is seen lies in between, m along z
  bool has_range = false;  ///< somebody has said what `near` and `far` are: pages show no more than that either

  /// fx, fy, cx, cy in pixels.
  Vector4d fxycxy() const { return {focal_length * height, focal_length * height, .5 * width, .5 * height}; }

  /// Throws ValueError for sizes, focal lengths and ranges that are no camera's.
  void validate() const;
};

/// The camera that a frame's attributes describe, at its pose: `focalLength` or `heightAngle` (the image's vertical
/// angle, degrees) or `orthoAbsHeight` / `heightAbs` (m), `width`, `height`, `zRange` [near far]. What is missing is as
/// in Camera. Throws ValueError for attributes that make no sense.
Camera cameraOf(const Frame& frame);

/// What a viewer starts with: 600 x 500, from (2, 5, 1.7) towards (0, 0, 1).
Camera defaultViewCamera();

}  // namespace kinegraph
