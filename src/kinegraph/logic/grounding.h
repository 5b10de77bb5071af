#pragma once

#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

#include "kinegraph/logic/domain.h"

namespace kinegraph {

/// A set of facts, one bit each.
class FactSet {
 public:
  FactSet() = default;
  explicit FactSet(std::size_t facts) : words_((facts + 63) / 64, 0) {}
  bool has(int fact) const { return isInside(fact) && words_[std::size_t(fact) / 64] >> (fact % 64) & 1; }
  void insert(int fact) {
    if (!isInside(fact)) growTo(fact);
    words_[std::size_t(fact) / 64] |= std::uint64_t(1) << (fact % 64);
  }
  void erase(int fact) {
    if (isInside(fact)) words_[std::size_t(fact) / 64] &= ~(std::uint64_t(1) << (fact % 64));
  }
  std::uint64_t hash() const;
  bool operator==(const FactSet&) const = default;

 private:
  void growTo(int fact);
  bool isInside(int fact) const { return std::size_t(fact) / 64 < words_.size(); }

  std::vector<std::uint64_t> words_;
};

/// Facts that must hold, facts that must not, and disjunctions of which one alternative must hold.
struct GroundCondition {
  std::vector<int> pre = {}, pre_not = {};
  std::vector<int> any = {};  ///< indices of GroundProblem::disjunctions

  bool isTrue() const { return pre.empty() && pre_not.empty() && any.empty(); }
  bool operator==(const GroundCondition&) const = default;
};

/// Effects under a condition, which is tested before the action.
struct GroundEffect {
  GroundCondition when = {};
  std::vector<int> adds = {}, deletes = {};
};

/// A rule with constants for its variables; facts are indices.
struct GroundRule : GroundCondition {
  int rule = 0;                              ///< index in the domain
  std::vector<std::string> arguments = {};   ///< of its variables
  std::vector<int> adds = {}, deletes = {};  ///< no fact is in both
  std::vector<GroundEffect> when = {};       ///< deletes come before all adds
  std::int64_t cost = 1;                     ///< in units of GroundProblem::cost_unit; rules cost nothing
};

/// A ground problem: the facts that can hold and change, and the rules that change them.
struct GroundProblem {
  LogicProblem problem;
  std::vector<Literal> facts;                    ///< by index
  std::vector<GroundRule> actions;               ///< in the order of the rules, then of the constants
  std::vector<GroundRule> rules;                 ///< that fire automatically
  std::vector<std::vector<GroundRule>> derived;  ///< by layer; facts that a layer negates are of layers before
  std::vector<std::vector<GroundCondition>> disjunctions;  ///< alternatives
  FactSet start;                                           ///< after the rules have fired
  std::vector<int> goal, goal_not, goal_any;
  std::vector<Literal> unreachable;  ///< literals of the goal that no rule can make true
  std::vector<Formula> impossible;   ///< conditions of the goal that can never hold
  double cost_unit = 1;

  /// Returns an action. Throws ValueError for a number that is none.
  const GroundRule& actionAt(int number) const;

  /// Returns the words of an action, name and arguments: (pick cup table hand).
  std::vector<std::string> action(int number) const;

  /// Returns the index of a fact, -1 if it can never hold or never changes.
  int factNumber(const Literal& literal) const;

  /// Returns the sum of the costs of actions; their number if the problem has no metric.
  double cost(const std::vector<int>& plan) const;

  bool isApplicable(const GroundRule& rule, const FactSet& state) const { return holds(rule, state); }
  bool holds(const GroundCondition& condition, const FactSet& state) const;
  bool isGoal(const FactSet& state) const;

  /// Returns the state after an action and all rules. Throws ValueError if the rules never end.
  FactSet apply(int action, const FactSet& state) const;
  void fireRules(FactSet& state) const;  ///< and derives the facts of derived predicates

  /// Returns the literals that hold in a state: first those that never change.
  std::vector<Literal> literals(const FactSet& state) const;

  std::unordered_map<std::string, int> numbers;      ///< indices of facts by their key
  static std::string keyOf(const Literal& literal);  ///< `on table cup`
};

/// Grounds a problem: finds the facts that are reachable without deletes, and all rules that can fire then. Throws
/// ParseError with the position for unknown words in the goal, and for a predicate of the goal with a number of
/// arguments that no rule and no fact has. Throws ValueError for more than `most` ground rules, or if the combinations
/// for one rule would take minutes.
GroundProblem ground(LogicProblem problem, std::size_t most = 2000000);

/// Returns likely mistakes in a problem, a sentence with its position each: predicates in preconditions that nothing
/// can make true, and rules that can never fire.
std::vector<std::string> diagnostics(const GroundProblem& ground);

/// Returns the index of an action given as words, (pick cup table hand). Throws ValueError with similar actions.
int actionNumber(const GroundProblem& ground, const std::vector<std::string>& action);
std::vector<int> actionNumbers(const GroundProblem& ground,
                               const std::vector<std::vector<std::string>>& actions);  ///< of each

/// Returns the words of actions: name, then arguments.
std::vector<std::vector<std::string>> actionWords(const GroundProblem& ground, const std::vector<int>& actions);

/// Returns indices of facts for PlanSearch::forbid. Throws ValueError for a fact that never changes, or can never hold.
std::vector<int> changingFacts(const GroundProblem& ground, const std::vector<Literal>& facts);

/// Returns the literals that hold at the start and after each action. Throws ValueError for an action whose
/// precondition does not hold.
std::vector<std::vector<Literal>> statesAlong(const GroundProblem& ground, const std::vector<int>& actions);

}  // namespace kinegraph
