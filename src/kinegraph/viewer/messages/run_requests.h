#pragma once

#include <optional>

#include "kinegraph/math/pose.h"

namespace kinegraph::inline viewer_internal {

struct RunCommand;
struct PerturbCommand;

/// Requests of users to a simulation on the page.
struct RunRequests {
  struct Perturbation {
    int structure, frame;    ///< index of the frame, and the structure number of its scene
    Vector3d point, target;  ///< in the frame's axes, and in the world, m
    bool operator==(const Perturbation&) const = default;
  };
  bool paused = false;
  int steps = 0;  ///< pending single steps of a paused simulation
  bool reset = false;
  std::optional<Perturbation> perturbation{};  ///< while a user drags the point

  /// Applies a command. Returns false for an invalid command, which changes nothing.
  bool apply(const RunCommand& command);
  bool apply(const PerturbCommand& command);

  /// Returns the present requests. A reset and each single step are returned once.
  RunRequests take();
};

}  // namespace kinegraph::inline viewer_internal
