#pragma once

#include <functional>
#include <string>
#include <vector>

#include "kinegraph/common/cancellation.h"
#include "kinegraph/tool_paths/tool_kinematics.h"
#include "kinegraph/trajectories/path_curve.h"

namespace kinegraph::inline tool_paths_internal {

/// Joint values along a tool curve: q(s) in cubic pieces with continuous second derivatives between corners.
struct JointCurve {
  CubicPieces pieces;
  double position_deviation = 0., rotation_deviation = 0.;  ///< proven at all s, m and rad
  std::string message;                                      ///< "" if the tool keeps to the curve, else why not
  double place = 0.;                                        ///< where not, m
  int blocked = -1;                                         ///< a dof at its limit there, or -1

  bool feasible() const { return message.empty(); }
};

/// Interpolates configurations at places (ascending, with all corners and both ends) along the curve, and adds knots
/// until the tool keeps to the curve within the tolerance at all s.
///
/// Each piece is bounded like this: with e(s) the tool minus its target, the quartic through five values of e has
/// Bernstein coefficients whose hull contains it, and the rest is at most max |e^(5)| / 5! times the largest node
/// polynomial. The Taylor coefficients of products of rotations R(q_1(s)) R(q_2(s)) ... are at most those of
/// exp(sum_j |q_j(s) - q_j|), which bounds e^(5); targets are cubic.
JointCurve jointCurveAlong(ToolKinematics& tool, const ToolCurve& curve, std::vector<double> places,
                           std::vector<VectorXd> configurations, const ToolTolerance& tolerance,
                           const CancellationToken& cancellation);

/// The curve as input of `retime`: n dofs, and one more for the length of the tool's way (m), whose rate is the tool's
/// speed relative to the path's reference frame.
PathCurve withToolWay(ToolKinematics& tool, const ToolCurve& curve, const CubicPieces& joints);

/// The same with one more dof: the integral of the last one's slope divided by speed_of(s) (m/s), which is constant on
/// each piece. A limit of 1 for its velocity keeps these speeds.
PathCurve withSpeedShare(const PathCurve& path, const std::function<double(double)>& speed_of);

}  // namespace kinegraph::inline tool_paths_internal
