#pragma once

#include <string>
#include <vector>

#include "kinegraph/task_planning/task_actions.h"

namespace kinegraph::inline task_planning_internal {

/// An action that is impossible while all of the facts hold.
struct ImpossibleAction {
  TaskAction action;
  std::vector<Literal> facts;
  std::string cause;
};

/// A bound on the positions of a frame: a box in the world, enlarged by a ball.
struct Reach {
  Vector3d center = Vector3d::Zero(), half = Vector3d::Zero();
  double radius = 0.;

  /// The distance of a point from the bound, m; not positive if the point may be reached.
  double distance(const Vector3d& point) const;
};

/// Returns the bound on the positions of a frame, from the lengths and limits of the joints above it. It is infinite if
/// a joint has no limits.
Reach reachOf(const Config& C, const std::string& name);

/// Returns the default actions that no motion can carry out, whatever precedes them. The proofs use reach, size, room
/// and height, and solve no motion problem. `start` has the initial facts; a `fresh` object stays in place until an
/// action puts or slides it elsewhere.
std::vector<ImpossibleAction> impossibleActions(const Config& C, const std::vector<TaskAction>& actions,
                                                const std::vector<Literal>& start = {});

}  // namespace kinegraph::inline task_planning_internal
