#pragma once

#include <string>
#include <vector>

#include "kinegraph/common/text.h"
#include "kinegraph/geometry/distance/proximity.h"
#include "kinegraph/kinematics/kinematic_model.h"
#include "kinegraph/kinematics/state.h"
#include "kinegraph/scene/config.h"

namespace kinegraph::testing {

/// Many shapes of several kinds; every fourth moves freely along three axes, and an arm between them.
inline Config crowd(int count, double spread, std::uint64_t seed) {
  constexpr const char* kShapes[] = {"shape: sphere, size: [.08]", "shape: capsule, size: [.2 .04]",
                                     "shape: ssBox, size: [.2 .1 .15 .02]", "shape: box, size: [.1 .2 .1]",
                                     "shape: cylinder, size: [.2 .06]"};
  Rng rng(seed);
  Config config;
  std::string text = "world: {}\n";
  for (int i = 0; i < count; ++i) {
    std::string place;
    for (int k = 0; k < 3; ++k) place += cat(rng.uniform(-spread, spread), " ");
    place += cat("d(", rng.uniform(0., 360.), " ", rng.normal(), " ", rng.normal(), " 1)");
    const bool moves = i % 4 == 0;
    text += cat("body", i, moves ? "(world)" : "", ": { ", moves ? "pre" : "X", ": \"t(",
                place.substr(0, place.find("d(") - 1), ") ", place.substr(place.find("d(")), "\", ",
                moves ? "joint: trans3, " : "", kShapes[i % 5], ", contact: 1 }\n");
  }
  text += "link0(world): { joint: hingeZ, shape: capsule, size: [.3 .05], contact: -1 }\n";
  for (int i = 1; i < 6; ++i) {
    text += cat("link", i, "(link", i - 1, "): { pre: [0 0 .3], joint: ", i % 2 ? "hingeX" : "hingeY",
                ", shape: capsule, size: [.2 .05], contact: -1 }\n");
  }
  config.addText(text);
  return config;
}

/// The same as Config::getCollisions, by measuring every pair.
inline std::vector<Config::NearPair> measuredCollisions(const Config& config, double margin) {
  std::vector<Config::NearPair> near;
  const State& state = config.state();
  for (const auto& [a, b] : config.getCollidablePairs()) {
    const double distance =
        proximity(*state.model().body[a], state.pose(a), *state.model().body[b], state.pose(b)).distance;
    if (distance <= margin) near.push_back({a, b, distance});
  }
  return near;
}

}  // namespace kinegraph::testing
