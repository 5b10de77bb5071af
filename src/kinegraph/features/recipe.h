#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "kinegraph/features/forces.h"

namespace kinegraph {

/// A feature that no symbol stands for, said in values, so that problems can be stored.
struct FeatureRecipe {
  std::string name;                       ///< one of recipeNames()
  std::optional<ContactForce> contact{};  ///< of those that are about a force
  double parameter = 0.;                  ///< friction, elasticity, sign, axis or radius
};

/// axisDifference, elasticBounce, force, forceAlongNormal, forceTimesDistance, forceTimesVelocity, frictionCone,
/// pairNormalAlign, pairNormalsOppose, pullingForce, pushRadius, slidingVelocity.
const std::vector<std::string>& recipeNames();

/// The feature for the frames with these ids; those about a force know their frames. Throws NameError for other names,
/// with those that are near, and ValueError for a wrong number of frames or no force.
std::unique_ptr<Feature> makeFeature(const FeatureRecipe& recipe, const std::vector<int>& frames);

}  // namespace kinegraph
