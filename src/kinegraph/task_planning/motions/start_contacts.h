#pragma once

#include <string>
#include <vector>

#include "kinegraph/scene/config.h"

namespace kinegraph::inline task_planning_internal {

/// Returns a scene without the contacts that no plan changes. Held objects may overlap the robot as they do now, until
/// they are put down. Pairs without objects that are equally close in all configurations, such as a base and its floor,
/// do not collide. `margin`: of motions, m.
Config withoutGivenContacts(const Config& C, double margin);

/// Returns the overlaps at the start of robots with hands, as "the start collides: 'a' and 'b' overlap by 3.0 mm"; ""
/// if there are none. No motion begins there.
std::string startContact(const Config& C, const std::vector<std::string>& hands);

}  // namespace kinegraph::inline task_planning_internal
