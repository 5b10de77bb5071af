#include <cmath>

#include "kinegraph/geometry/distance/core_pair.h"

namespace kinegraph::inline geometry_internal {

namespace {

using Core = CollisionBody::Core;

/// At most two orthonormal directions.
struct Flats {
  Vector3d basis[2];
  int count = 0;
  bool too_many = false;

  void add(const Vector3d& direction) {
    const double length = direction.norm();
    Vector3d rest = direction;
    for (int pass = 0; pass < 2; ++pass) {
      for (int i = 0; i < count; ++i) rest -= rest.dot(basis[i]) * basis[i];
    }
    const double norm = rest.norm();
    if (!(norm > 1e-8 * length) || length == 0.) return;
    if (count == 2) {
      too_many = true;
      return;
    }
    basis[count++] = rest / norm;
  }

  Vector3d without(Vector3d m) const {
    for (int i = 0; i < count; ++i) m -= m.dot(basis[i]) * basis[i];
    return m;
  }
};

/// The corner of the box below a point of a box_ellipsoid.
Vector3d cornerOf(const CollisionBody& body, const Vector3d& point) {
  return body.halfSides().binaryExpr(point, [](double h, double x) { return std::copysign(h, x); });
}

/// Returns whether the points lie on a cap of the cylinder. `d` is the direction in the cylinder's frame.
bool onCap(const CollisionBody& body, const Simplex& simplex, Vector3d MinkowskiPoint::*part, const Vector3d& d) {
  if (body.core() != Core::cylinder || std::hypot(d.x(), d.y()) > 1e-6) return false;
  for (int i = 1; i < simplex.size; ++i) {
    const Vector3d apart = simplex.points[std::size_t(i)].*part - simplex.points[0].*part;
    if (std::hypot(apart.x(), apart.y()) > 1e-2 * body.coreRadius()) return true;
  }
  return false;
}

/// Adds the flat directions of a core at the points, rotated by R.
void addFlats(const CollisionBody& body, const Simplex& simplex, Vector3d MinkowskiPoint::*part, const Matrix3d& R,
              const Vector3d& m, Flats& flats) {
  if (onCap(body, simplex, part, R.transpose() * m)) {
    flats.add(R.col(0));
    flats.add(R.col(1));
  }
  for (int i = 1; i < simplex.size; ++i) {
    const Vector3d &p = simplex.points[0].*part, &q = simplex.points[std::size_t(i)].*part;
    switch (body.core()) {
      case Core::cylinder:
        if (p.z() != q.z()) flats.add(R.col(2));
        break;
      case Core::box_ellipsoid:
        flats.add(R * (cornerOf(body, q) - cornerOf(body, p)));
        break;
      default:
        flats.add(R * (q - p));
    }
  }
}

/// The second derivative of a core's support function at the unit vector d, in its own frame.
Matrix3d curvature(const CollisionBody& body, const Vector3d& d) {
  if (body.core() == Core::cylinder) {
    const double across = std::hypot(d.x(), d.y());
    if (across < 1e-12) return Matrix3d::Zero();
    const Vector3d t(-d.y() / across, d.x() / across, 0.);
    return body.coreRadius() / across * t * t.transpose();
  }
  if (body.core() == Core::box_ellipsoid) {
    const Vector3d square = body.radii().cwiseAbs2(), scaled = square.cwiseProduct(d);
    const double norm = body.radii().cwiseProduct(d).norm();
    if (norm == 0.) return Matrix3d::Zero();
    return (Matrix3d(square.asDiagonal()) - scaled * scaled.transpose() / (norm * norm)) / norm;
  }
  return Matrix3d::Zero();
}

/// Moves a point of a curved side to the point with normal d.
Vector3d moved(const CollisionBody& body, const Vector3d& point, const Vector3d& d) {
  if (body.core() == Core::cylinder) {
    const double across = std::hypot(d.x(), d.y());
    if (across < 1e-6) return point;  // on a cap
    const double scale = body.coreRadius() / across;
    return {scale * d.x(), scale * d.y(), point.z()};
  }
  if (body.core() == Core::box_ellipsoid) {
    const Vector3d scaled = body.radii().cwiseProduct(d);
    const double norm = scaled.norm();
    if (norm > 0.) return cornerOf(body, point) + body.radii().cwiseProduct(scaled) / norm;
  }
  return point;
}

}  // namespace

double findWitnesses(const CorePair& pair, std::span<const MinkowskiPoint> candidates, Deepest& deepest) {
  const Vector3d &m = deepest.m, d_b = -(pair.X_AB.R.transpose() * m);
  const double scale = pair.scale();
  std::array<MinkowskiPoint, kMaxMinkowskiPoints> flat;  // projected along m
  std::size_t count = 0;
  for (const MinkowskiPoint& candidate : candidates) {
    MinkowskiPoint point{moved(pair.a, candidate.a, m), moved(pair.b, candidate.b, d_b), {}};
    point.w = pair.difference(point.a, point.b);
    const double below = deepest.height - m.dot(point.w);
    if (below > 1e-9 * scale) continue;
    point.w -= m * m.dot(point.w);
    if (count < flat.size()) flat[count++] = point;
  }
  if (count == 0) return scale;
  Simplex simplex;
  Vector3d v = flat[0].w;
  simplex.add(flat[0]);
  simplex.weights[0] = 1.;
  for (int iteration = 0; iteration < 50; ++iteration) {
    std::size_t best = 0;
    for (std::size_t i = 1; i < count; ++i) {
      if (v.dot(flat[i].w) < v.dot(flat[best].w)) best = i;
    }
    if (v.squaredNorm() - v.dot(flat[best].w) <= 1e-13 * v.squaredNorm() + 1e-16 * v.norm() * scale) break;
    const Simplex before = simplex;
    simplex.add(flat[best]);
    bool inside;
    const Vector3d next = simplex.reduce(inside);
    if (next.squaredNorm() >= v.squaredNorm() || simplex.size == 4) {
      simplex = before;
      break;
    }
    v = next;
  }
  for (int i = 0; i < simplex.size; ++i) {
    MinkowskiPoint& point = simplex.points[std::size_t(i)];
    point.w = pair.difference(point.a, point.b);
  }
  deepest.points = simplex;
  return v.norm();
}

bool refine(const CorePair& pair, Deepest& deepest) {
  if (deepest.points.size == 4) return false;
  Flats flats;
  addFlats(pair.a, deepest.points, &MinkowskiPoint::a, Matrix3d::Identity(), deepest.m, flats);
  addFlats(pair.b, deepest.points, &MinkowskiPoint::b, pair.X_AB.R, deepest.m, flats);
  if (flats.too_many) return false;
  const Matrix3d& R = pair.X_AB.R;
  Vector3d m = deepest.m;
  if (flats.count == 2) {
    m = flats.basis[0].cross(flats.basis[1]);
    if (m.dot(deepest.m) < 0.) m = -m;
  } else {
    const Vector3d start = flats.without(m);
    if (start.squaredNorm() < .5) return false;
    m = start.normalized();
    const double rounding = 1e-12 * pair.scale();
    bool converged = false;
    for (int iteration = 0; iteration < 8 && !converged; ++iteration) {
      const Vector3d w = pair.support(m).w;
      const Vector3d t1 = flats.count == 1 ? Vector3d(flats.basis[0].cross(m)) : m.unitOrthogonal();
      const Vector3d t2 = flats.count == 1 ? Vector3d(Vector3d::Zero()) : Vector3d(m.cross(t1));
      const Matrix3d H = curvature(pair.a, m) + R * curvature(pair.b, -(R.transpose() * m)) * R.transpose();
      const double height = m.dot(w), g1 = t1.dot(w), g2 = t2.dot(w);
      const double h11 = t1.dot(H * t1) - height, h12 = t1.dot(H * t2),
                   h22 = flats.count == 1 ? 1. : t2.dot(H * t2) - height;
      const double determinant = h11 * h22 - h12 * h12;
      if (h11 >= -rounding && h22 >= -rounding && std::abs(g1) <= rounding && std::abs(g2) <= rounding) {
        converged = true;  // possibly a minimum that is flat all around
      } else if (!(h11 > 0.) || !(determinant > 0.)) {
        return false;  // not a minimum of h
      } else {
        const double s1 = -(h22 * g1 - h12 * g2) / determinant, s2 = -(h11 * g2 - h12 * g1) / determinant;
        m = (m + s1 * t1 + s2 * t2).normalized();
        converged = s1 * s1 + s2 * s2 < 1e-24;
      }
    }
    if (!converged) return false;
  }
  if (!m.allFinite() || m.dot(deepest.m) < .9) return false;
  const double height = m.dot(pair.support(m).w);
  if (!(height <= deepest.height + 1e-15 * pair.scale())) return false;
  deepest.m = m;
  deepest.height = height;
  return true;
}

}  // namespace kinegraph::inline geometry_internal
