#include "kinegraph/geometry/shapes/isosurface.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"

namespace kinegraph::inline geometry_internal {

namespace {

using Corner = std::array<int, 3>;

/// A cube cut into six tetrahedra around its diagonal; the cuts of neighboring cubes match.
constexpr int kTetrahedra[6][4] = {{0, 1, 3, 7}, {0, 3, 2, 7}, {0, 2, 6, 7}, {0, 6, 4, 7}, {0, 4, 5, 7}, {0, 5, 1, 7}};

class Surface {
 public:
  Surface(const Grid& grid, const Vector3d& size) : grid_(grid) {
    for (int k = 0; k < 3; ++k) step_[k] = size[k] / (grid.cells[k] - 1);
    origin_ = -.5 * size;
  }

  Mesh build() {
    for (int i = 0; i + 1 < grid_.cells[0]; ++i) {
      for (int j = 0; j + 1 < grid_.cells[1]; ++j) {
        for (int k = 0; k + 1 < grid_.cells[2]; ++k) addCube(i, j, k);
      }
    }
    return std::move(mesh_);
  }

 private:
  double value(const Corner& c) const { return grid_.at(c[0], c[1], c[2]); }
  Vector3d point(const Corner& c) const { return origin_ + step_.cwiseProduct(Vector3d(c[0], c[1], c[2])); }

  void addCube(int i, int j, int k) {
    Corner corners[8];
    int inside = 0;
    for (int n = 0; n < 8; ++n) {
      corners[n] = {i + (n & 1), j + (n >> 1 & 1), k + (n >> 2)};
      inside += value(corners[n]) < 0.;
    }
    if (inside == 0 || inside == 8) return;
    for (const auto& t : kTetrahedra) addTetrahedron({corners[t[0]], corners[t[1]], corners[t[2]], corners[t[3]]});
  }

  void addTetrahedron(const std::array<Corner, 4>& corners) {
    std::vector<Corner> low, high;
    for (const Corner& c : corners) (value(c) < 0. ? low : high).push_back(c);
    if (low.empty() || high.empty()) return;
    Vector3d up = Vector3d::Zero();  // from the negative corners to the others
    for (const Corner& c : high) up += point(c) / double(high.size());
    for (const Corner& c : low) up -= point(c) / double(low.size());
    std::vector<std::uint32_t> loop;
    if (low.size() == 2) {
      loop = {crossing(low[0], high[0]), crossing(low[0], high[1]), crossing(low[1], high[1]),
              crossing(low[1], high[0])};
    } else {
      for (const Corner& a : low) {
        for (const Corner& b : high) loop.push_back(crossing(a, b));
      }
    }
    for (std::size_t n = 1; n + 1 < loop.size(); ++n) addTriangle(loop[0], loop[n], loop[n + 1], up);
  }

  void addTriangle(std::uint32_t a, std::uint32_t b, std::uint32_t c, const Vector3d& up) {
    if (a == b || b == c || c == a) return;
    const auto& p = mesh_.vertices;
    if ((p[b] - p[a]).cross(p[c] - p[a]).dot(up) < 0.) std::swap(b, c);
    mesh_.triangles.push_back({a, b, c});
  }

  /// The vertex on an edge of the grid, shared by all tetrahedra at the edge.
  std::uint32_t crossing(const Corner& low, const Corner& high) {
    const auto number = [&](const Corner& c) {
      return (std::uint64_t(c[0]) * grid_.cells[1] + c[1]) * grid_.cells[2] + c[2];
    };
    const std::uint64_t a = number(low), b = number(high);
    const auto [entry, is_new] =
        known_.try_emplace(std::min(a, b) * 8 + neighbor(low, high), std::uint32_t(mesh_.vertices.size()));
    if (is_new) {
      const double at = value(low) / (value(low) - value(high));
      mesh_.vertices.push_back(point(low) + at * (point(high) - point(low)));
    }
    return entry->second;
  }

  /// Index of the direction of an edge, out of seven.
  static int neighbor(const Corner& a, const Corner& b) {
    return (a[0] != b[0]) + 2 * (a[1] != b[1]) + 4 * (a[2] != b[2]);
  }

  const Grid& grid_;
  Vector3d step_, origin_;
  Mesh mesh_;
  std::unordered_map<std::uint64_t, std::uint32_t> known_;
};

/// One pass along an axis: each value becomes the mean of itself and its neighbors.
void blurAlong(Grid& grid, int axis) {
  const std::size_t strides[] = {std::size_t(grid.cells[1]) * grid.cells[2], std::size_t(grid.cells[2]), 1};
  const std::size_t stride = strides[axis], count = grid.cells[axis];
  std::vector<float> line(count);
  for (std::size_t first = 0; first < grid.values.size(); ++first) {
    if (first / stride % count != 0) continue;
    for (std::size_t n = 0; n < count; ++n) line[n] = grid.values[first + n * stride];
    for (std::size_t n = 0; n < count; ++n) {
      const std::size_t from = n == 0 ? 0 : n - 1, to = std::min(n + 1, count - 1);
      float sum = 0.f;
      for (std::size_t k = from; k <= to; ++k) sum += line[k];
      grid.values[first + n * stride] = sum / float(to - from + 1);
    }
  }
}

}  // namespace

void checkGrid(const Grid& grid) {
  const auto [x, y, z] = grid.cells;
  if (x < 2 || y < 2 || z < 2 || grid.values.size() != std::size_t(x) * y * z) {
    throw ValueError(cat("a grid has at least 2 x 2 x 2 values; got ", x, " x ", y, " x ", z, " with ",
                         grid.values.size(), " numbers"));
  }
  if (!std::all_of(grid.values.begin(), grid.values.end(), [](float v) { return std::isfinite(v); })) {
    throw ValueError("a grid has values that are not finite");
  }
}

Mesh isosurface(const Grid& grid, const Vector3d& size) {
  checkGrid(grid);
  return Surface(grid, size).build();
}

Grid blurred(Grid grid, int times) {
  checkGrid(grid);
  for (int n = 0; n < times; ++n) {
    for (int axis = 0; axis < 3; ++axis) blurAlong(grid, axis);
  }
  return grid;
}

Grid resampled(const Grid& grid, const std::array<int, 3>& cells) {
  checkGrid(grid);
  Grid out;
  out.cells = cells;
  out.values.reserve(std::size_t(cells[0]) * cells[1] * cells[2]);
  const auto locate = [&](int n, int axis) {
    const double at = double(n) * (grid.cells[axis] - 1) / (cells[axis] - 1);
    const int cell = std::min(int(at), grid.cells[axis] - 2);
    return std::pair(cell, at - cell);
  };
  for (int i = 0; i < cells[0]; ++i) {
    for (int j = 0; j < cells[1]; ++j) {
      for (int k = 0; k < cells[2]; ++k) {
        const auto [x, u] = locate(i, 0);
        const auto [y, v] = locate(j, 1);
        const auto [z, w] = locate(k, 2);
        double sum = 0.;
        for (int n = 0; n < 8; ++n) {
          const int a = n & 1, b = n >> 1 & 1, c = n >> 2;
          sum += (a ? u : 1. - u) * (b ? v : 1. - v) * (c ? w : 1. - w) * grid.at(x + a, y + b, z + c);
        }
        out.values.push_back(float(sum));
      }
    }
  }
  checkGrid(out);
  return out;
}

}  // namespace kinegraph::inline geometry_internal
