#pragma once

#include <algorithm>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "kinegraph/logic/domain.h"

namespace kinegraph::oracle {

// The meaning of PDDL, written down once more without grounding, bits or bounds: states are sets of literals as text.
// All costs are assumed to be declared.

using State = std::set<std::string>;
using Values = std::map<std::string, std::string>;  ///< constants of variables

inline std::string instance(Literal literal, const Values& values) {
  literal.negated = false;
  for (std::string& word : literal.arguments) {
    const auto found = values.find(word);
    if (found != values.end()) word = found->second;
  }
  return literal.str();
}

inline bool holdsLiteral(const Literal& literal, const State& state, const Values& values) {
  if (literal.predicate != kEqual) return state.contains(instance(literal, values)) != literal.negated;
  const auto of = [&](const std::string& word) { return values.contains(word) ? values.at(word) : word; };
  return (of(literal.arguments[0]) == of(literal.arguments[1])) != literal.negated;
}

inline bool isPossible(const LogicProblem& problem, const LogicRule& rule, const State& state, const Values& values);
inline void derive(const LogicProblem& problem, State& state);

inline State startOf(const LogicProblem& problem) {
  State state;
  for (const Literal& fact : problem.start) state.insert(fact.str());
  derive(problem, state);
  return state;
}

/// Calls `each` with all values of variables of these types.
template <typename Each>
void forAll(const LogicProblem& problem, const std::vector<std::string>& variables,
            const std::vector<std::string>& types, Values values, std::size_t i, const Each& each) {
  if (i == variables.size()) return each(values);
  for (const std::string& name : problem.constants) {
    const bool typed = i < types.size() && !types[i].empty();
    if (typed && std::ranges::find(problem.start, Literal{types[i], {name}}) == problem.start.end()) continue;
    values[variables[i]] = name;
    forAll(problem, variables, types, values, i + 1, each);
  }
}

inline bool holds(const LogicProblem& problem, const Formula& formula, const State& state, const Values& values) {
  using Kind = Formula::Kind;
  if (formula.kind == Kind::literal) return holdsLiteral(formula.literal, state, values);
  const bool for_all = formula.kind == Kind::all || formula.kind == Kind::forall;
  bool all = true, any = false;
  const auto see = [&](const Formula& part, const Values& inner) {
    const bool one = holds(problem, part, state, inner);
    all &= one;
    any |= one;
  };
  if (formula.kind == Kind::all || formula.kind == Kind::any) {
    for (const Formula& part : formula.parts) see(part, values);
  } else {
    forAll(problem, formula.variables, formula.types, values, 0,
           [&](const Values& inner) { see(formula.parts[0], inner); });
  }
  return for_all ? all : any;
}

inline bool isPossible(const LogicProblem& problem, const LogicRule& rule, const State& state, const Values& values) {
  for (const Literal& literal : rule.pre) {
    if (!holdsLiteral(literal, state, values)) return false;
  }
  for (const Formula& formula : rule.conditions) {
    if (!holds(problem, formula, state, values)) return false;
  }
  return true;
}

/// Derived predicates in the order of their first rules: each one may negate those before it.
inline void derive(const LogicProblem& problem, State& state) {
  std::vector<std::string> predicates;
  for (const LogicRule& rule : problem.domain.rules) {
    if (!rule.is_derived) continue;
    if (std::ranges::find(predicates, rule.name) == predicates.end()) predicates.push_back(rule.name);
    std::erase_if(state, [&](const std::string& fact) {
      return fact == "(" + rule.name + ")" || fact.starts_with("(" + rule.name + " ");
    });
  }
  for (const std::string& predicate : predicates) {
    for (std::size_t before = state.size() + 1; before != state.size();) {
      before = state.size();
      for (const LogicRule& rule : problem.domain.rules) {
        if (!rule.is_derived || rule.name != predicate) continue;
        forAll(problem, rule.variables, rule.types, {}, 0, [&](const Values& values) {
          if (isPossible(problem, rule, state, values)) state.insert(instance(rule.eff[0], values));
        });
      }
    }
  }
}

inline State after(const LogicProblem& problem, const LogicRule& rule, const State& state, const Values& values) {
  State adds, deletes;
  for (const Literal& effect : rule.eff) (effect.negated ? deletes : adds).insert(instance(effect, values));
  for (const ConditionalEffect& conditional : rule.conditional) {
    forAll(problem, conditional.variables, conditional.types, values, 0, [&](const Values& inner) {
      if (!holds(problem, conditional.when, state, inner)) return;
      for (const Literal& effect : conditional.eff) (effect.negated ? deletes : adds).insert(instance(effect, inner));
    });
  }
  State next = state;
  for (const std::string& fact : deletes) next.erase(fact);
  next.insert(adds.begin(), adds.end());
  derive(problem, next);
  return next;
}

inline double costOf(const LogicProblem& problem, const LogicRule& rule, const Values& values) {
  if (!problem.minimize_cost) return 1;
  double sum = rule.cost;
  for (const Literal& function : rule.cost_functions) {
    for (const FunctionValue& value : problem.values) {
      if (value.function.str() == instance(function, values)) sum += value.value;
    }
  }
  return sum;
}

inline bool isGoal(const LogicProblem& problem, const State& state) {
  for (const Literal& literal : problem.goal) {
    if (!holdsLiteral(literal, state, {})) return false;
  }
  for (const Formula& formula : problem.goal_conditions) {
    if (!holds(problem, formula, state, {})) return false;
  }
  return true;
}

/// Returns the cost of a plan, words per action; nothing if it is not valid.
inline std::optional<double> validate(const LogicProblem& problem, const std::vector<std::vector<std::string>>& plan) {
  State state = startOf(problem);
  double cost = 0;
  for (const std::vector<std::string>& action : plan) {
    bool found = false;
    for (const LogicRule& rule : problem.domain.rules) {
      if (rule.name != action[0] || found || rule.is_derived) continue;
      Values values;
      for (std::size_t i = 0; i < rule.variables.size(); ++i) values[rule.variables[i]] = action[i + 1];
      if (!isPossible(problem, rule, state, values)) continue;
      cost += costOf(problem, rule, values);
      state = after(problem, rule, state, values);
      found = true;
    }
    if (!found) return std::nullopt;
  }
  if (!isGoal(problem, state)) return std::nullopt;
  return cost;
}

/// Returns the least cost of a plan by Dijkstra's algorithm; infinity if there is none.
inline double leastCost(const LogicProblem& problem) {
  std::map<State, double> costs = {{startOf(problem), 0.}};
  std::multimap<double, State> open = {{0., startOf(problem)}};
  while (!open.empty()) {
    const auto [cost, state] = *open.begin();
    open.erase(open.begin());
    if (cost > costs.at(state)) continue;
    if (isGoal(problem, state)) return cost;
    for (const LogicRule& rule : problem.domain.rules) {
      if (rule.is_derived) continue;
      forAll(problem, rule.variables, rule.types, {}, 0, [&](const Values& values) {
        if (!isPossible(problem, rule, state, values)) return;
        const State next = after(problem, rule, state, values);
        const double total = cost + costOf(problem, rule, values);
        const auto known = costs.find(next);
        if (known != costs.end() && known->second <= total) return;
        costs[next] = total;
        open.emplace(total, next);
      });
    }
  }
  return std::numeric_limits<double>::infinity();
}

}  // namespace kinegraph::oracle
