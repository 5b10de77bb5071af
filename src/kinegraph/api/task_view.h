#pragma once

#include <functional>
#include <string>

#include "kinegraph/task_planning/search/task_plan.h"
#include "kinegraph/viewer/messages/shown.h"

namespace kinegraph::inline api_internal {

/// Shows a Config with a text; `pause` waits for a key. Returns the key, or 0.
using ShowScene = std::function<int(bool pause, const std::string& text)>;

/// TaskPlan::play with another way to show C. Throws ValueError if the plan has no motion.
void playTask(const TaskPlan& plan, Config& C, bool pause, const ShowScene& show);

/// Returns the motion of a plan with held objects, to be played at once; each slice has the text of its action. Throws
/// ValueError if the plan has no motion.
ShownMotion taskMotion(const TaskPlan& plan, const Config& C);

/// Returns the longest branch that failed at a waypoint; null if none did.
const TaskBranch* farthestFailed(const TaskPlan& plan);

/// Returns the scene for a plan without a motion: C, with a translucent red copy of the waypoint that failed in the
/// longest branch, if one did.
Config failedScene(const TaskPlan& plan, const Config& C);

}  // namespace kinegraph::inline api_internal
