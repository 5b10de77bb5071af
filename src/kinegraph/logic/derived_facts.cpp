#include "kinegraph/logic/derived_facts.h"

#include <algorithm>

#include "kinegraph/common/text.h"

namespace kinegraph::inline logic_internal {

namespace {

/// Layers of derived facts; others are -1.
class DerivedLayers {
 public:
  DerivedLayers(const GroundProblem& ground, const std::vector<GroundRule>& rules)
      : ground_(ground), layers_(ground.facts.size(), -1) {
    std::size_t count = 0;
    for (const GroundRule& rule : rules) {
      int& layer = layers_[std::size_t(rule.adds.front())];
      count += layer < 0 ? 1 : 0;
      layer = 0;
    }
    for (bool changed = true; changed;) {
      changed = false;
      for (const GroundRule& rule : rules) {
        int& layer = layers_[std::size_t(rule.adds.front())];
        const int least = std::max(layer, leastLayer(rule));
        if (std::size_t(least) > count) refuse(rule);
        changed |= least > layer;
        layer = least;
      }
    }
  }

  int of(const GroundRule& rule) const { return layers_[std::size_t(rule.adds.front())]; }

 private:
  int leastLayer(const GroundCondition& condition) const {
    int least = 0;
    for (int fact : condition.pre) least = std::max(least, layers_[std::size_t(fact)]);
    for (int fact : condition.pre_not) least = std::max(least, layers_[std::size_t(fact)] + 1);
    for (int number : condition.any) {
      for (const GroundCondition& one : ground_.disjunctions[std::size_t(number)])
        least = std::max(least, leastLayer(one));
    }
    return least;
  }

  [[noreturn]] void refuse(const GroundRule& rule) const {
    throw ValueError(cat("ground: ", ground_.problem.domain.rules[std::size_t(rule.rule)].where.str(), ": ",
                         ground_.facts[std::size_t(rule.adds.front())].str(),
                         " is derived from its own negation; expected rules in which no predicate depends on that"));
  }

  const GroundProblem& ground_;
  std::vector<int> layers_;
};

}  // namespace

void setDerivedRules(GroundProblem& ground, std::vector<GroundRule> rules) {
  std::erase_if(rules, [](const GroundRule& rule) { return rule.adds.empty(); });
  const DerivedLayers layers(ground, rules);
  for (GroundRule& rule : rules) {
    const std::size_t layer = std::size_t(layers.of(rule));
    if (ground.derived.size() <= layer) ground.derived.resize(layer + 1);
    ground.derived[layer].push_back(std::move(rule));
  }
}

void deriveFacts(const GroundProblem& ground, FactSet& state) {
  for (const auto& layer : ground.derived) {
    for (const GroundRule& rule : layer) state.erase(rule.adds.front());
  }
  for (const auto& layer : ground.derived) {
    for (bool changed = true; changed;) {
      changed = false;
      for (const GroundRule& rule : layer) {
        if (state.has(rule.adds.front()) || !ground.holds(rule, state)) continue;
        state.insert(rule.adds.front());
        changed = true;
      }
    }
  }
}

}  // namespace kinegraph::inline logic_internal
