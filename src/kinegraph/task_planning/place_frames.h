#pragma once

#include <set>
#include <string>
#include <vector>

#include "kinegraph/scene/config.h"

namespace kinegraph::inline task_planning_internal {

/// Returns the reason for which nothing can stand on a frame, "it is tilted"; "" for a place. Places are boxes and
/// cylinders with a level top of 5 cm or more that stand still, or hang below one of the `drawers`. `objects` are boxes
/// of any size, or cylinders, that hands can move.
std::string placeFlaw(const Frame& frame, const std::set<std::string>& objects, const std::set<std::string>& drawers);

/// Whether an object is far from standing on a place: more than 4 mm above or below its top, or 2 cm beside it.
bool isOff(const Frame& obj, const Frame& place);

/// Returns the place that an object stands on, the one with the nearest top; "" if none.
std::string supportingPlace(const Config& C, const std::string& obj, const std::vector<std::string>& places);

}  // namespace kinegraph::inline task_planning_internal
