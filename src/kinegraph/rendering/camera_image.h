#pragma once

#include <cstdint>
#include <vector>

namespace kinegraph {

/// An image of a camera. Rows run from top to bottom.
struct CameraImage {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;  ///< height x width x 3
  std::vector<float> depth;       ///< height x width, m along the camera's z; -1 for the background
};

/// Averages the colors of factor x factor pixels; the depth is that of their middle pixel.
CameraImage shrunk(const CameraImage& fine, int factor);

/// Reverses the order of the rows: those of OpenGL run from bottom to top.
void flipRows(CameraImage& image);

}  // namespace kinegraph
