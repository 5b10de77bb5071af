#pragma once

#include <optional>
#include <string>

#include "kinegraph/task_planning/placements.h"
#include "kinegraph/task_planning/task_waypoints.h"

namespace kinegraph {

enum class TaskWaypoints::SlotKind { grasp, place, lay, push };

/// Variables of a waypoint problem that place an auxiliary frame.
struct TaskWaypoints::Slot {
  SlotKind kind;
  int first;
  std::string frame;
  std::string face = {};                    ///< of `lay`
  std::optional<Placement> placement = {};  ///< of `place`
  Eigen::Vector2d half = {0., 0.};          ///< of `place`: half of the sides of the place, m
};

}  // namespace kinegraph
