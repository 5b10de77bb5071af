#pragma once

#include <optional>

#include "kinegraph/komo/path/path_motion.h"

namespace kinegraph {

/// The variables of a path that begins and ends as this one and goes another way in between; the same for the same number.
/// None where no joint can be moved so. Leaves the path as it was.
///
/// Where all slices show one scene, two trees look for a way between the ends, and from phase end to phase end. What they
/// find is free at all times, not just in slices: its corners are slices, and so all motions from slice to slice are pieces
/// of what was checked. They keep `apart` (m), or half of what the ends keep if that is less; where there is room, up to 16 times as
/// much.
///
/// Where there are modes, where an end is not free, and where trees find nothing, it is q(s) = q_0(s) + d(s), 0 <= s <= 1,
/// with d linear between d(0) = 0, four postures near the ends and between them, and d(1) = 0. These are drawn at random and
/// improved by random moves, so that sampled configurations lack as little as possible to be `apart` of everything; some
/// obstacles may be left in the way.
std::optional<VectorXd> alternativePath(Path& path, double apart, MotionProbe& probe, int number);

}  // namespace kinegraph
