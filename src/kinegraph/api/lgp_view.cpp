// Shows the waypoints of an LgpTool in the viewer.
#include "kinegraph/task_planning/lgp/lgp_tool.h"
#include "kinegraph/viewer/config_viewer.h"

namespace kinegraph {

int LgpTool::view_solved(bool pause) { return getSolvedKOMO()->view(pause, planText(getSolvedPlan())); }

void LgpTool::view_close() {
  if (hasPlan()) komo_->viewer().close();
}

}  // namespace kinegraph
