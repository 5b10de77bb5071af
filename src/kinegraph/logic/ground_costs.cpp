#include "kinegraph/logic/ground_costs.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "kinegraph/common/text.h"

namespace kinegraph::inline logic_internal {

namespace {

constexpr double kFinest = 1e6, kMostUnits = 1e9;

double costOf(const LogicRule& rule, const GroundRule& action, const std::map<std::string, double>& values) {
  double sum = rule.cost;
  for (Literal function : rule.cost_functions) {
    for (std::string& word : function.arguments) {
      const auto variable = std::ranges::find(rule.variables, word);
      if (variable != rule.variables.end()) word = action.arguments[std::size_t(variable - rule.variables.begin())];
    }
    const auto value = values.find(GroundProblem::keyOf(function));
    const std::string name = cat("the cost ", function.str(), " of action '", rule.name, "'");
    if (value == values.end()) throw ParseError(function.where, cat(name, " has no value"));
    if (value->second < 0) throw ParseError(function.where, cat(name, " is ", value->second, "; expected at least 0"));
    sum += value->second;
  }
  return sum;
}

}  // namespace

void setActionCosts(GroundProblem& ground) {
  std::map<std::string, double> values;
  for (const FunctionValue& value : ground.problem.values) values[GroundProblem::keyOf(value.function)] = value.value;
  std::vector<double> costs;
  for (const GroundRule& action : ground.actions)
    costs.push_back(costOf(ground.problem.domain.rules[std::size_t(action.rule)], action, values));
  double scale = 1;
  const auto is_whole = [&](double cost) {
    const double scaled = cost * scale;
    return std::abs(scaled - std::round(scaled)) <= 1e-9 * std::max(1., scaled);
  };
  while (scale < kFinest && !std::ranges::all_of(costs, is_whole)) scale *= 10;
  for (std::size_t a = 0; a < costs.size(); ++a) {
    if (!is_whole(costs[a]) || costs[a] * scale > kMostUnits)
      throw ValueError(cat("ground: the cost ", costs[a], " of (", join(ground.action(int(a)), " "),
                           ") is too fine or too large; expected at most 6 decimals and 1e9 of them"));
    ground.actions[a].cost = std::llround(costs[a] * scale);
  }
  ground.cost_unit = 1 / scale;
}

}  // namespace kinegraph::inline logic_internal
