#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "kinegraph/features/forces.h"

namespace kinegraph::inline features_internal {

/// A feature without a symbol, described by values, so that problems can be stored.
struct FeatureRecipe {
  std::string name;                       ///< one of recipeNames()
  std::optional<ContactForce> contact{};  ///< for features of a force
  double parameter = 0.;                  ///< friction, elasticity, sign, axis or radius
};

/// Lists axisDifference, elasticBounce, force, forceAlongNormal, forceTimesDistance, forceTimesVelocity, frictionCone,
/// pairNormalAlign, pairNormalsOppose, pullingForce, pushRadius and slidingVelocity.
const std::vector<std::string>& recipeNames();

/// Makes the feature for the frames with these ids; features of a force take the frames of their force. Throws
/// NameError for unknown names, with suggestions, and ValueError for a wrong number of frames or a missing force.
std::unique_ptr<Feature> makeFeature(const FeatureRecipe& recipe, const std::vector<int>& frames);

}  // namespace kinegraph::inline features_internal
