#pragma once

#include <optional>

#include "kinegraph/math/pose.h"

namespace kinegraph {

struct RunCommand;
struct PerturbCommand;

/// What people ask of a simulation on the page.
struct RunRequests {
  struct Pull {
    int structure, frame;    ///< which frame, of the scene with that number
    Vector3d point, target;  ///< in the frame's axes, and in the world, m
    bool operator==(const Pull&) const = default;
  };
  bool paused = false;
  int steps = 0;  ///< to take although it is paused
  bool reset = false;
  std::optional<Pull> pull{};  ///< as long as somebody holds it

  /// False for a command that means nothing, which changes nothing.
  bool apply(const RunCommand& command);
  bool apply(const PerturbCommand& command);

  /// What is asked now. A reset, and a step, are asked for once.
  RunRequests take();
};

}  // namespace kinegraph
