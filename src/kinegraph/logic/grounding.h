#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "kinegraph/logic/domain.h"

namespace kinegraph {

/// A set of facts, a bit for each.
class FactSet {
 public:
  FactSet() = default;
  explicit FactSet(std::size_t facts) : words_((facts + 63) / 64, 0) {}
  bool has(int fact) const { return words_[std::size_t(fact) / 64] >> (fact % 64) & 1; }
  void insert(int fact) { words_[std::size_t(fact) / 64] |= std::uint64_t(1) << (fact % 64); }
  void erase(int fact) { words_[std::size_t(fact) / 64] &= ~(std::uint64_t(1) << (fact % 64)); }
  std::uint64_t hash() const;
  bool operator==(const FactSet&) const = default;

 private:
  std::vector<std::uint64_t> words_;
};

/// A rule with constants for its variables, in numbers of facts.
struct GroundRule {
  int rule = 0;                        ///< of the domain
  std::vector<std::string> arguments;  ///< for its variables
  std::vector<int> pre, pre_not;       ///< facts that must hold, and those that must not
  std::vector<int> adds, deletes;      ///< no fact is in both
};

/// A problem in numbers: the facts that can ever hold and may change, and what changes them.
struct GroundProblem {
  LogicProblem problem;
  std::vector<Literal> facts;       ///< by number
  std::vector<GroundRule> actions;  ///< in the order of the rules, then of the constants
  std::vector<GroundRule> rules;    ///< that fire by themselves
  FactSet start;                    ///< rules have fired
  std::vector<int> goal, goal_not;
  std::vector<Literal> unreachable;  ///< literals of the goal that nothing can make true

  /// (pick cup table hand): name, then arguments.
  std::vector<std::string> action(int number) const;

  /// The number of a fact, -1 if it can never hold or never changes.
  int factNumber(const Literal& literal) const;

  bool isApplicable(const GroundRule& rule, const FactSet& state) const;
  bool isGoal(const FactSet& state) const;

  /// The state after an action, where all rules have fired. Throws ValueError if they never end.
  FactSet apply(int action, const FactSet& state) const;
  void fireRules(FactSet& state) const;

  /// The literals that hold in a state: those that never change, then those that do.
  std::vector<Literal> literals(const FactSet& state) const;
};

/// Finds the facts that can be reached when nothing is ever deleted, and all rules that can fire then. Throws ParseError
/// with the place for predicates of different numbers of arguments and for words in the goal that are nowhere else, and
/// ValueError if there are more than `most` ground rules, or so many combinations of facts for one that it would not end
/// in minutes.
GroundProblem ground(LogicProblem problem, std::size_t most = 2000000);

/// What is odd about a problem before it is searched, each in a line with its place: predicates in preconditions that
/// nothing can make true, rules that can never fire.
std::vector<std::string> diagnostics(const GroundProblem& ground);

}  // namespace kinegraph
