#include "kinegraph/viewer/near_lines.h"

#include "kinegraph/base/text.h"
#include "kinegraph/kinematics/near_pairs.h"

namespace kinegraph {

std::vector<NearLine> nearLines(const Config& config, double margin) {
  constexpr std::size_t kMost = 500;
  PlacedBodies& bodies = config.scene()->placedBodies();
  const auto program = config.program();
  std::vector<NearLine> lines;
  for (int pair = 0; pair < bodies.pairs() && lines.size() < kMost; ++pair) {
    if (!bodies.mayBeNear(pair, margin)) continue;
    const Proximity near = bodies.proximity(pair);
    if (near.distance > margin) continue;
    const auto [a, b] = program->collidable[std::size_t(pair)];
    const auto& frames = config.scene()->frames();
    lines.push_back({near.point_a, near.point_b, near.distance, cat(frames[std::size_t(a)]->name, " - ", frames[std::size_t(b)]->name)});
  }
  return lines;
}

}  // namespace kinegraph
