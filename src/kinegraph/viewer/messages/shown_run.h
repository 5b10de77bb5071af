#pragma once

#include <optional>
#include <vector>

#include "kinegraph/math/pose.h"

namespace kinegraph::inline viewer_internal {

/// The state of a simulation on the page, beyond the scene.
struct ShownRun {
  struct Contact {
    Vector3d position, force;  ///< world, m and N; the one of the two opposite forces that points up
  };
  struct Spring {
    Vector3d from, to;  ///< the perturbed point and its target: world, m
    double force;       ///< N
  };
  double time = 0.;    ///< s, simulated
  double factor = 0.;  ///< simulated time per real time; 0: not known yet
  bool is_paused = false;
  bool is_steered = true;  ///< users can pause, step, reset and perturb it, and see its time
  std::vector<Contact> contacts{};
  std::optional<Spring> perturbation{};
};

}  // namespace kinegraph::inline viewer_internal
