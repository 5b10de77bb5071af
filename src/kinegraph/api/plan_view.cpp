// Shows plans and paths in the viewer.
#include <algorithm>

#include "kinegraph/common/errors.h"
#include "kinegraph/planning/motion_plan.h"
#include "kinegraph/planning/path_finder.h"
#include "kinegraph/viewer/config_viewer.h"

namespace kinegraph {

namespace {

constexpr double kSecondsPerWaypoint = .05, kMinSeconds = 1.;  // playback of a path without times

}  // namespace

int MotionPlan::view(const Config& config, const std::vector<std::string>& frames, bool pause) const {
  Config shown = picture(config, frames);
  if (!feasible()) return shown.view(pause, message);
  return shown.viewPath(path, std::max(options.timing ? duration() : length, 1e-3), pause, str());
}

int PathFinder::view(bool pause, const std::string& message) const {
  if (path_.rows() == 0) throw ValueError("PathFinder.view: there is no path; call solve before");
  Config shown(config_->scene());
  return shown.viewPath(path_, std::max(kMinSeconds, kSecondsPerWaypoint * double(path_.rows())), pause, message);
}

}  // namespace kinegraph
