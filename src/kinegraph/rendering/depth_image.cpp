#include "kinegraph/rendering/camera_renderer.h"

#include <algorithm>
#include <cmath>

#include "kinegraph/common/text.h"

namespace kinegraph {

namespace {

constexpr double kOccluded = .05;  // m

using Field = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Returns white noise averaged over windows of size x size pixels.
Field smoothNoise(int height, int width, int size, Rng& rng) {
  Field noise(height + size - 1, width + size - 1);
  for (double& x : noise.reshaped()) x = rng.normal();
  Field rows = Field::Zero(height + size - 1, width);
  for (int i = 0; i < size; ++i) rows += noise.middleCols(i, width);
  Field out = Field::Zero(height, width);
  for (int i = 0; i < size; ++i) out += rows.middleRows(i, height);
  return out / (size * size);
}

}  // namespace

std::vector<double> depthToPoints(const float* depth, int height, int width, const Vector4d& f) {
  std::vector<double> points;
  points.reserve(3 * std::size_t(height) * std::size_t(width));
  for (int row = 0; row < height; ++row) {
    for (int column = 0; column < width; ++column) {
      const double d = std::max(double(*depth++), 0.);
      points.insert(points.end(), {(column + .5 - f[2]) * d / f[0], (row + .5 - f[3]) * d / f[1], d});
    }
  }
  return points;
}

void DepthNoise::validate() const {
  for (const double value : {baseline, overall, wide, local, pixel, no_depth}) {
    if (!(value >= 0.) || !std::isfinite(value))
      throw ValueError(cat("depth noise: ", value, " is not a valid size; expected finite numbers >= 0"));
  }
}

Camera otherEye(const Camera& camera, const DepthNoise& noise) {
  Camera other = camera;
  other.pose.p += camera.pose.q * Vector3d(noise.baseline, 0., 0.);
  return other;
}

void addDepthNoise(std::vector<float>& depth, const std::vector<float>& other_eye, const Camera& camera,
                   const DepthNoise& noise, Rng& rng) {
  noise.validate();
  const Field field = noise.wide * smoothNoise(camera.height, camera.width, 10, rng) +
                      noise.local * smoothNoise(camera.height, camera.width, 3, rng) +
                      noise.pixel * smoothNoise(camera.height, camera.width, 1, rng);
  const auto filled = [&](float d) { return d < 0.f ? noise.no_depth : double(d); };
  for (int row = 0; row < camera.height; ++row) {
    for (int column = 0; column < camera.width; ++column) {
      const std::size_t line = std::size_t(row) * std::size_t(camera.width);
      float& pixel = depth[line + std::size_t(column)];
      const double d = filled(pixel);
      // in the right eye, a point at depth d appears this much further to the left
      const double scale = camera.ortho_height > 0. ? camera.height / camera.ortho_height : camera.fxycxy()[0] / d;
      const int seen_at = int(std::lround(column - scale * noise.baseline));
      const bool seen_twice = seen_at >= 0 && std::abs(filled(other_eye[line + std::size_t(seen_at)]) - d) <= kOccluded;
      pixel = seen_twice ? float(d + noise.overall * d * d * field(row, column)) : -1.f;
    }
  }
}

}  // namespace kinegraph
