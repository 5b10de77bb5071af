#include "kinegraph/features/feature_source.h"

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/features/feature.h"
#include "kinegraph/features/recipe.h"

namespace kinegraph {

FeatureSource::FeatureSource(FeatureRecipe recipe)
    : source_(std::make_shared<const FeatureRecipe>(std::move(recipe))) {}

std::optional<FeatureSymbol> FeatureSource::symbol() const {
  const auto* symbol = std::get_if<FeatureSymbol>(&source_);
  return symbol ? std::optional(*symbol) : std::nullopt;
}

const std::string& FeatureSource::name() const {
  if (const auto* symbol = std::get_if<FeatureSymbol>(&source_)) return featureInfo(*symbol).name;
  if (const FeatureRecipe* known = recipe()) return known->name;
  return std::get<2>(source_)->name;
}

const FeatureRecipe* FeatureSource::recipe() const {
  const auto* known = std::get_if<1>(&source_);
  return known ? known->get() : nullptr;
}

const FeatureSource::Make* FeatureSource::maker() const {
  const auto* custom = std::get_if<2>(&source_);
  return custom ? &(*custom)->make : nullptr;
}

std::unique_ptr<Feature> FeatureSource::make(const std::vector<int>& frames, const State& state) const {
  if (const auto* custom = std::get_if<2>(&source_)) return (*custom)->make(frames, state);
  if (const FeatureRecipe* known = recipe()) return makeFeature(*known, frames);
  try {
    return makeFeature(std::get<0>(source_), frames, state.model());
  } catch (const ValueError& error) {
    if (frames.empty()) throw;
    std::vector<std::string> names;
    for (int frame : frames) names.push_back(state.model().frame_name[frame]);
    throw ValueError(cat(error.what(), " (frames: ", join(names), ")"));
  }
}

}  // namespace kinegraph
