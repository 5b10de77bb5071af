// The methods of Config that need the rooms above the scene.
#include "kinegraph/api/viewer_pictures.h"
#include "kinegraph/common/log.h"
#include "kinegraph/features/eval.h"
#include "kinegraph/scene/tree/scene_tree.h"
#include "kinegraph/viewer/config_viewer.h"

namespace kinegraph {

namespace {

std::optional<std::string> shown(const std::string& message) {
  return message.empty() ? std::nullopt : std::optional(message);
}

bool neverStops() { return false; }

}  // namespace

Evaluation Config::eval(const FeatureSource& feature, const std::vector<std::string>& frames) const {
  return kinegraph::eval(*this, feature, frames);
}

ConfigViewer& Config::viewer() {
  if (!scene_->viewer) scene_->viewer = std::make_shared<ConfigViewer>();
  scene_->viewer->setScene(scene_);  // it may have shown another one
  return *scene_->viewer;
}

int Config::view(bool pause, const std::string& message) {
  viewer().pictures().aimPage();
  return viewer().view(*this, pause, shown(message), neverStops);
}

int Config::viewPath(const MatrixXd& path, double seconds, bool pause, const std::string& message) {
  ShownMotion motion = motionAlong(*this, path, seconds);
  motion.start = ShownMotion::Start::play;
  viewer().pictures().aimPage();
  return viewer().showMotion(*this, motion, pause, shown(message), neverStops);
}

void Config::watchFile(const std::string& path) {
  const auto print = [](const std::string& text) { logMessage(LogLevel::notice, text); };
  kinegraph::watchFile(*this, viewer(), path, print, neverStops);
}

}  // namespace kinegraph
