#pragma once

#include <vector>

#include "kinegraph/planning/steering/manifold.h"
#include "kinegraph/task_planning/task_doors.h"

namespace kinegraph::inline task_planning_internal {

/// Maximum slip of a hand on a handle that a planned motion may have, m; checkTaskPlan allows kOffPlace.
inline constexpr double kSlip = 5e-4;

/// Returns the constraints of a motion that holds a handle as in the current scene, scaled so that 1e-3 is .1 mm.
std::vector<MotionConstraint> gripConstraints(const Config& C, const std::string& hand, const std::string& handle);

/// Projects the straight line from q0 to q1 onto constraints. Returns configurations at which they hold to .1 mm, .02
/// rad or m or less apart; empty if the projection fails or jumps.
MatrixXd guidedConfigurations(const Config& C, const VectorXd& q0, const VectorXd& q1,
                              const std::vector<MotionConstraint>& constraints);

/// The motion of a hand on a handle since the grasp: m, and the cosine of the rotation that the grip does not allow.
struct Slip {
  double distance = 0., cosine = 1.;
};

/// Returns the slip between two states of a scene, `taken` and `now`.
Slip slipOf(const Config& taken, const Config& now, const std::string& hand, const std::string& handle);

/// Returns the maximum along a path: at its waypoints, midway between them, and every .02 rad or m.
Slip mostSlip(const Config& taken, const MatrixXd& path, const std::string& hand, const std::string& handle);

}  // namespace kinegraph::inline task_planning_internal
