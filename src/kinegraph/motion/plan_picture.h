#pragma once

#include "kinegraph/motion/motion_plan.h"
#include "kinegraph/motion/roadmap.h"
#include "kinegraph/scene/config.h"

namespace kinegraph {

/// A copy of the scene that was planned in, and lines in it along which frames went: "start tree" (blue) and "goal tree"
/// (orange) of the last attempt, "first way" (gray), and the "path" (green) that came of it. Where there is none, the
/// obstacle that most motions ended at is red.
///
///     planPicture(C, plan).viewPath(plan.path, plan.duration());
///
/// Frames are given by names; none: one on each link that no other one hangs on. Throws ValueError for a scene with
/// another number of dofs, FrameNotFound for a name.
Config planPicture(const Config& config, const MotionPlan& plan, const std::vector<std::string>& frames = {});

/// The same of a map: "roadmap" (blue) are all motions that are not known to be blocked.
Config roadmapPicture(const Config& config, const Roadmap& map, const std::vector<std::string>& frames = {});

}  // namespace kinegraph
