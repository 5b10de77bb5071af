#include "kinegraph/geometry/distance/convex_distance.h"

#include "kinegraph/geometry/distance/contact_patch.h"
#include "kinegraph/geometry/distance/core_pair.h"
#include "kinegraph/geometry/distance/separation.h"

namespace kinegraph::inline geometry_internal {

namespace {

struct Search {
  Simplex simplex;
  Vector3d v;  ///< the point of the difference nearest to the origin
  bool overlap = false;
  SupportCorners corners;  ///< found last; warm start of the next search
};

MinkowskiPoint supportNear(const CorePair& pair, const Vector3d& m, SupportCorners& corners) {
  const Vector3d p = supportNear(pair.a, m, corners.a),
                 q = supportNear(pair.b, -(pair.X_AB.R.transpose() * m), corners.b);
  return {p, q, pair.difference(p, q)};
}

/// Iterates until the squared distance has the relative accuracy `relative`, or does not improve.
void descend(const CorePair& pair, double relative, Search& search) {
  const double scale = pair.scale(), touching = 1e-8 * scale;
  for (int iteration = 0; iteration < 200; ++iteration) {
    const MinkowskiPoint point = supportNear(pair, -search.v, search.corners);
    const double square = search.v.squaredNorm();
    if (search.simplex.size > 0) {
      const double gain = square - search.v.dot(point.w);
      if (gain <= relative * square + 4e-16 * std::sqrt(square) * scale) return;
    }
    const Simplex before = search.simplex;
    search.simplex.add(point);
    const Vector3d v = search.simplex.reduce(search.overlap);
    if (search.overlap) return;
    if (before.size > 0 && v.squaredNorm() >= square) {
      search.simplex = before;
      return;
    }
    search.v = v;
    if (v.norm() <= touching) {
      search.overlap = true;
      return;
    }
  }
}

}  // namespace

NearestPoints convexToConvex(const CollisionBody& a, const RigidTransform& X_WA, const CollisionBody& b,
                             const RigidTransform& X_WB) {
  const Matrix3d R_AW = X_WA.R.transpose();
  const CorePair pair{a, b, {R_AW * X_WB.R, R_AW * (X_WB.p - X_WA.p)}};
  Search search;
  search.v = pair.difference(a.boundCenter(), b.boundCenter());
  if (search.v.squaredNorm() == 0.) search.v = Vector3d::UnitX();
  const bool curved = pair.curved();
  descend(pair, curved ? 1e-6 : 1e-13, search);
  Deepest deepest;
  if (!search.overlap) {
    const auto found = [&] {
      const Vector3d m = -search.v.normalized();
      deepest = {m, m.dot(supportNear(pair, m, search.corners).w), search.simplex};
      const bool refined = refine(pair, deepest);
      const double off = findWitnesses(pair, {search.simplex.points.data(), std::size_t(search.simplex.size)}, deepest);
      return refined && off <= 1e-9 * pair.scale();
    };
    if (!found() && curved) {
      descend(pair, 1e-13, search);
      if (!search.overlap) found();
    }
  }
  if (search.overlap) deepest = shortestPush(pair, search.simplex);
  NearestPoints near;
  near.distance = -deepest.height;
  near.normal = X_WA.R * -deepest.m;
  const std::optional<Vector3d> middle = middleOfContact(pair, deepest.m);
  near.point_a = X_WA * (middle ? *middle : deepest.points.combined(&MinkowskiPoint::a));
  near.point_b = near.point_a - near.distance * near.normal;
  return near;
}

}  // namespace kinegraph::inline geometry_internal
