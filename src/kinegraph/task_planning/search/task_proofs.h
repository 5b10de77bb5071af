#pragma once

#include <string>
#include <vector>

#include "kinegraph/task_planning/task_actions.h"

namespace kinegraph {

/// An action that is impossible where some facts hold, and why.
struct ImpossibleAction {
  TaskAction action;
  std::vector<Literal> facts;
  std::string why;
};

/// Where a frame can be at most: a box in the world, swept by a ball.
struct Reach {
  Vector3d center = Vector3d::Zero(), half = Vector3d::Zero();
  double radius = 0.;

  /// How far a point is outside, m; at most 0 where it may be inside.
  double distance(const Vector3d& point) const;
};

/// What a frame cannot leave, by the lengths and limits of what moves it; infinite where something moves without limits.
Reach reachOf(const Config& C, const std::string& name);

/// Of all these actions the default ones that no motion can carry out, whatever comes before them, found without any
/// motion problem: by reach, size, room and height. `start`: what holds at first, of which `fresh` says what stays where it
/// is until it is put or slid elsewhere.
std::vector<ImpossibleAction> impossibleActions(const Config& C, const std::vector<TaskAction>& actions,
                                                const std::vector<Literal>& start = {});

}  // namespace kinegraph
