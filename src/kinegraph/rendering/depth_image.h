#pragma once

#include <vector>

#include "kinegraph/common/random.h"
#include "kinegraph/rendering/camera_renderer.h"

namespace kinegraph {

/// Converts a depth image to points in the camera's frame, height x width x 3: X = (column - cx) d / fx,
/// Y = (row - cy) d / fy, Z = d. Negative depths give zero. `fxycxy` is fx fy cx cy in pixels.
std::vector<double> depthToPoints(const float* depth, int height, int width, const Vector4d& fxycxy);

/// Parameters of the errors of a stereo camera.
struct DepthNoise {
  double baseline = .03;  ///< distance of its two eyes, m
  double overall = .02;   ///< scale of the noise, relative to depth squared, 1/m
  double wide = 4.;       ///< share of the noise that is smooth over 10 pixels
  double local = .4;      ///< share over 3 pixels
  double pixel = .04;     ///< share of independent pixels
  double no_depth = 3.;   ///< m, assumed depth of the background

  /// Throws ValueError for numbers that are negative or not finite.
  void validate() const;
};

/// Adds the errors of a stereo camera to `depth`, an image of `camera`. `other_eye` is the depth from `noise.baseline`
/// to the right. Pixels visible to one eye only (the depths differ by more than 5 cm) become -1; the others get noise
/// that grows with the square of the depth.
void addDepthNoise(std::vector<float>& depth, const std::vector<float>& other_eye, const Camera& camera,
                   const DepthNoise& noise, Rng& rng);

/// Returns the camera of the other eye.
Camera otherEye(const Camera& camera, const DepthNoise& noise);

}  // namespace kinegraph
