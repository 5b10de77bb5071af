#include "kinegraph/planning/smoothing/shortcut.h"

namespace kinegraph {

std::vector<VectorXd> shortcutPath(Steering& steering, std::vector<VectorXd> path, const ShortcutOptions& options) {
  return Shortcutter(steering, std::move(path), options).run();
}

}  // namespace kinegraph
