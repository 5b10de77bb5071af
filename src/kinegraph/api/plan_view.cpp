// Shows plans and paths in the viewer.
#include "kinegraph/api/plan_view.h"

#include <algorithm>

#include "kinegraph/common/errors.h"
#include "kinegraph/planning/path_finder.h"
#include "kinegraph/viewer/config_viewer.h"

namespace kinegraph {

namespace {

constexpr double kSecondsPerWaypoint = .05, kMinSeconds = 1.;  // playback of a path without times

}  // namespace

ShownMotion api_internal::shownPlan(const MotionPlan& plan, const Config& picture) {
  const double seconds = std::max(plan.options.timing ? plan.duration() : plan.length, 1e-3);
  ShownMotion motion = motionAlong(picture, plan.path, seconds);
  motion.start = ShownMotion::Start::play;
  return motion;
}

int MotionPlan::view(const Config& config, const std::vector<std::string>& frames, bool pause) const {
  Config shown = picture(config, frames);
  ConfigViewer& viewer = Config(config.scene()).viewer();  // config's own page
  const auto never = [] { return false; };
  if (!feasible()) return viewer.view(shown, pause, message, never);
  return viewer.showMotion(shown, shownPlan(*this, shown), pause, str(), never);
}

int PathFinder::view(bool pause, const std::string& message) const {
  if (path_.rows() == 0) throw ValueError("PathFinder.view: there is no path; call solve before");
  Config shown(config_->scene());
  return shown.viewPath(path_, std::max(kMinSeconds, kSecondsPerWaypoint * double(path_.rows())), pause, message);
}

}  // namespace kinegraph
