#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

namespace kinegraph::inline logic_internal {

/// Constants as indices.
using FactTuple = std::vector<int>;

struct FactTupleHash {
  std::size_t operator()(const FactTuple& tuple) const {
    std::uint64_t h = 0x9e3779b97f4a7c15ull;
    for (int value : tuple) {
      h = (h ^ std::uint64_t(std::uint32_t(value))) * 0xff51afd7ed558ccdull;
      h ^= h >> 32;
    }
    return std::size_t(h);
  }
};

/// The facts that follow from given ones by rules of positive literals (Datalog), computed once per fact.
///
/// A new fact is matched with each literal of the rules that has its predicate, and the other literals are joined by
/// indices of facts over the arguments that are bound. Source: Abiteboul, Hull, Vianu, Foundations of Databases, ch. 13
/// (semi-naive evaluation); Helmert, Concise finite-domain representations for PDDL planning tasks, 2009, sec. 6.
class FactJoin {
 public:
  static constexpr int kAnyConstant = INT32_MIN;  ///< an argument that matches any constant

  /// Arguments are variables (0, 1, ...), constants (-1 - index) or kAnyConstant.
  struct Atom {
    int predicate = 0;
    std::vector<int> arguments;
  };
  /// Two arguments that are equal, or not.
  struct Equality {
    int a = 0, b = 0;
    bool equal = true;
  };
  struct Rule {
    int variables = 0;
    std::vector<Atom> body, heads;
    std::vector<Equality> equalities = {};
    bool distinct = false;  ///< different variables are different constants
    int owner = 0;          ///< passed to the callbacks
  };

  /// Adds a predicate; facts of static ones do not follow from rules.
  int addPredicate(std::size_t arguments, bool is_static);
  void addRule(Rule rule) { rules_.push_back(std::move(rule)); }

  /// Adds a fact; false if it is known.
  bool addFact(int predicate, FactTuple tuple);

  /// Computes all facts. `spend(owner, tries)` counts the facts that are tried; `found(owner, predicate)` is called for
  /// each fact that follows.
  void run(std::function<void(int, std::size_t)> spend, std::function<void(int, int)> found);

  bool has(int predicate, const FactTuple& tuple) const { return facts_[std::size_t(predicate)].known.contains(tuple); }
  /// In the order in which they were found.
  const std::vector<FactTuple>& facts(int predicate) const { return facts_[std::size_t(predicate)].list; }
  std::size_t predicates() const { return facts_.size(); }
  bool isStatic(int predicate) const { return facts_[std::size_t(predicate)].is_static; }

 private:
  using Index = std::unordered_map<FactTuple, std::vector<int>, FactTupleHash>;
  struct Facts {
    std::size_t arity = 0;
    bool is_static = false;
    std::vector<FactTuple> list;
    std::unordered_set<FactTuple, FactTupleHash> known;
    std::unordered_map<std::uint64_t, Index> indices;  ///< by the positions that are bound, one bit each
    std::size_t joined = 0;                            ///< facts of the list that take part in joins
  };
  /// A literal of a rule in the order of the join.
  struct Step {
    int atom = 0;
    std::uint64_t bound = 0;  ///< positions
  };
  struct Plan {
    int rule = 0, trigger = -1;  ///< the literal that a new fact matches; -1: none
    std::vector<Step> steps;
  };

  void makePlans();
  Plan planOf(int rule, int trigger) const;
  double costOf(const Atom& atom, const std::vector<char>& bound) const;
  void joinNext(Facts& facts);
  bool bind(const Rule& rule, const Atom& atom, const FactTuple& fact, std::vector<int>& binding) const;
  void join(const Plan& plan, std::size_t step, std::vector<int>& binding);
  void finish(const Rule& rule, const std::vector<int>& binding);

  std::vector<Rule> rules_;
  std::vector<Facts> facts_;
  std::vector<std::vector<Plan>> plans_;    ///< by the predicate of the trigger
  std::vector<std::pair<int, int>> queue_;  ///< predicate, index of the fact
  std::function<void(int, std::size_t)> spend_;
  std::function<void(int, int)> report_;
};

}  // namespace kinegraph::inline logic_internal
