#pragma once

#include <string>
#include <vector>

#include "kinegraph/features/feature_source.h"
#include "kinegraph/features/scale.h"
#include "kinegraph/scene/config.h"

namespace kinegraph {

/// A feature's value and its Jacobian with respect to the configuration's q.
struct Evaluation {
  VectorXd y;
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> J;
};

/// Evaluates a feature at the present q. Throws ValueError for features that need several configurations.
Evaluation eval(const Config& config, const FeatureSource& feature, const std::vector<std::string>& frames,
                const Scale& scale = {}, const Target& target = {}, int order = -1);

}  // namespace kinegraph
