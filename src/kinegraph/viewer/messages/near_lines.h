#pragma once

#include <string>
#include <vector>

#include "kinegraph/scene/config.h"

namespace kinegraph {

/// The shortest line between two shapes that may collide.
struct NearLine {
  Vector3d a, b;      ///< its ends on the surfaces, world, m
  double distance;    ///< m, negative: penetration depth
  std::string names;  ///< of the frames
};

/// That of two frames, where `state` has them. A frame without a shape counts as a point.
NearLine nearLine(const State& state, int a, int b);

/// Those of all pairs of `config` that are not farther apart than `margin`, m; the first 500.
std::vector<NearLine> nearLines(const Config& config, double margin);

}  // namespace kinegraph
