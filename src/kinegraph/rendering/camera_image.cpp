#include "kinegraph/rendering/camera_renderer.h"

#include <algorithm>
#include <cstddef>

namespace kinegraph {

CameraImage shrunk(const CameraImage& fine, int factor) {
  CameraImage image{fine.width / factor, fine.height / factor, {}, {}};
  const std::size_t row_length = std::size_t(fine.width), count = std::size_t(image.width) * std::size_t(image.height);
  image.depth.resize(count);
  image.rgb.resize(3 * count);
  std::vector<int> sums(3 * std::size_t(image.width));
  const int cell = factor * factor;
  for (int row = 0; row < image.height; ++row) {
    std::fill(sums.begin(), sums.end(), cell / 2);
    for (int i = 0; i < factor; ++i) {
      const std::uint8_t* rgb = &fine.rgb[3 * row_length * std::size_t(row * factor + i)];
      for (int column = 0; column < image.width; ++column) {
        int* sum = &sums[3 * std::size_t(column)];
        for (int k = 0; k < factor; ++k, rgb += 3) {
          sum[0] += rgb[0];
          sum[1] += rgb[1];
          sum[2] += rgb[2];
        }
      }
    }
    const std::size_t start = std::size_t(row) * std::size_t(image.width);
    for (std::size_t i = 0; i < sums.size(); ++i) image.rgb[3 * start + i] = std::uint8_t(sums[i] / cell);
    const float* depth = &fine.depth[row_length * std::size_t(row * factor + factor / 2) + std::size_t(factor / 2)];
    for (int column = 0; column < image.width; ++column)
      image.depth[start + std::size_t(column)] = depth[column * factor];
  }
  return image;
}

}  // namespace kinegraph
