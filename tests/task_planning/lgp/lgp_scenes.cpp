#include "tests/task_planning/lgp/lgp_scenes.h"

namespace kinegraph {

std::string LgpProblem::path(const std::string& file) {
  return std::string(KINEGRAPH_SOURCE_DIR) + "/tests/data/lgp/" + file;
}

}  // namespace kinegraph
