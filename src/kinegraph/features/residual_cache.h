#pragma once

#include <memory>
#include <string>
#include <vector>

#include "kinegraph/features/feature_source.h"
#include "kinegraph/features/residual.h"

namespace kinegraph::inline features_internal {

/// Residuals of built-in features from the last few calls, so that a repeated call only costs the evaluation.
class ResidualCache {
 public:
  ResidualCache() = default;
  ResidualCache(const ResidualCache&) {}  ///< a copy starts empty
  ResidualCache& operator=(const ResidualCache&) { return *this; }

  /// Returns a residual as makeResidual does. Later calls may change its scale and target.
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

}  // namespace kinegraph::inline features_internal
