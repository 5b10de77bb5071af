#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "kinegraph/geometry/shapes/geometry.h"

namespace kinegraph {
class CollisionBody;
}

namespace kinegraph::inline geometry_internal {

/// The solid cubes of a `cells` shape: a lower bound of the distance from them, computed once per cell, and a tree of
/// ever larger cubes. Local coordinates, m.
///
/// The distance of two cubes whose indices differ by (x, y, z) is that of the cell size times the norm of
/// max(|x| - 1, 0), .... Its least square over all solid cubes is a separable transform, computed along one axis after
/// the other. Source: Felzenszwalb & Huttenlocher, Distance transforms of sampled functions, 2012.
struct CellField {
  static constexpr int kReach = 20;  ///< cells: larger distances are given as this one

  CellField(const Grid& grid, const Vector3d& size);

  /// A lower bound of the distance of a point from the solid cells, at most kReach cells for points in the box. For
  /// these the distance is less than that plus the diagonal of a cell, if the bound is below kReach cells.
  double leastDistance(const Vector3d& point) const;

  bool solid(const std::array<int, 3>& at) const { return levels[0].solid[index(at)] != 0; }
  std::size_t index(const std::array<int, 3>& at) const {
    return (std::size_t(at[0]) * std::size_t(count[1]) + std::size_t(at[1])) * std::size_t(count[2]) +
           std::size_t(at[2]);
  }

  /// The cell of a point, clamped to the box.
  std::array<int, 3> cellAt(const Vector3d& point) const;

  /// From a point in a solid cell to the nearest point outside of solid cells; zero if it is farther than kReach cells.
  Vector3d wayOut(const Vector3d& point) const;

  /// Cubes of 2^level cells.
  struct Level {
    std::array<int, 3> count;
    std::vector<std::uint8_t> solid;  ///< whether a cell in the cube is solid
  };

  std::array<int, 3> count;  ///< cells per axis
  double cell;               ///< side of a cube, m
  Vector3d half;             ///< half sides of the box
  std::vector<Level> levels;
  std::vector<std::int16_t> squared;                   ///< per cell: the bound, in cells, squared
  std::shared_ptr<const CollisionBody> cube, corners;  ///< one cell; the corners of the box of the solid cells
  bool empty = false;                                  ///< no cell is solid

 private:
  void computeDistances();
  void buildLevels();
};

}  // namespace kinegraph::inline geometry_internal
