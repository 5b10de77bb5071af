#pragma once

#include <string>
#include <vector>

#include "kinegraph/features/feature_source.h"
#include "kinegraph/nlp/nlp.h"

namespace kinegraph {

/// A constraint on configurations: scale * (feature - target) is zero (eq), or not positive (ineq).
struct MotionConstraint {
  FeatureSource feature;
  std::vector<std::string> frames;
  ObjectiveType type = ObjectiveType::eq;
  Scale scale = {};
  Target target = {};
};

}  // namespace kinegraph
