#include "kinegraph/viewer/draw_quad.h"

#include <algorithm>
#include <cmath>

namespace kinegraph::inline viewer_internal {

void drawQuad(std::vector<std::uint8_t>& rgb, int width, const Quad& quad) {
  const int height = int(rgb.size() / 3) / width;
  const double pixel = quad.height * height / quad.rows;  // pixels of the picture per pixel of the quad
  const double left = quad.x * height, top = quad.y * height;
  const auto from = [](double edge, int limit) { return int(std::clamp(std::ceil(edge - .5), 0., double(limit))); };
  const int first_row = from(top, height), last_row = from(top + pixel * quad.rows, height);
  const int first_column = from(left, width), last_column = from(left + pixel * quad.columns, width);
  for (int row = first_row; row < last_row; ++row) {
    const int quad_row = std::min(int((row + .5 - top) / pixel), quad.rows - 1);
    for (int column = first_column; column < last_column; ++column) {
      const int quad_column = std::min(int((column + .5 - left) / pixel), quad.columns - 1);
      const std::size_t source = 3 * (std::size_t(quad_row) * std::size_t(quad.columns) + std::size_t(quad_column));
      std::copy_n(&quad.rgb[source], 3, &rgb[3 * (std::size_t(row) * std::size_t(width) + std::size_t(column))]);
    }
  }
}

}  // namespace kinegraph::inline viewer_internal
