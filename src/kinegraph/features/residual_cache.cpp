#include "kinegraph/features/residual_cache.h"

#include "kinegraph/features/eval.h"
#include "kinegraph/features/make_residual.h"

namespace kinegraph::inline features_internal {

const std::shared_ptr<Residual>& ResidualCache::get(const State& scene, FeatureSymbol symbol,
                                                    const std::vector<std::string>& frames, MatrixXd scale,
                                                    VectorXd target, int order) {
  constexpr std::size_t kEntries = 8;
  for (Entry& entry : entries_) {
    if (entry.symbol != symbol || entry.model != scene.sharedModel() || entry.order != order || entry.frames != frames)
      continue;
    entry.residual->setScale(std::move(scale));
    entry.residual->setTarget(std::move(target));
    return entry.residual;
  }
  Entry made{scene.sharedModel(), symbol, frames, order,
             std::make_shared<Residual>(makeResidual(scene, symbol, frames, scale, target, order))};
  if (entries_.size() < kEntries) return entries_.emplace_back(std::move(made)).residual;
  Entry& place = entries_[oldest_];
  oldest_ = (oldest_ + 1) % kEntries;
  place = std::move(made);
  return place.residual;
}

}  // namespace kinegraph::inline features_internal
