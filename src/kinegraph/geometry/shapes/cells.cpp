#include "kinegraph/geometry/shapes/cells.h"

#include <algorithm>
#include <cmath>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"

namespace kinegraph::inline geometry_internal {

namespace {

using Color = std::array<std::uint8_t, 4>;

constexpr Color kOccupiedColor = {235, 130, 45, 255}, kUnseenColor = {130, 135, 150, 110};

/// Collects the visible faces of cells, joined along one axis.
class CellFaces {
 public:
  CellFaces(const Grid& grid, const Vector3d& size) : grid_(grid), half_(.5 * size) {
    for (int axis = 0; axis < 3; ++axis) step_[axis] = size[axis] / grid.cells[std::size_t(axis)];
  }

  Mesh build() {
    for (int axis = 0; axis < 3; ++axis) {
      for (const int side : {-1, 1}) addFaces(axis, side);
    }
    return std::move(mesh_);
  }

 private:
  float at(const std::array<int, 3>& cell) const {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (cell[axis] < 0 || cell[axis] >= grid_.cells[axis]) return CellKind::free;
    }
    return grid_.at(cell[0], cell[1], cell[2]);
  }

  /// The kind of the cell if its face on that side is visible, else free.
  float faceOf(std::array<int, 3> cell, int axis, int side) const {
    const float kind = at(cell);
    if (kind == CellKind::free) return kind;
    cell[std::size_t(axis)] += side;
    return at(cell) == CellKind::free ? kind : CellKind::free;
  }

  void addFaces(int axis, int side) {
    const int along = axis == 2 ? 1 : 2, across = 3 - axis - along;
    std::array<int, 3> cell{};
    const auto count = [&](int a) { return grid_.cells[std::size_t(a)]; };
    for (cell[std::size_t(axis)] = 0; cell[std::size_t(axis)] < count(axis); ++cell[std::size_t(axis)]) {
      for (cell[std::size_t(across)] = 0; cell[std::size_t(across)] < count(across); ++cell[std::size_t(across)]) {
        int first = 0;
        float kind = CellKind::free;
        for (int n = 0; n <= count(along); ++n) {
          cell[std::size_t(along)] = n;
          const float next = n < count(along) ? faceOf(cell, axis, side) : CellKind::free;
          if (next == kind) continue;
          if (kind != CellKind::free) addFace(cell, axis, side, along, first, n, kind);
          first = n;
          kind = next;
        }
      }
    }
  }

  void addFace(const std::array<int, 3>& cell, int axis, int side, int along, int first, int last, float kind) {
    const int across = 3 - axis - along;
    Vector3d low;
    for (int a = 0; a < 3; ++a) low[a] = cell[std::size_t(a)] * step_[a] - half_[a];
    low[along] = first * step_[along] - half_[along];
    if (side > 0) low[axis] += step_[axis];
    Vector3d u = Vector3d::Zero(), v = Vector3d::Zero();
    u[along] = (last - first) * step_[along];
    v[across] = step_[across];
    const auto start = std::uint32_t(mesh_.vertices.size());
    for (const Vector3d& corner : {low, Vector3d(low + u), Vector3d(low + u + v), Vector3d(low + v)}) {
      mesh_.vertices.push_back(corner);
      mesh_.colors.push_back(kind == CellKind::unseen ? kUnseenColor : kOccupiedColor);
    }
    const bool outward = u.cross(v)[axis] * side > 0.;
    const std::uint32_t b = start + (outward ? 1 : 3), d = start + (outward ? 3 : 1);
    mesh_.triangles.push_back({start, b, start + 2});
    mesh_.triangles.push_back({start, start + 2, d});
  }

  const Grid& grid_;
  Vector3d half_, step_;
  Mesh mesh_;
};

}  // namespace

void checkCells(const Grid& grid, const Vector3d& size) {
  const auto [x, y, z] = grid.cells;
  if (x < 2 || y < 2 || z < 2 || grid.values.size() != std::size_t(x) * std::size_t(y) * std::size_t(z))
    throw ValueError(cat("cells need at least 2 x 2 x 2 values; got ", x, " x ", y, " x ", z, " with ",
                         grid.values.size(), " numbers"));
  const double cell = size[0] / x;
  if (!(cell > 0.) || std::abs(size[1] / y - cell) > 1e-4 * cell || std::abs(size[2] / z - cell) > 1e-4 * cell)
    throw ValueError(cat("cells of ", cell, " x ", size[1] / y, " x ", size[2] / z, " m; expected cubes"));
  const auto known = [](float v) { return v == CellKind::free || v == CellKind::occupied || v == CellKind::unseen; };
  const auto other = std::find_if_not(grid.values.begin(), grid.values.end(), known);
  if (other != grid.values.end())
    throw ValueError(cat("cells have the value ", *other, "; expected 0 (free), 1 (occupied) or 2 (unseen)"));
}

Mesh cellsSurface(const Grid& grid, const Vector3d& size) { return CellFaces(grid, size).build(); }

}  // namespace kinegraph::inline geometry_internal
