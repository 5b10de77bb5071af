#include "kinegraph/collision/cell_separation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "kinegraph/geometry/distance/cell_field.h"
#include "kinegraph/geometry/distance/closed_form/box_box_distance.h"
#include "kinegraph/geometry/distance/closed_form/box_distance.h"
#include "kinegraph/geometry/distance/convex_distance.h"
#include "kinegraph/geometry/distance/grid_field.h"
#include "kinegraph/geometry/distance/proximity.h"
#include "kinegraph/geometry/distance/separation.h"

namespace kinegraph::inline collision_internal {

namespace {

using Core = CollisionBody::Core;

constexpr int kDirections = 6;  // kept
const double kHalfDiagonal = .5 * std::sqrt(3.);

NearestPoints coreToBox(const CollisionBody& core, const RigidTransform& X, const BoxCore& box,
                        const CollisionBody& cube) {
  switch (core.core()) {
    case Core::point:
      return pointToBox(X.p, box);
    case Core::segment:
      return segmentToBox({X.p, X.R.col(2), core.halfLength()}, box);
    case Core::box:
      return boxToBox({X, core.halfSides()}, box);
    default:
      return convexToConvex(core, X, cube, box.X_WB);
  }
}

class CellSeparation {
 public:
  CellSeparation(const MotionAmongCells& motion, double margin)
      : motion_(motion),
        core_(motion.convex),
        field_(*motion.cells.grid().cells),
        moves_(motion.travel > 0.),
        margin_(margin + motion.convex.radius()) {
    const double reach = margin_ + .5 * motion.travel;
    Vector3d low, high;
    extent(motion.begin, low, high);
    if (moves_) {
      Vector3d other_low, other_high;
      extent(motion.end, other_low, other_high);
      low = low.cwiseMin(other_low);
      high = high.cwiseMax(other_high);
    }
    const double size = field_.cell;
    for (int axis = 0; axis < 3; ++axis) {
      const double from = (low[axis] - reach + field_.half[axis]) / size,
                   to = (high[axis] + reach + field_.half[axis]) / size, most = field_.count[std::size_t(axis)];
      if (to < 0. || from > most) outside_ = true;
      first_[std::size_t(axis)] = int(std::clamp(from, 0., most - 1.));
      last_[std::size_t(axis)] = int(std::clamp(to, 0., most - 1.));
    }
  }

  CellVerdict run() {
    if (field_.empty || outside_) return {};
    int top = 0;  // the finest level with at most two cubes per axis in reach
    while (widest(top) > 1) ++top;
    for (int i = first_[0] >> top; i <= last_[0] >> top; ++i) {
      for (int j = first_[1] >> top; j <= last_[1] >> top; ++j) {
        for (int k = first_[2] >> top; k <= last_[2] >> top; ++k) {
          if (isExcluded(top, {i, j, k})) continue;
          if (!visit(top, {i, j, k})) return verdict_;
        }
      }
    }
    return {};
  }

 private:
  /// The heights of the lowest points of the core along a direction, both ends considered.
  struct Direction {
    Vector3d n;
    double low, spread;  ///< spread: half the height of a unit cube
  };

  int widest(int level) const {
    int most = 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
      most = std::max(most, (last_[axis] >> level) - (first_[axis] >> level));
    return most;
  }

  void extent(const RigidTransform& X, Vector3d& low, Vector3d& high) const {
    const Vector3d center = X * core_.boundCenter(), half = X.R.cwiseAbs() * core_.boundHalf();
    low = center - half;
    high = center + half;
  }

  double sizeOf(int level) const { return field_.cell * double(1 << level); }

  Vector3d middle(int level, const std::array<int, 3>& at) const {
    return sizeOf(level) * Vector3d(at[0] + .5, at[1] + .5, at[2] + .5) - field_.half;
  }

  /// Whether a cube has no solid cells, or none that come too close.
  bool isExcluded(int level, const std::array<int, 3>& at) {
    const CellField::Level& cubes = field_.levels[std::size_t(level)];
    if (!cubes.solid[(std::size_t(at[0]) * std::size_t(cubes.count[1]) + std::size_t(at[1])) *
                         std::size_t(cubes.count[2]) +
                     std::size_t(at[2])])
      return true;
    const double size = sizeOf(level);
    const Vector3d center = middle(level, at);
    for (int i = 0; i < count_; ++i) {
      const Direction& direction = directions_[std::size_t(i)];
      if (direction.low < direction.n.dot(center) + size * direction.spread) continue;
      if (i > 0) std::swap(directions_[std::size_t(i)], directions_[0]);
      return true;
    }
    const double needed = margin_ + size * kHalfDiagonal;
    const double begin = squaredPointToCore(core_, motion_.begin, center);
    if (!moves_) return begin >= needed * needed;
    const double far = needed + motion_.travel;
    if (begin >= far * far) return true;
    const double rest = 2. * needed + motion_.travel - std::sqrt(begin);
    return rest <= 0. || squaredPointToCore(core_, motion_.end, center) >= rest * rest;
  }

  /// False ends the search, with a verdict.
  bool visit(int level, const std::array<int, 3>& at) {
    if (level == 0) return measure(at);
    std::array<int, 3> from, to;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      from[axis] = std::max(2 * at[axis], first_[axis] >> (level - 1));
      to[axis] = std::min(2 * at[axis] + 1, last_[axis] >> (level - 1));
    }
    for (int i = from[0]; i <= to[0]; ++i) {
      for (int j = from[1]; j <= to[1]; ++j) {
        for (int k = from[2]; k <= to[2]; ++k) {
          if (!isExcluded(level - 1, {i, j, k}) && !visit(level - 1, {i, j, k})) return false;
        }
      }
    }
    return true;
  }

  bool end(CellVerdict::Kind kind, double distance) {
    verdict_ = {kind, distance - core_.radius()};
    return false;
  }

  bool measure(const std::array<int, 3>& at) {
    const BoxCore box{{Matrix3d::Identity(), middle(0, at)}, field_.cube->halfSides()};
    double sum = 0., least = 0.;
    for (const bool second : {false, true}) {
      const NearestPoints near = coreToBox(core_, second ? motion_.end : motion_.begin, box, *field_.cube);
      if (near.distance < margin_) return end(second ? CellVerdict::near_end : CellVerdict::near_begin, near.distance);
      if (!moves_) {
        add(near.normal);
        return true;
      }
      sum += near.distance;
      least = second ? std::min(least, near.distance) : near.distance;
      if (std::isfinite(motion_.bow) && separates(add(near.normal), box.X_WB.p)) return true;
    }
    return sum - motion_.travel >= 2. * margin_ || end(CellVerdict::unknown, least);
  }

  bool separates(const Direction& direction, const Vector3d& center) const {
    return direction.low >= direction.n.dot(center) + field_.cell * direction.spread;
  }

  /// The oldest direction is replaced.
  const Direction& add(const Vector3d& n) {
    const int at = count_ < kDirections ? count_++ : 1 + next_++ % (kDirections - 1);
    double low = lowest(motion_.begin, n);
    if (moves_) low = std::min(low, lowest(motion_.end, n));
    return directions_[std::size_t(at)] = {n, low - margin_ - motion_.bow, .5 * n.cwiseAbs().sum()};
  }

  double lowest(const RigidTransform& X, const Vector3d& n) {
    const Vector3d down = -(X.R.transpose() * n);
    return n.dot(X.p) - down.dot(supportNear(core_, down, corner_));
  }

  const MotionAmongCells& motion_;
  const CollisionBody& core_;
  const CellField& field_;
  bool moves_;
  double margin_;  ///< of the core
  bool outside_ = false;
  std::array<int, 3> first_, last_;  ///< cells in reach
  std::array<Direction, kDirections> directions_;
  int count_ = 0, next_ = 0;
  std::uint32_t corner_ = 0;
  CellVerdict verdict_;
};

}  // namespace

CellVerdict separateFromCells(const MotionAmongCells& motion, double margin) {
  return CellSeparation(motion, margin).run();
}

}  // namespace kinegraph::inline collision_internal
