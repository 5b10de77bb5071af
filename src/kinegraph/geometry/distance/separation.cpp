#include "kinegraph/geometry/distance/separation.h"

#include <cmath>
#include <limits>

#include "kinegraph/geometry/distance/core_pair.h"

namespace kinegraph::inline geometry_internal {

namespace {

constexpr int kMaxSteps = 40;
constexpr double kRounding = 1e-13;  // relative to a square

/// The farthest corner of a hull, found by climbing from a nearby corner.
Vector3d climb(const Hull& hull, const Vector3d& direction, std::uint32_t& corner) {
  double height = direction.dot(hull.points[corner]);
  for (bool climbing = true; climbing;) {
    climbing = false;
    for (std::uint32_t k = hull.first_neighbor[corner], end = hull.first_neighbor[corner + 1]; k < end; ++k) {
      const double other = direction.dot(hull.points[hull.neighbors[k]]);
      if (other <= height) continue;
      height = other;
      corner = hull.neighbors[k];
      climbing = true;
      break;
    }
  }
  return hull.points[corner];
}

}  // namespace

Vector3d supportNear(const CollisionBody& body, const Vector3d& direction, std::uint32_t& corner) {
  if (body.core() != CollisionBody::Core::hull || body.hull().first_neighbor.empty()) return body.support(direction);
  return climb(body.hull(), direction, corner);
}

std::optional<SeparatingDirection> separation(const CollisionBody& a, const RigidTransform& X_WA,
                                              const CollisionBody& b, const RigidTransform& X_WB, double margin,
                                              SupportCorners& corners) {
  const double needed = margin + a.radius() + b.radius();
  if (needed < 0.) return std::nullopt;
  const Matrix3d R_AW = X_WA.R.transpose();
  const CorePair pair{a, b, {R_AW * X_WB.R, R_AW * (X_WB.p - X_WA.p)}};
  const double touching = 1e-8 * pair.scale();
  Simplex simplex;
  Vector3d v = pair.difference(a.boundCenter(), b.boundCenter());
  if (v.squaredNorm() == 0.) v = Vector3d::UnitX();
  double before = std::numeric_limits<double>::infinity();
  for (int step = 0; step < kMaxSteps; ++step) {
    const Vector3d p = supportNear(a, -v, corners.a), q = supportNear(b, pair.X_AB.R.transpose() * v, corners.b);
    const MinkowskiPoint point{p, q, pair.difference(p, q)};
    const double square = v.squaredNorm(), along = v.dot(point.w), norm = std::sqrt(square);
    if (along >= needed * norm) return SeparatingDirection{true, X_WA.R * (v / norm)};
    if (simplex.size > 0 && square - along <= kRounding * square) return std::nullopt;
    simplex.add(point);
    bool overlap = false;
    v = simplex.reduce(overlap);
    const double now = v.norm();
    if (overlap || now < needed * (1. - kRounding)) return SeparatingDirection{false, {}};
    if (now <= touching || now * now >= before) return std::nullopt;
    before = now * now;
  }
  return std::nullopt;
}

}  // namespace kinegraph::inline geometry_internal
