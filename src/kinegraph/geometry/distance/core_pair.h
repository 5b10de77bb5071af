#pragma once

#include <array>
#include <span>

#include "kinegraph/geometry/distance/collision_body.h"

namespace kinegraph {

/// A point w = a - b of the Minkowski difference of two cores A - B, in the frame of A.
struct MinkowskiPoint {
  Vector3d a;  ///< in the frame of A
  Vector3d b;  ///< in the frame of B
  Vector3d w;
};

/// Two convex cores; all directions are in the frame of A.
///
/// The support function h(m) = max over w in A - B of m.w decides everything: its least value over unit vectors m is
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

  /// Does a core have a side that bends?
  bool curved() const { return bends(a) || bends(b); }

 private:
  static bool bends(const CollisionBody& body) {
    return body.core() == CollisionBody::Core::cylinder || body.core() == CollisionBody::Core::box_ellipsoid;
  }
};

/// At most four points of which some mixture is nearest to the origin.
struct Simplex {
  std::array<MinkowskiPoint, 4> points;
  std::array<double, 4> weights{};
  int size = 0;

  void add(const MinkowskiPoint& point) { points[std::size_t(size++)] = point; }

  /// Computes the weights, drops the points whose weight is zero, and returns the mixture. `inside` tells whether the
  /// origin lies within four points, which then all stay. Source: Ericson, Real-Time Collision Detection, 5.1.5
  /// and 5.1.6.
  Vector3d reduce(bool& inside);

  Vector3d mixed(Vector3d MinkowskiPoint::*part) const {
    Vector3d sum = Vector3d::Zero();
    for (int i = 0; i < size; ++i) sum += weights[std::size_t(i)] * (points[std::size_t(i)].*part);
    return sum;
  }
};

/// A direction m and the points of A - B that are farthest along it.
struct Deepest {
  Vector3d m;
  double height;  ///< h(m)
  Simplex points;
};

/// Newton's method on h from a direction that is nearly the best one: exact to rounding where it converges. Flat edges
/// and faces, which the points show, fix the direction in part or whole; where sides bend, the curvature of h is known.
/// What gets worse is left as it was; returns whether it got better. The points stay as they were.
bool refine(const CorePair& pair, Deepest& deepest);

inline constexpr int kMaxMinkowskiPoints = 256;

/// Replaces the points of `deepest` by a mixture of some that are farthest along its direction m, made from those that
/// were met on the way there: those of bent sides are moved to where the normal is m. Returns how far the mixture is
/// off the line along m through the origin, m; 0 if the points are witnesses of the distance.
double settle(const CorePair& pair, std::span<const MinkowskiPoint> candidates, Deepest& deepest);

/// The shortest push that parts overlapping cores: least h(m) over all m, from points that GJK ended with. Expands a
/// polytope within A - B. Where sides bend, of pushes whose lengths differ by less than 1e-5 of the size any may be
/// found. Source: van den Bergen, Collision Detection in Interactive 3D Environments, 4.3.8.
Deepest shortestPush(const CorePair& pair, const Simplex& start);

}  // namespace kinegraph
