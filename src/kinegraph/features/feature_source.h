#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "kinegraph/features/registry.h"

namespace kinegraph {

class Feature;
class State;
struct FeatureRecipe;

/// Source of a feature: a symbol of the registry, a recipe, or a custom function that makes it.
class FeatureSource {
 public:
  /// Makes a feature for the frames with these ids. `state` is any State of the scene.
  using Make = std::function<std::unique_ptr<Feature>(const std::vector<int>& frames, const State& state)>;

  FeatureSource(FeatureSymbol symbol) : source_(symbol) {}
  FeatureSource(FeatureRecipe recipe);
  FeatureSource(std::string name, Make make)
      : source_(std::make_shared<const Custom>(Custom{std::move(name), std::move(make)})) {}

  bool operator==(FeatureSymbol symbol) const { return this->symbol() == symbol; }
  std::optional<FeatureSymbol> symbol() const;  ///< empty for other sources
  const std::string& name() const;              ///< for messages
  const FeatureRecipe* recipe() const;          ///< null for other sources
  const Make* maker() const;                    ///< custom function; null for other sources

  /// Makes the feature. Throws ValueError for invalid frames, as makeFeature does; the message ends with the frames'
  /// names.
  std::unique_ptr<Feature> make(const std::vector<int>& frames, const State& state) const;

 private:
  struct Custom {
    std::string name;
    Make make;
  };
  std::variant<FeatureSymbol, std::shared_ptr<const FeatureRecipe>, std::shared_ptr<const Custom>> source_;
};

}  // namespace kinegraph
