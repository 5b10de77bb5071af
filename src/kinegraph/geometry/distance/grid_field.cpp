#include "kinegraph/geometry/distance/grid_field.h"

#include <algorithm>
#include <cmath>

#include "kinegraph/geometry/distance/cell_field.h"
#include "kinegraph/geometry/distance/collision_body.h"
#include "kinegraph/geometry/shapes/isosurface.h"

namespace kinegraph::inline geometry_internal {

namespace {

/// Weights of four neighbors for the value and the slope at t in [0, 1]; the cell lies between the middle two.
struct Weights {
  double value[4], slope[4];
  int first;  ///< index of the first weighted neighbor; values are extrapolated linearly beyond the grid

  Weights(double at, int count) {
    const int cell = std::clamp(int(at), 0, count - 2);
    const double t = at - cell;
    const double v[4] = {t * (-.5 + t * (1. - .5 * t)), 1. + t * t * (-2.5 + 1.5 * t), t * (.5 + t * (2. - 1.5 * t)),
                         t * t * (-.5 + .5 * t)};
    const double s[4] = {-.5 + t * (2. - 1.5 * t), t * (-5. + 4.5 * t), .5 + t * (4. - 4.5 * t), t * (-1. + 1.5 * t)};
    first = std::clamp(cell - 1, 0, std::max(count - 4, 0));
    for (double& x : value) x = 0.;
    for (double& x : slope) x = 0.;
    for (int i = 0; i < 4; ++i) {
      const auto add = [&](int index, double factor) {
        value[index - first] += factor * v[i];
        slope[index - first] += factor * s[i];
      };
      const int index = cell - 1 + i;
      if (index < 0) {
        add(0, 2.);
        add(1, -1.);
      } else if (index >= count) {
        add(count - 1, 2.);
        add(count - 2, -1.);
      } else {
        add(index, 1.);
      }
    }
  }
};

/// The least value on the sides of the box.
double minimumOnSides(const Grid& grid) {
  double least = 0.;
  const auto [x, y, z] = grid.cells;
  for (int i = 0; i < x; ++i) {
    for (int j = 0; j < y; ++j) {
      for (int k = 0; k < z; ++k) {
        if (i == 0 || j == 0 || k == 0 || i == x - 1 || j == y - 1 || k == z - 1)
          least = std::min(least, double(grid.at(i, j, k)));
      }
    }
  }
  return least;
}

}  // namespace

GridField::GridField(std::shared_ptr<const Grid> given, const Vector3d& size)
    : grid(std::move(given)), half(.5 * size) {
  checkGrid(*grid);
  for (int axis = 0; axis < 3; ++axis) step[axis] = std::max(size[axis], 1e-9) / (grid->cells[axis] - 1);
  overhang = -minimumOnSides(*grid);
  Mesh mesh = isosurface(*grid, size);
  mesh.triangles.clear();
  if (mesh.vertices.empty()) {
    for (int i = 0; i < 8; ++i) {
      mesh.vertices.push_back(half.cwiseProduct(Vector3d(i & 1 ? 1. : -1., i & 2 ? 1. : -1., i & 4 ? 1. : -1.)));
    }
  }
  surface = makeCollisionBody({ShapeType::pointCloud, {}, std::make_shared<Mesh>(std::move(mesh))});
}

GridField::GridField(std::unique_ptr<const CellField> field)
    : cells(std::move(field)), half(cells->half), step(Vector3d::Constant(cells->cell)), surface(cells->corners) {}

GridField::~GridField() = default;

double GridField::value(const Vector3d& point, Vector3d& gradient) const {
  const Vector3d inside = point.cwiseMax(-half).cwiseMin(half);
  const Vector3d at = (inside + half).cwiseQuotient(step);
  const Weights x(at.x(), grid->cells[0]), y(at.y(), grid->cells[1]), z(at.z(), grid->cells[2]);
  const int ends[3] = {std::min(4, grid->cells[0]), std::min(4, grid->cells[1]), std::min(4, grid->cells[2])};
  double value = 0.;
  gradient.setZero();
  for (int i = 0; i < ends[0]; ++i) {
    double plane = 0., along_y = 0., along_z = 0.;
    for (int j = 0; j < ends[1]; ++j) {
      double line = 0., slope = 0.;
      for (int k = 0; k < ends[2]; ++k) {
        const double v = grid->at(x.first + i, y.first + j, z.first + k);
        line += z.value[k] * v;
        slope += z.slope[k] * v;
      }
      plane += y.value[j] * line;
      along_y += y.slope[j] * line;
      along_z += y.value[j] * slope;
    }
    value += x.value[i] * plane;
    gradient += Vector3d(x.slope[i] * plane, x.value[i] * along_y, x.value[i] * along_z);
  }
  gradient = gradient.cwiseQuotient(step);
  const Vector3d beyond = point - inside;
  const double r = beyond.norm();
  if (r == 0.) return value;
  for (int axis = 0; axis < 3; ++axis) {
    if (beyond[axis] != 0.) gradient[axis] = 0.;
  }
  if (value <= 0.) {
    gradient += beyond / r;
    return value + r;
  }
  const double distance = std::hypot(value, r);
  gradient = (value * gradient + beyond) / distance;
  return distance;
}

}  // namespace kinegraph::inline geometry_internal
