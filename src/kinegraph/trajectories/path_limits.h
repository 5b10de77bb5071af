#pragma once

#include <functional>
#include <string>
#include <vector>

#include "kinegraph/math/pose.h"

namespace kinegraph {

/// Limits per dof: |dq/dt| <= velocity, |d2q/dt2| <= acceleration, |d3q/dt3| <= jerk. Positive, in rad or m, s;
/// infinity for none. An empty `jerk` limits no jerk.
struct MotionLimits {
  VectorXd velocity, acceleration, jerk;

  bool limitsJerk() const { return jerk.size() > 0; }
  void validate(int dofs) const;  ///< throws ValueError
};

/// Linear constraints at a gridpoint, such as torque limits: low <= a s'' + b s'^2 + c <= high, (m,) each.
struct ScalingConstraints {
  VectorXd a, b, c;
};

/// Constraints of the caller: `at(s, piece)` returns m of them; their limits do not depend on s.
struct ConstraintSource {
  VectorXd low, high;  ///< (m,); infinity for none
  std::function<ScalingConstraints(double s, int piece)> at;
  std::vector<std::string> names;  ///< of the constraints, for messages
  std::string unit;
  explicit operator bool() const { return bool(at); }
};

/// Tells whether a curve along these points (M, dofs) is collision-free; between two points it deviates from the chord
/// by at most `deviation` in every dof.
using BlendCheck = std::function<bool(const MatrixXd& points, double deviation)>;

}  // namespace kinegraph
