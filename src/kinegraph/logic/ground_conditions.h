#pragma once

#include <functional>
#include <map>
#include <set>
#include <string>
#include <unordered_map>
#include <vector>

#include "kinegraph/logic/fact_join.h"
#include "kinegraph/logic/grounding.h"

namespace kinegraph::inline logic_internal {

/// The names of a problem as indices, and the facts that can hold.
struct GroundNames {
  using Shape = std::pair<std::string, std::size_t>;  ///< predicate, number of arguments

  FactJoin join;
  std::vector<std::string> constants;
  std::map<std::string, int> constant_numbers;
  std::map<Shape, int> predicates;
  std::set<Shape> changing;                                                     ///< in effects
  std::vector<std::unordered_map<FactTuple, int, FactTupleHash>> fact_numbers;  ///< by predicate

  int constant(const std::string& name);
  int predicate(const std::string& name, std::size_t arguments);
  /// A literal with variables by their index in `scope`; the last one of a name counts.
  FactJoin::Atom atom(const Literal& literal, const std::vector<std::string>& scope);
};

/// A formula whose names are indices; its variables follow those of the surroundings.
struct IndexedFormula {
  Formula::Kind kind = Formula::Kind::all;
  FactJoin::Atom atom = {};  ///< of literals
  bool is_equality = false, negated = false;
  std::vector<IndexedFormula> parts = {};
  int first = 0;                ///< index of the first variable of a quantifier
  std::vector<int> types = {};  ///< predicates, one per variable; -1: any object
};

IndexedFormula indexed(const Formula& formula, std::vector<std::string>& scope, GroundNames& names);

/// Grounds conditions once the facts that can hold are known.
class ConditionGrounder {
 public:
  ConditionGrounder(const GroundNames& names, GroundProblem& out) : names_(names), out_(out) {}

  /// Adds a condition with values for its free variables; false if it can never hold.
  bool add(const IndexedFormula& formula, std::vector<int>& binding, GroundCondition& to);

  /// Returns the facts that match an atom; `holds`: a matching fact never changes.
  std::vector<int> matching(const FactJoin::Atom& atom, const std::vector<int>& binding, bool& holds) const;

  /// Calls `found` for all values of variables that are not excluded by `guards`, literals that have to be reachable.
  void forInstances(int first, const std::vector<int>& types, const std::vector<const FactJoin::Atom*>& guards,
                    std::vector<int>& binding, const std::function<bool()>& found) const;

  /// Literals without which a formula is never true (`negated`: never false).
  static void collectGuards(const IndexedFormula& formula, bool negated, std::vector<const FactJoin::Atom*>& guards);

 private:
  bool addLiteral(const IndexedFormula& formula, const std::vector<int>& binding, GroundCondition& to);
  bool addAlternatives(std::vector<GroundCondition> alternatives, GroundCondition& to);
  bool addExists(const IndexedFormula& formula, std::vector<int>& binding, GroundCondition& to);
  bool isReachable(const FactJoin::Atom& atom, const std::vector<int>& binding) const;

  const GroundNames& names_;
  GroundProblem& out_;
  std::map<std::vector<int>, int> disjunctions_;  ///< index by content
};

}  // namespace kinegraph::inline logic_internal
