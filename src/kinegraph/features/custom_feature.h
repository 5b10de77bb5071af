#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "kinegraph/math/pose.h"

namespace kinegraph::inline features_internal {
class Feature;
}

namespace kinegraph::inline kinematics_internal {
class State;
}

namespace kinegraph {

/// The result of a custom function: y, and optionally its Jacobian dy/dq (rows of y x n).
struct FeatureValue {
  VectorXd y;
  MatrixXd J;  ///< empty: central differences replace it

  FeatureValue(double y) : y(VectorXd::Constant(1, y)) {}
  FeatureValue(VectorXd y, MatrixXd J = {}) : y(std::move(y)), J(std::move(J)) {}
  FeatureValue(double y, const MatrixXd& J) : y(VectorXd::Constant(1, y)), J(J) {}
};

/// Computes a value from the frames with these ids at a state.
using StateFunction = std::function<FeatureValue(const State& state, const std::vector<int>& frames)>;

/// Makes a feature of order 0 from a function. If the function returns no Jacobian, it is computed by central
/// differences over the dofs that move the frames, or over all dofs without frames. `name` is for messages. Evaluation
/// throws ValueError if the number of values changes, and for a Jacobian of a wrong size.
std::unique_ptr<Feature> makeCustomFeature(std::string name, StateFunction function, std::vector<int> frames,
                                           const State& scene);

}  // namespace kinegraph
