#pragma once

#include <vector>

#include "kinegraph/common/random.h"
#include "kinegraph/rendering/camera_renderer.h"

namespace kinegraph {

/// The points of a depth image in the camera's frame: X = (column - cx) d / fx, Y = (row - cy) d / fy, Z = d; zero
/// where the depth is negative. height x width x 3. `fxycxy`: fx fy cx cy in pixels.
std::vector<double> depthToPoints(const float* depth, int height, int width, const Vector4d& fxycxy);

/// The errors of a stereo camera.
struct DepthNoise {
  double baseline = .03;  ///< between its two eyes, m
  double overall = .02;   ///< scale of the noise, relative to depth squared, 1/m
  double wide = 4.;       ///< share of noise that is smooth over 10 pixels
  double local = .4;      ///< over 3 pixels
  double pixel = .04;     ///< of each pixel alone
  double no_depth = 3.;   ///< m, taken where nothing is

  /// Throws ValueError for numbers that are negative or not finite.
  void validate() const;
};

/// Makes `depth`, as `camera` sees it, look measured. `other_eye` is the depth seen from `noise.baseline` to the right.
/// What only one eye sees (they differ by more than 5 cm) becomes -1; the rest gets noise that grows with depth
/// squared.
void addDepthNoise(std::vector<float>& depth, const std::vector<float>& other_eye, const Camera& camera,
                   const DepthNoise& noise, Rng& rng);

/// The camera of the other eye.
Camera otherEye(const Camera& camera, const DepthNoise& noise);

}  // namespace kinegraph
