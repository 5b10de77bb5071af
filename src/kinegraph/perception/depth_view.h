#pragma once

#include <string>
#include <vector>

#include "kinegraph/scene/config.h"

namespace kinegraph {

/// A depth image with the camera that took it. The camera looks along z of its frame, x to the right and y down. Pixel
/// (row, column) shows the point X = (column + .5 - cx) d / fx, Y = (row + .5 - cy) d / fy, Z = d.
struct DepthView {
  std::vector<float> depth;            ///< m, row by row; zero, negative and non-finite numbers: not measured
  int width = 0, height = 0;           ///< pixels
  Vector4d fxycxy = Vector4d::Zero();  ///< fx fy cx cy in pixels
  std::string camera = {};             ///< the camera's frame in the scene; empty: `pose`
  Pose pose = {};                      ///< of the camera in the world
  double noise = .0027;                ///< standard deviation of a pixel's depth over its depth squared, 1/m
  double bias = .0019;                 ///< the same for an error that all pixels of an object share, 1/m

  /// Throws ValueError for an image of another size, for a center outside of it, focal lengths that do not fit, depths
  /// that look like millimeters, and invalid poses. `where` names the view.
  void validate(const std::string& where) const;

  /// The camera's pose in the world; throws FrameNotFound for an unknown frame.
  Pose cameraPose(const Config& config) const;
};

}  // namespace kinegraph
