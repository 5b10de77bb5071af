#pragma once

#include <optional>
#include <vector>

#include "kinegraph/math/pose.h"

namespace kinegraph {

/// What a page shows of a simulation beside its scene.
struct ShownRun {
  struct Contact {
    Vector3d position, force;  ///< world, m and N; of the two opposite forces the one that points up
  };
  struct Spring {
    Vector3d from, to;  ///< the point that is pulled, and where to: world, m
    double force;       ///< N
  };
  double time = 0.;    ///< s, simulated
  double factor = 0.;  ///< of real time; 0: not known yet
  bool is_paused = false;
  bool is_steered = true;  ///< people can pause, step, reset and pull it, and see its time
  std::vector<Contact> contacts{};
  std::optional<Spring> pull{};
};

}  // namespace kinegraph
