#pragma once

#include <memory>
#include <string>
#include <vector>

#include "kinegraph/features/registry.h"
#include "kinegraph/features/residual.h"

namespace kinegraph {

/// Residuals of the last few questions about built-in features, so that the same question again costs its evaluation
/// only.
class ResidualCache {
 public:
  ResidualCache() = default;
  ResidualCache(const ResidualCache&) {}  ///< a copy starts empty
  ResidualCache& operator=(const ResidualCache&) { return *this; }

  /// As makeResidual. Later calls may give it another scale and target.
  const std::shared_ptr<Residual>& get(const State& scene, FeatureSymbol symbol, const std::vector<std::string>& frames,
                                       MatrixXd scale, VectorXd target, int order);

 private:
  struct Entry {
    std::shared_ptr<const KinematicModel> model;
    FeatureSymbol symbol;
    std::vector<std::string> frames;
    int order;
    std::shared_ptr<Residual> residual;
  };
  std::vector<Entry> entries_;
  std::size_t oldest_ = 0;
};

}  // namespace kinegraph
