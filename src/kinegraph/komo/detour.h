#pragma once

#include <optional>

#include "kinegraph/komo/path_motion.h"

namespace kinegraph {

/// The variables of a path that begins and ends as this one and goes another way in between: q(s) = q_0(s) + d(s), 0 <= s
/// <= 1, with d linear between d(0) = 0, four postures near the ends and between them, and d(1) = 0. These are drawn at
/// random and improved by random moves, so that sampled configurations lack as little as possible to be `apart` (m) of
/// everything; some obstacles may be left in the way. The same for the same number. None where no joint can be moved so.
/// Leaves the path as it was.
std::optional<VectorXd> detour(Path& path, double apart, MotionProbe& probe, int number);

}  // namespace kinegraph
