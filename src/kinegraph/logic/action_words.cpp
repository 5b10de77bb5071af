#include "kinegraph/logic/grounding.h"

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"

namespace kinegraph {

namespace {

using Words = std::vector<std::string>;

bool isAction(const GroundProblem& ground, int number, const Words& action) {
  const GroundRule& rule = ground.actions[std::size_t(number)];
  return action.size() == rule.arguments.size() + 1 &&
         action[0] == ground.problem.domain.rules[std::size_t(rule.rule)].name &&
         std::equal(rule.arguments.begin(), rule.arguments.end(), action.begin() + 1);
}

}  // namespace

int actionNumber(const GroundProblem& ground, const Words& action) {
  const int count = int(ground.actions.size());
  for (int a = 0; a < count; ++a) {
    if (isAction(ground, a, action)) return a;
  }
  Words all;
  for (int a = 0; a < count; ++a) all.push_back(join(ground.action(a), " "));
  const std::string words = join(action, " ");
  throw ValueError(cat("PlanSearch: there is no action (", words, ")", similarHint(words, all)));
}

std::vector<int> actionNumbers(const GroundProblem& ground, const std::vector<Words>& actions) {
  std::vector<int> numbers;
  for (const Words& action : actions) numbers.push_back(actionNumber(ground, action));
  return numbers;
}

std::vector<Words> actionWords(const GroundProblem& ground, const std::vector<int>& actions) {
  std::vector<Words> words;
  for (const int action : actions) words.push_back(ground.action(action));
  return words;
}

std::vector<int> changingFacts(const GroundProblem& ground, const std::vector<Literal>& facts) {
  std::vector<int> numbers;
  for (const Literal& fact : facts) {
    numbers.push_back(ground.factNumber(fact));
    if (numbers.back() < 0)
      throw ValueError(cat("PlanSearch.forbid: ", fact.str(), " never changes, or can never hold"));
  }
  return numbers;
}

std::vector<std::vector<Literal>> statesAlong(const GroundProblem& ground, const std::vector<int>& actions) {
  FactSet state = ground.start;
  std::vector<std::vector<Literal>> states = {ground.literals(state)};
  for (const int action : actions) {
    if (!ground.isApplicable(ground.actions[std::size_t(action)], state)) {
      throw ValueError(cat("PlanSearch: (", join(ground.action(action), " "), ") is not possible as action ",
                           states.size(), " of the sequence"));
    }
    state = ground.apply(action, state);
    states.push_back(ground.literals(state));
  }
  return states;
}

}  // namespace kinegraph
