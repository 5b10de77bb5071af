#include "kinegraph/geometry/distance/cell_distance.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "kinegraph/geometry/distance/cell_field.h"
#include "kinegraph/geometry/distance/closed_form/box_box_distance.h"
#include "kinegraph/geometry/distance/closed_form/box_distance.h"
#include "kinegraph/geometry/distance/convex_distance.h"
#include "kinegraph/geometry/distance/grid_distance.h"
#include "kinegraph/geometry/distance/grid_field.h"
#include "kinegraph/geometry/distance/proximity.h"

namespace kinegraph::inline geometry_internal {

namespace {

using Core = CollisionBody::Core;

const double kDiagonal = std::sqrt(3.);

/// Finds the solid cell nearest to a core, by branch and bound in the tree of cubes. In the frame of the cells.
class NearestCell {
 public:
  NearestCell(const CollisionBody& core, const RigidTransform& X, const CellField& field, double most)
      : core_(core), X_(X), field_(field) {
    best_.distance = most;
  }

  /// False if no cell is closer than `most`.
  bool find() {
    if (field_.empty) return false;
    boundByCenter();
    const int top = int(field_.levels.size()) - 1;
    visit(top, {0, 0, 0}, bound(top, {0, 0, 0}));
    return found_;
  }

  const NearestPoints& best() const { return best_; }

 private:
  double sizeOf(int level) const { return field_.cell * double(1 << level); }

  Vector3d middle(int level, const std::array<int, 3>& at) const {
    return sizeOf(level) * Vector3d(at[0] + .5, at[1] + .5, at[2] + .5) - field_.half;
  }

  /// Lowers the largest distance of interest to that of the middle of the core.
  void boundByCenter() {
    if (core_.core() > Core::cylinder && core_.innerRadius() == 0.) return;  // it may be outside
    const Vector3d center = X_ * core_.boundCenter();
    const double least = field_.leastDistance(center);
    if ((center.cwiseAbs() - field_.half).maxCoeff() > 0. || least >= CellField::kReach * field_.cell) return;
    best_.distance = std::min(best_.distance, least + 1.001 * kDiagonal * field_.cell);
  }

  double bound(int level, const std::array<int, 3>& at) const {
    return std::sqrt(squaredPointToCore(core_, X_, middle(level, at))) - .5 * kDiagonal * sizeOf(level);
  }

  void visit(int level, const std::array<int, 3>& at, double low) {
    if (low >= best_.distance || (found_ && best_.distance <= 0.)) return;
    if (level == 0) return measure(at);
    const CellField::Level& fine = field_.levels[std::size_t(level - 1)];
    struct Child {
      double low;
      std::array<int, 3> at;
    };
    std::array<Child, 8> children;
    int count = 0;
    for (int i = 0; i < 8; ++i) {
      const std::array<int, 3> child = {2 * at[0] + (i & 1), 2 * at[1] + (i >> 1 & 1), 2 * at[2] + (i >> 2)};
      if (child[0] >= fine.count[0] || child[1] >= fine.count[1] || child[2] >= fine.count[2]) continue;
      const std::size_t index =
          (std::size_t(child[0]) * std::size_t(fine.count[1]) + std::size_t(child[1])) * std::size_t(fine.count[2]) +
          std::size_t(child[2]);
      if (!fine.solid[index]) continue;
      const Child next{bound(level - 1, child), child};
      if (next.low >= best_.distance) continue;
      int place = count++;
      for (; place > 0 && children[std::size_t(place - 1)].low > next.low; --place)
        children[std::size_t(place)] = children[std::size_t(place - 1)];
      children[std::size_t(place)] = next;
    }
    for (int i = 0; i < count; ++i) visit(level - 1, children[std::size_t(i)].at, children[std::size_t(i)].low);
  }

  void measure(const std::array<int, 3>& at) {
    const BoxCore box{{Matrix3d::Identity(), middle(0, at)}, field_.cube->halfSides()};
    NearestPoints near;
    switch (core_.core()) {
      case Core::point:
        near = pointToBox(X_.p, box);
        break;
      case Core::segment:
        near = segmentToBox({X_.p, X_.R.col(2), core_.halfLength()}, box);
        break;
      case Core::box:
        near = boxToBox({X_, core_.halfSides()}, box);
        break;
      default:
        near = convexToConvex(core_, X_, *field_.cube, box.X_WB);
    }
    if (near.distance >= best_.distance) return;
    best_ = near;
    found_ = true;
  }

  const CollisionBody& core_;
  const RigidTransform X_;
  const CellField& field_;
  NearestPoints best_;
  bool found_ = false;
};

/// Replaces an overlap by the deepest of the extreme points of the core and their midpoints, if that is deeper.
void deepen(const CollisionBody& core, const RigidTransform& X, const CellField& field, NearestPoints& near) {
  const double size = 2. * core.boundHalf().norm();
  const RigidTransform to_core = X.inverse();
  const auto consider = [&](const Vector3d& local) {
    const Vector3d point = X * local;
    if ((point.cwiseAbs() - field.half).maxCoeff() > 0. || !field.solid(field.cellAt(point))) return;
    const Vector3d way = field.wayOut(point);
    const double depth = way.norm();
    if (depth <= -near.distance) return;
    near = {-depth, way / depth, point, point + way};
  };
  consider(nearestInCore(core, to_core * near.point_a));
  consider(nearestInCore(core, core.boundCenter()));
  for (int i = 0; size > 0. && i < 27; ++i) {
    const Vector3d direction(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
    const Vector3d extreme = nearestInCore(core, core.boundCenter() + size * direction);
    consider(extreme);
    consider(nearestInCore(core, .5 * (core.boundCenter() + extreme)));
  }
}

/// Tries to prove from the field alone that a core is at least a distance away from the solid cells.
class FieldTest {
 public:
  FieldTest(const CellField& field, const RigidTransform& X, double distance)
      : field_(field), X_(X), distance_(distance) {}

  /// For a box around the core, or a part of it: false if there is no proof.
  bool ask(const Vector3d& center, const Vector3d& half) const {
    const double radius = half.norm(), least = field_.leastDistance(X_ * center);
    if (least - radius >= distance_) return true;
    if (radius < .3 * field_.cell || least < distance_ - kDiagonal * field_.cell) return false;
    int longest;
    half.maxCoeff(&longest);
    Vector3d part = half, shift = Vector3d::Zero();
    part[longest] = shift[longest] = .5 * half[longest];
    return ask(center - shift, part) && ask(center + shift, part);
  }

 private:
  const CellField& field_;
  const RigidTransform& X_;
  double distance_;
};

}  // namespace

bool hasCells(const CollisionBody& body) { return body.core() == Core::grid && body.grid().cells; }

NearestPoints convexToCells(const CollisionBody& core, const RigidTransform& X_WA, const CollisionBody& cells,
                            const RigidTransform& X_WB, double most) {
  const CellField& field = *cells.grid().cells;
  const RigidTransform X = X_WB.inverse() * X_WA;
  NearestCell search(core, X, field, most);
  NearestPoints near{most, Vector3d::UnitZ(), X * core.boundCenter(), Vector3d::Zero()};
  near.point_b = near.point_a - most * near.normal;
  if (search.find()) near = search.best();
  if (near.distance <= 0.) deepen(core, X, field, near);
  return {near.distance, X_WB.R * near.normal, X_WB * near.point_a, X_WB * near.point_b, near.rate};
}

double distanceToCells(const CollisionBody& convex, const RigidTransform& X_WA, const CollisionBody& cells,
                       const RigidTransform& X_WB, double most) {
  const CellField& field = *cells.grid().cells;
  const RigidTransform X = X_WB.inverse() * X_WA;
  const double needed = most + convex.radius();
  if (FieldTest(field, X, needed).ask(convex.boundCenter(), convex.boundHalf())) return most;
  NearestCell search(convex, X, field, needed);
  if (!search.find()) return most;
  NearestPoints near = search.best();
  if (near.distance <= 0.) deepen(convex, X, field, near);
  return near.distance - convex.radius();
}

}  // namespace kinegraph::inline geometry_internal
