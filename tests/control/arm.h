#pragma once

#include "kinegraph/komo/komo.h"

namespace kinegraph {

/// Three joints in a plane, of 0.5 m each, a ball at the tip, a target and an obstacle.
inline Config planarArm() {
  Config C;
  C.addText(R"scene(
base: { }
j1 (base): { joint: hingeZ, limits: [-3 3], q: .3 }
j2 (j1): { pre: "t(.5 0 0)", joint: hingeZ, limits: [-2 2], q: .4 }
j3 (j2): { pre: "t(.5 0 0)", joint: hingeZ, limits: [-2 2], q: .4 }
tip (j3): { Q: "t(.5 0 0)", shape: sphere, size: [.05], contact: 1 }
obstacle: { X: "t(5 0 0)", shape: sphere, size: [.1], contact: 1 }
target: { X: "t(.9 .8 0)" }
)scene");
  return C;
}

/// Ten slices of 50 ms in which the tip goes to the target and stays out of the obstacle.
inline Komo reachingHorizon(const Config& C) {
  Komo komo(C, .5, 20, 2);
  komo.addControlObjective({}, 2, .1);
  komo.addObjective({}, FeatureSymbol::accumulatedCollisions, {}, ObjectiveType::eq);
  komo.addObjective({}, FeatureSymbol::jointLimits, {}, ObjectiveType::ineq);
  komo.addObjective({}, FeatureSymbol::positionDiff, {"tip", "target"}, ObjectiveType::sos, 10.);
  return komo;
}

}  // namespace kinegraph
