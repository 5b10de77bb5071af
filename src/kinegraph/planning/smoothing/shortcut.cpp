#include "kinegraph/planning/smoothing/shortcut.h"

namespace kinegraph::inline planning_internal {

std::vector<VectorXd> shortcutPath(Steering& steering, std::vector<VectorXd> path, const ShortcutOptions& options) {
  return Shortcutter(steering, std::move(path), options).run();
}

}  // namespace kinegraph::inline planning_internal
