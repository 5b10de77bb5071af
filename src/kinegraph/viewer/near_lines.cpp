#include "kinegraph/viewer/near_lines.h"

#include "kinegraph/base/text.h"
#include "kinegraph/kinematics/near_pairs.h"

namespace kinegraph {

std::vector<NearLine> nearLines(const Config& config, double margin) {
  constexpr std::size_t kMost = 500;
  const std::shared_ptr<SceneTree> scene = config.scene();
  const State& state = config.state();
  const Program& program = state.program();
  std::vector<NearLine> lines;
  scene->nearPairs().forDistances(margin, [&](int a, int b, double distance) {
    if (lines.size() >= kMost) return;
    const Proximity near =
        proximity(*program.body[std::size_t(a)], state.pose(a), *program.body[std::size_t(b)], state.pose(b));
    lines.push_back({near.point_a, near.point_b, distance,
                     cat(program.frame_name[std::size_t(a)], " - ", program.frame_name[std::size_t(b)])});
  });
  return lines;
}

}  // namespace kinegraph
