#pragma once

#include <string>
#include <vector>

#include "kinegraph/features/feature_source.h"
#include "kinegraph/features/residual.h"

namespace kinegraph {
class Config;
}

namespace kinegraph::inline features_internal {

/// Makes the residual of a feature of named frames of a scene. Errors name the feature, the frames and similar names.
Residual makeResidual(const State& scene, const FeatureSource& feature, const std::vector<std::string>& frames,
                      const Scale& scale = {}, const Target& target = {}, int order = -1);

/// Evaluates an existing residual into `y` (rows) and `J` (rows x dofs, filled with zeros).
void eval(const Config& config, Residual& residual, Eigen::Ref<VectorXd> y, JacobianRows J);

}  // namespace kinegraph::inline features_internal
