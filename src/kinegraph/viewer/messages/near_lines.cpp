#include "kinegraph/viewer/messages/near_lines.h"

#include "kinegraph/collision/near_pairs.h"
#include "kinegraph/common/text.h"
#include "kinegraph/scene/tree/scene_tree.h"

namespace kinegraph::inline viewer_internal {

NearLine nearLine(const State& state, int a, int b) {
  const KinematicModel& program = state.model();
  const BodyPairs pairs(program, {{a, b}});
  PlacedBodies bodies(pairs);
  bodies.place(state);
  const Proximity near = bodies.proximity(0);
  return {near.point_a, near.point_b, near.distance,
          cat(program.frame_name[std::size_t(a)], " - ", program.frame_name[std::size_t(b)])};
}

std::vector<NearLine> nearLines(const Config& config, double margin) {
  constexpr std::size_t kMaxLines = 500;
  const State& state = config.state();
  std::vector<NearLine> lines;
  config.scene()->nearPairs().forDistances(margin, [&](int a, int b, double) {
    if (lines.size() < kMaxLines) lines.push_back(nearLine(state, a, b));
  });
  return lines;
}

}  // namespace kinegraph::inline viewer_internal
