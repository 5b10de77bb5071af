#pragma once

#include <array>
#include <vector>

#include "kinegraph/math/pose.h"

namespace kinegraph::inline ik_internal {

/// The axis of a hinge in a reference configuration, in world coordinates.
struct HingeAxis {
  Vector3d direction;  ///< unit vector
  Vector3d point;      ///< any point on it, m

  /// The rotation about this axis by an angle (rad).
  RigidTransform turn(double angle) const;
};

/// Angles of six hinges, from their reference configuration, in (-pi, pi].
using SixAngles = std::array<double, 6>;

/// Finds all solutions of turn_1(a_1) turn_2(a_2) ... turn_6(a_6) = X for an arm of six hinges, if its geometry has a
/// closed form:
///
/// - three axes in a row at one end meet in a point, as of a spherical wrist (or shoulder): at most 8 solutions, from
///   the roots of a polynomial of degree four for the other three hinges
/// - axes 2 to 4 are parallel and axes 5 and 6 intersect, as of UR arms, or the same from the other end: at most 8
///
/// Sources: Pieper, The kinematics of manipulators under computer control, 1968; Elias and Wen, IK-Geo, 2024.
class ClosedFormArm {
 public:
  explicit ClosedFormArm(const std::array<HingeAxis, 6>& axes);

  bool isSolvable() const { return kind_ != Kind::none; }

  /// All solutions; none if the pose is out of reach. At a singularity, one of the many. Solutions are as exact as the
  /// roots of a polynomial, which are about 1e-7 rad near a double root.
  std::vector<SixAngles> solve(const RigidTransform& X) const;

 private:
  enum class Kind { none, wrist, parallel };
  std::vector<SixAngles> solveWrist(const RigidTransform& X) const;
  std::vector<SixAngles> solveParallel(const RigidTransform& X) const;

  Kind kind_ = Kind::none;
  bool from_tool_ = false;         ///< the chain is seen from its other end
  std::array<HingeAxis, 6> axes_;  ///< in the order in which they are solved
  Vector3d center_;                ///< of the wrist, or the intersection of axes 5 and 6
};

/// Angles a at which turn_1(a_1) turn_2(a_2) turn_3(a_3) moves `from` to `to`, all solutions (at most four).
std::vector<std::array<double, 3>> anglesToPoint(const HingeAxis& first, const HingeAxis& second,
                                                 const HingeAxis& third, const Vector3d& from, const Vector3d& to);

}  // namespace kinegraph::inline ik_internal
