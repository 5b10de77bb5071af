#pragma once

#include <string>
#include <vector>

#include "kinegraph/komo/komo.h"
#include "kinegraph/task_planning/task_actions.h"

namespace kinegraph::inline task_planning_internal {

/// Two frames that overlap in a waypoint, although the action does not name both.
struct WaypointOverlap {
  int slice = 0;
  std::string a, b;
  double depth = 0;  ///< m

  /// `'cup' and 'can' overlap by 12 mm`
  std::string str() const;
};

/// Returns the overlaps of more than 1 mm in the waypoints of a plan that the actions do not imply: of an object that
/// the action does not name, and of the moved object with a part of the scene that it does not name. Overlaps in the
/// scene itself do not count.
std::vector<WaypointOverlap> overlapsWithOthers(const Config& C, const Komo& waypoints,
                                                const std::vector<TaskAction>& plan);

}  // namespace kinegraph::inline task_planning_internal
