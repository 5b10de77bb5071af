#pragma once

#include "kinegraph/task_planning/search/task_plan.h"

namespace kinegraph {

/// Brings C to where `scene`, that of an action with what is held attached, is at q.
void showTask(Config& C, Config& scene, const VectorXd& q);

}  // namespace kinegraph
