#pragma once

#include <string>
#include <vector>

#include "kinegraph/scene/config.h"

namespace kinegraph {

/// The shortest line between two shapes of a collision pair.
struct NearLine {
  Vector3d a, b;      ///< endpoints on the surfaces, world, m
  double distance;    ///< m, negative: penetration depth
  std::string names;  ///< of the frames
};

/// Returns the line of two frames at their poses in `state`. A frame without a shape counts as a point.
NearLine nearLine(const State& state, int a, int b);

/// Returns the lines of all pairs of `config` within `margin`, m; at most the first 500.
std::vector<NearLine> nearLines(const Config& config, double margin);

}  // namespace kinegraph
