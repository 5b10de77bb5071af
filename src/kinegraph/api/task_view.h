#pragma once

#include <functional>
#include <string>

#include "kinegraph/task_planning/search/task_plan.h"

namespace kinegraph {

/// Shows a Config with a text; `pause` waits for a key. Returns the key, or 0.
using ShowScene = std::function<int(bool pause, const std::string& text)>;

/// TaskPlan::play with another way to show C. Throws ValueError if the plan has no motion.
void playTask(const TaskPlan& plan, Config& C, bool pause, const ShowScene& show);

}  // namespace kinegraph
