#pragma once

#include "kinegraph/features/eval.h"
#include "tests/support/near.h"

namespace kinegraph {

/// Five fixed shapes whose feature values can be computed on paper.
inline Config workedScene() {
  Config config;
  config.addText(R"g(
    A: { X: "t(1 2 3) d(90 0 0 1)", shape: ssBox, size: [.4 .4 .2 .05] }
    B: { X: "t(1.5 2 3) d(30 1 0 0)", shape: sphere, size: [.1] }
    C: { X: "t(1 2 3.3)", shape: ssBox, size: [.2 .2 .2 .02] }
    P: { X: "t(1.1 2.3 3.0)", shape: marker, size: [.1] }
    D: { X: "t(1 2.15 3.3) d(10 0 0 1)", shape: capsule, size: [.3 .05] }
  )g");
  return config;
}

inline VectorXd numbers(std::initializer_list<double> values) {
  return Eigen::Map<const VectorXd>(values.begin(), Eigen::Index(values.size()));
}

/// Value of a feature, by name.
inline VectorXd value(const Config& config, const char* feature, const std::vector<std::string>& frames,
                      const VectorXd& target = {}) {
  return eval(config, featureSymbolFromName(feature), frames, {}, target).y;
}

}  // namespace kinegraph
