#include "kinegraph/geometry/distance/cell_field.h"

#include <algorithm>
#include <cmath>

#include "kinegraph/geometry/distance/collision_body.h"
#include "kinegraph/geometry/shapes/cells.h"

namespace kinegraph::inline geometry_internal {

namespace {

constexpr int kFarthest = CellField::kReach * CellField::kReach;

/// The square of the distance along one axis between two cells whose indices differ by d.
constexpr std::int16_t gapSquared(int d) {
  const int gap = std::max(d - 1, 0);
  return std::int16_t(std::min(gap * gap, kFarthest));
}

/// Lengths of squares up to kFarthest.
const std::array<double, kFarthest + 1>& roots() {
  static const std::array<double, kFarthest + 1> table = [] {
    std::array<double, kFarthest + 1> roots{};
    for (int i = 0; i <= kFarthest; ++i) roots[std::size_t(i)] = std::sqrt(double(i));
    return roots;
  }();
  return table;
}

/// Distances along a row of cells.
void measureRow(const std::uint8_t* solid, int count, std::int16_t* squared) {
  int last = -2 * CellField::kReach;
  for (int k = 0; k < count; ++k) {
    if (solid[k]) last = k;
    squared[k] = gapSquared(k - last);
  }
  last = count + 2 * CellField::kReach;
  for (int k = count - 1; k >= 0; --k) {
    if (solid[k]) last = k;
    squared[k] = std::min(squared[k], gapSquared(last - k));
  }
}

/// to = min(to, from + add)
void lowerRow(std::int16_t* __restrict to, const std::int16_t* __restrict from, std::int16_t add, int count) {
  for (int k = 0; k < count; ++k) {
    const auto sum = std::int16_t(from[k] + add);
    to[k] = sum < to[k] ? sum : to[k];
  }
}

/// Combines `count` rows of equal lengths, of which row i begins at i * stride.
void combineRows(const std::int16_t* from, std::int16_t* to, int count, std::size_t stride, int length) {
  std::vector<std::int16_t> least(std::size_t(count), 0);
  for (int i = 0; i < count; ++i) {
    const std::int16_t* row = from + std::size_t(i) * stride;
    least[std::size_t(i)] = *std::min_element(row, row + length);
    std::copy_n(row, length, to + std::size_t(i) * stride);
  }
  for (int i = 0; i < count; ++i) {
    if (least[std::size_t(i)] >= kFarthest) continue;
    for (int d = 1; d <= CellField::kReach; ++d) {
      const std::int16_t add = gapSquared(d);
      if (least[std::size_t(i)] + add >= kFarthest) break;
      for (const int other : {i - d, i + d}) {
        if (other < 0 || other >= count) continue;
        lowerRow(to + std::size_t(other) * stride, from + std::size_t(i) * stride, add, length);
      }
    }
  }
}

}  // namespace

CellField::CellField(const Grid& grid, const Vector3d& size)
    : count(grid.cells), cell(size[0] / grid.cells[0]), half(.5 * size) {
  checkCells(grid, size);
  Level cells{count, std::vector<std::uint8_t>(grid.values.size())};
  for (std::size_t i = 0; i < grid.values.size(); ++i) cells.solid[i] = grid.values[i] != CellKind::free;
  levels.push_back(std::move(cells));
  computeDistances();
  buildLevels();
  cube = makeCollisionBody({ShapeType::box, {cell, cell, cell}, nullptr});
}

void CellField::computeDistances() {
  const auto [x, y, z] = count;
  const std::size_t rows = std::size_t(x) * std::size_t(y), row = std::size_t(z), slab = std::size_t(y) * row;
  std::vector<std::int16_t> other(rows * row);
  squared.resize(rows * row);
  for (std::size_t i = 0; i < rows; ++i) measureRow(levels[0].solid.data() + i * row, z, squared.data() + i * row);
  for (int i = 0; i < x; ++i)
    combineRows(squared.data() + std::size_t(i) * slab, other.data() + std::size_t(i) * slab, y, row, z);
  for (int j = 0; j < y; ++j)
    combineRows(other.data() + std::size_t(j) * row, squared.data() + std::size_t(j) * row, x, slab, z);
}

void CellField::buildLevels() {
  Vector3d low = half, high = -half;
  const Level& cells = levels[0];
  for (std::array<int, 3> at{}; at[0] < count[0]; ++at[0]) {
    for (at[1] = 0; at[1] < count[1]; ++at[1]) {
      const std::uint8_t* row = cells.solid.data() + index({at[0], at[1], 0});
      const std::uint8_t *end = row + count[2], *first = std::find(row, end, std::uint8_t(1));
      if (first == end) continue;
      const auto last = std::find(std::reverse_iterator(end), std::reverse_iterator(row), std::uint8_t(1));
      const Vector3d from(at[0], at[1], double(first - row)), to(at[0] + 1, at[1] + 1, double(last.base() - row));
      low = low.cwiseMin(cell * from - half);
      high = high.cwiseMax(cell * to - half);
    }
  }
  empty = high[0] < low[0];
  if (empty) low = high = Vector3d::Zero();
  Mesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.vertices.push_back({(i & 1 ? high : low)[0], (i & 2 ? high : low)[1], (i & 4 ? high : low)[2]});
  corners = makeCollisionBody({ShapeType::pointCloud, {}, std::make_shared<Mesh>(std::move(mesh))});
  while (std::max({levels.back().count[0], levels.back().count[1], levels.back().count[2]}) > 1) {
    const Level& fine = levels.back();
    Level coarse{};
    for (std::size_t axis = 0; axis < 3; ++axis) coarse.count[axis] = (fine.count[axis] + 1) / 2;
    const auto [x, y, z] = coarse.count;
    coarse.solid.assign(std::size_t(x) * std::size_t(y) * std::size_t(z), 0);
    const std::uint8_t* from = fine.solid.data();
    for (int i = 0; i < fine.count[0]; ++i) {
      for (int j = 0; j < fine.count[1]; ++j) {
        std::uint8_t* to =
            coarse.solid.data() + (std::size_t(i / 2) * std::size_t(y) + std::size_t(j / 2)) * std::size_t(z);
        for (int k = 0; k < fine.count[2]; ++k) to[k / 2] |= *from++;
      }
    }
    levels.push_back(std::move(coarse));
  }
}

std::array<int, 3> CellField::cellAt(const Vector3d& point) const {
  std::array<int, 3> at;
  for (int axis = 0; axis < 3; ++axis) {
    const double x = (point[axis] + half[axis]) / cell;
    at[std::size_t(axis)] = int(std::clamp(x, 0., count[std::size_t(axis)] - 1.));
  }
  return at;
}

double CellField::leastDistance(const Vector3d& point) const {
  const double within = cell * roots()[std::size_t(squared[index(cellAt(point))])];
  const double outside = (point.cwiseAbs() - half).cwiseMax(0.).squaredNorm();
  return outside == 0. ? within : std::sqrt(outside + within * within);
}

Vector3d CellField::wayOut(const Vector3d& point) const {
  const std::array<int, 3> center = cellAt(point);
  double best = std::numeric_limits<double>::infinity();
  Vector3d way = Vector3d::Zero();
  for (int shell = 1; shell <= kReach && (shell - 1) * cell < best; ++shell) {
    for (int x = -shell; x <= shell; ++x) {
      for (int y = -shell; y <= shell; ++y) {
        const bool side = std::abs(x) == shell || std::abs(y) == shell;
        for (int z = -shell; z <= shell; z += side ? 1 : 2 * shell) {
          const std::array<int, 3> at = {center[0] + x, center[1] + y, center[2] + z};
          const auto inside = [&](std::size_t axis) { return at[axis] >= 0 && at[axis] < count[axis]; };
          if (inside(0) && inside(1) && inside(2) && solid(at)) continue;
          const Vector3d low = cell * Vector3d(at[0], at[1], at[2]) - half;
          const Vector3d nearest = point.cwiseMax(low).cwiseMin((low.array() + cell).matrix());
          const double distance = (nearest - point).norm();
          if (distance < best) best = distance, way = nearest - point;
        }
      }
    }
  }
  return way;
}

}  // namespace kinegraph::inline geometry_internal
