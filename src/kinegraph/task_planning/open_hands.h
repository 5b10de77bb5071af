#pragma once

#include <limits>
#include <set>
#include <string>
#include <vector>

#include "kinegraph/scene/config.h"

namespace kinegraph::inline task_planning_internal {

/// Returns the scene with the fingers of its hands as far open as their limits allow, also around held objects. A hand
/// opens less if its fingers would overlap something else. Fingers are joints that are no part of q: one joint with one
/// dof and limits, and those that mimic it, on the link of the hand. `most`: the opening of hands that open wider, m.
Config withOpenHands(const Config& C, double most = std::numeric_limits<double>::infinity());

/// Whether a hand opens from where its fingers are to a width (m) without pushing anything aside. Hands without fingers
/// do.
bool opensFreely(const Config& C, const std::string& hand, double width);

/// Returns a scene with the fingers of hands as in another one.
Config withFingersOf(const Config& C, const Config& other);

/// Returns openings of hands, m, that have room for objects and are less than the widest one, wide ones first: for
/// objects next to which open fingers have no room.
std::vector<double> narrowerOpenings(const Config& C, const std::set<std::string>& objects);

}  // namespace kinegraph::inline task_planning_internal
