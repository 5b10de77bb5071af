#pragma once

#include <string>
#include <vector>

#include "kinegraph/scene/config.h"
#include "kinegraph/task_planning/task_actions.h"

namespace kinegraph::inline task_planning_internal {

/// A hand, and where it takes or leaves something, in the world.
struct ContactPoint {
  std::string hand;
  Vector3d at;
};

/// Returns the hands that take or leave something at the ends of a motion from q0 to q1; `before` is the action that
/// ended at q0, empty if there is none.
std::vector<ContactPoint> contactPoints(const Config& C, const VectorXd& q0, const VectorXd& q1,
                                        const TaskAction& action, const TaskAction& before);

/// Returns later times for the waypoints of a motion (T, n), so that hands have at most `speed` (m/s) up to 5 cm away
/// from their contact points. `limits`: velocity and acceleration of each dof, (2, n), which the motion keeps.
VectorXd slowerNearContacts(const Config& C, const MatrixXd& path, const VectorXd& times, const MatrixXd& limits,
                            const std::vector<ContactPoint>& points, double speed);

}  // namespace kinegraph::inline task_planning_internal
