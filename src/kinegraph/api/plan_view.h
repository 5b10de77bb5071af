#pragma once

#include "kinegraph/planning/motion_plan.h"
#include "kinegraph/viewer/messages/shown.h"

namespace kinegraph::inline api_internal {

/// Returns the motion of a plan in its picture (MotionPlan::picture), with the plan's times or, without times, its
/// length as seconds. It plays at once.
ShownMotion shownPlan(const MotionPlan& plan, const Config& picture);

}  // namespace kinegraph::inline api_internal
