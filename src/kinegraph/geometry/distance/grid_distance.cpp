#include "kinegraph/geometry/distance/grid_distance.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "kinegraph/geometry/distance/cell_distance.h"
#include "kinegraph/geometry/distance/convex_distance.h"
#include "kinegraph/geometry/distance/grid_field.h"

namespace kinegraph::inline geometry_internal {

namespace {

using Core = CollisionBody::Core;

/// A point of the core, and the field's value and gradient there.
struct Sample {
  Vector3d point, gradient;  ///< in the frame of the core
  double value;
};

class MinimumOnCore {
 public:
  MinimumOnCore(const CollisionBody& core, const RigidTransform& X_GridCore, const GridField& field)
      : core_(core), X_(X_GridCore), field_(field), size_(core.boundHalf().norm()) {}

  Sample find() const {
    Sample best = at(core_.boundCenter());
    if (size_ == 0.) return best;
    // The extreme points of the core in 26 directions, and the midpoints toward them.
    constexpr int kStarts = 4;
    std::array<Sample, kStarts> starts;
    starts.fill(at(nearestInCore(core_, core_.boundCenter())));
    const auto consider = [&](const Sample& sample) {
      int worst = 0;
      for (int i = 1; i < kStarts; ++i) {
        if (starts[i].value > starts[worst].value) worst = i;
      }
      if (sample.value < starts[worst].value) starts[worst] = sample;
    };
    for (int i = 0; i < 27; ++i) {
      const Vector3d direction(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
      const Vector3d extreme = nearestInCore(core_, core_.boundCenter() + 2. * size_ * direction);
      consider(at(extreme));
      consider(at(nearestInCore(core_, .5 * (core_.boundCenter() + extreme))));
    }
    best = starts[0];
    for (const Sample& start : starts) {
      const Sample end = downhill(start);
      if (end.value < best.value) best = end;
    }
    return best;
  }

 private:
  Sample at(const Vector3d& point) const {
    Sample sample{point, {}, 0.};
    sample.value = field_.value(X_ * point, sample.gradient);
    sample.gradient = X_.R.transpose() * sample.gradient;
    return sample;
  }

  /// Projected gradient descent within the core; the step grows after success and shrinks after failure.
  Sample downhill(Sample sample) const {
    double step = .25 * size_;
    for (int iteration = 0; iteration < 120 && step > 1e-11 * size_; ++iteration) {
      const double steepness = sample.gradient.norm();
      if (steepness < 1e-12) break;
      const Sample next = at(nearestInCore(core_, sample.point - step / steepness * sample.gradient));
      if (next.value < sample.value) {
        sample = next;
        step *= 2.;
      } else {
        step *= .35;
      }
    }
    return sample;
  }

  const CollisionBody& core_;
  RigidTransform X_;
  const GridField& field_;
  double size_;
};

}  // namespace

Vector3d nearestInCore(const CollisionBody& body, const Vector3d& point) {
  switch (body.core()) {
    case Core::segment:
      return {0., 0., std::clamp(point.z(), -body.halfLength(), body.halfLength())};
    case Core::box:
      return point.cwiseMax(-body.halfSides()).cwiseMin(body.halfSides());
    case Core::cylinder: {
      const double across = std::hypot(point.x(), point.y());
      const double scale = across > body.coreRadius() ? body.coreRadius() / across : 1.;
      return {scale * point.x(), scale * point.y(), std::clamp(point.z(), -body.halfLength(), body.halfLength())};
    }
    case Core::point:
      return Vector3d::Zero();
    default: {
      const NearestPoints near = convexToConvex(*pointBody(), {Matrix3d::Identity(), point}, body, {});
      return near.distance > 0. ? near.point_b : point;
    }
  }
}

NearestPoints convexToGrid(const CollisionBody& core, const RigidTransform& X_WA, const CollisionBody& grid,
                           const RigidTransform& X_WB) {
  if (hasCells(grid)) return convexToCells(core, X_WA, grid, X_WB);
  const Sample least = MinimumOnCore(core, X_WB.inverse() * X_WA, grid.grid()).find();
  NearestPoints near;
  near.distance = least.value;
  near.point_a = X_WA * least.point;
  near.rate = least.gradient.norm();
  if (near.rate > 1e-12) {
    near.normal = X_WA.R * (least.gradient / near.rate);
  } else {
    near.rate = 0.;
  }
  near.point_b = near.point_a - near.distance * near.normal;
  return near;
}

}  // namespace kinegraph::inline geometry_internal
