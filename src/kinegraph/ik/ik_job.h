#pragma once

#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "kinegraph/math/pose.h"

namespace kinegraph::inline ik_internal {

/// Polled during a search; true cancels it. It may throw.
using Stop = std::function<bool()>;

/// The numbers of one target, and its errors at the present x.
struct IkGoal {
  Matrix3d R = Matrix3d::Identity();  ///< rotation of a pose or rotation target, in the world at the present x
  Vector3d p = Vector3d::Zero();      ///< position or unit direction, in the world at the present x
  Vector3d t1 = Vector3d::Zero(), t2 = Vector3d::Zero();  ///< unit vectors across a direction
  RigidTransform relative;                                ///< the target in the frame that it is relative to
  double position_error = 0., rotation_error = 0.;        ///< m, rad
  double feature_error = 0.;                              ///< largest component
  int worst_component = 0;                                ///< index of the largest component of a feature's error

  void setDirection(const Vector3d& direction);  ///< sets `p`, `t1` and `t2`; `direction` is a unit vector
};

/// Result of the first stage of an attempt, which considers the targets but no collisions.
struct IkApproach {
  bool met;
  double error;  ///< sum of the position, rotation and feature errors
  int evals;
};

/// A problem that is being solved.
struct IkJob {
  std::vector<IkGoal> goals;
  VectorXd start, preferred;  ///< per variable: starting point 0 and the preferred x of this job
  int attempts = 0;           ///< number of completed attempts
  int evals = 0;
  bool feasible = false, cancelled = false;
  VectorXd best;                 ///< the best answer so far, or the failure with the least error
  bool best_is_current = false;  ///< the iterate of the search is at `best`
  double best_value = std::numeric_limits<double>::infinity();  ///< cost of an answer, error of a failure
  std::vector<int> blocked;  ///< per pair: number of attempts that met their targets with this pair as worst collision
};

}  // namespace kinegraph::inline ik_internal
