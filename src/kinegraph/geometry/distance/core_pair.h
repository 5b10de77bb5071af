#pragma once

#include <array>
#include <span>

#include "kinegraph/geometry/distance/collision_body.h"

namespace kinegraph::inline geometry_internal {

/// A point w = a - b of the Minkowski difference of two cores A - B, in the frame of A.
struct MinkowskiPoint {
  Vector3d a;  ///< in the frame of A
  Vector3d b;  ///< in the frame of B
  Vector3d w;
};

/// Two convex cores; all directions are in the frame of A.
///
/// The support function h(m) = max over w in A - B of m.w determines the distance: its minimum over unit vectors m is
/// minus the signed distance, and there -m is the normal from B to A.
struct CorePair {
  const CollisionBody &a, &b;
  RigidTransform X_AB;

  double scale() const { return a.boundRadius() + b.boundRadius(); }

  Vector3d difference(const Vector3d& point_a, const Vector3d& point_b) const { return point_a - X_AB * point_b; }

  MinkowskiPoint support(const Vector3d& m) const {
    const Vector3d p = a.support(m), q = b.support(-(X_AB.R.transpose() * m));
    return {p, q, difference(p, q)};
  }

  /// Returns whether one of the cores has a curved side.
  bool curved() const { return isCurved(a) || isCurved(b); }

 private:
  static bool isCurved(const CollisionBody& body) {
    return body.core() == CollisionBody::Core::cylinder || body.core() == CollisionBody::Core::box_ellipsoid;
  }
};

/// At most four points with a convex combination nearest to the origin.
struct Simplex {
  std::array<MinkowskiPoint, 4> points;
  std::array<double, 4> weights{};
  int size = 0;

  void add(const MinkowskiPoint& point) { points[std::size_t(size++)] = point; }

  /// Computes the weights, drops points of zero weight, and returns the convex combination. `inside` reports whether
  /// the origin lies within four points; all four are then kept. Source: Ericson, Real-Time Collision Detection, 5.1.5
  /// and 5.1.6.
  Vector3d reduce(bool& inside);

  Vector3d combined(Vector3d MinkowskiPoint::*part) const {
    Vector3d sum = Vector3d::Zero();
    for (int i = 0; i < size; ++i) sum += weights[std::size_t(i)] * (points[std::size_t(i)].*part);
    return sum;
  }
};

/// A direction m and the farthest points of A - B along it.
struct Deepest {
  Vector3d m;
  double height;  ///< h(m)
  Simplex points;
};

/// Newton's method on h from a nearly optimal direction m; exact to rounding if it converges. Flat edges and faces,
/// found from the points, fix the direction partly or completely; on curved sides the curvature of h is known in closed
/// form. Returns whether h decreased; otherwise `deepest` is unchanged. The points are never changed.
bool refine(const CorePair& pair, Deepest& deepest);

inline constexpr int kMaxMinkowskiPoints = 256;

/// Replaces the points of `deepest` by a convex combination of the farthest candidates along its direction m.
/// Candidates are points met during the search; those of curved sides are moved to the normal m. Returns the distance
/// (m) of the combination from the line along m through the origin; 0 if the points are witnesses of the distance.
double findWitnesses(const CorePair& pair, std::span<const MinkowskiPoint> candidates, Deepest& deepest);

/// The shortest push that separates overlapping cores: the least h(m) over all m, starting from GJK's final points.
/// Expands a polytope within A - B. For curved sides, pushes with lengths within 1e-5 of the size are equivalent, and
/// any of them may be returned. Source: van den Bergen, Collision Detection in Interactive 3D Environments, 4.3.8.
Deepest shortestPush(const CorePair& pair, const Simplex& start);

}  // namespace kinegraph::inline geometry_internal
