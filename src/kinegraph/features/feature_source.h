#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "kinegraph/features/recipe.h"
#include "kinegraph/features/registry.h"

namespace kinegraph {

/// Where features come from: a symbol of the registry, a recipe, or a function of one's own that makes them.
class FeatureSource {
 public:
  /// Makes a feature for the frames with these ids. `state` is of the scene, for what the feature needs to know of it.
  using Make = std::function<std::unique_ptr<Feature>(const std::vector<int>& frames, const State& state)>;

  FeatureSource(FeatureSymbol symbol) : source_(symbol) {}
  FeatureSource(FeatureRecipe recipe) : source_(std::make_shared<const FeatureRecipe>(std::move(recipe))) {}
  FeatureSource(std::string name, Make make)
      : source_(std::make_shared<const Own>(Own{std::move(name), std::move(make)})) {}

  bool operator==(FeatureSymbol symbol) const { return this->symbol() == symbol; }
  std::optional<FeatureSymbol> symbol() const;  ///< none for others
  const std::string& name() const;              ///< for messages
  const FeatureRecipe* recipe() const;          ///< null for others
  const Make* maker() const;                    ///< of one's own; null for others

  /// Throws ValueError for frames that do not fit, as makeFeature does; the message ends with the frames' names.
  std::unique_ptr<Feature> make(const std::vector<int>& frames, const State& state) const;

 private:
  struct Own {
    std::string name;
    Make make;
  };
  std::variant<FeatureSymbol, std::shared_ptr<const FeatureRecipe>, std::shared_ptr<const Own>> source_;
};

}  // namespace kinegraph
