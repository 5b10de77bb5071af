#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "kinegraph/logic/grounding.h"

namespace kinegraph::inline logic_internal {

/// Lists of numbers, one behind the other in memory.
class NumberLists {
 public:
  NumberLists() = default;
  explicit NumberLists(const std::vector<std::vector<int>>& lists);
  std::span<const int> operator[](int list) const {
    const int begin = begin_[std::size_t(list)], end = begin_[std::size_t(list) + 1];
    return {numbers_.data() + begin, std::size_t(end - begin)};
  }

 private:
  std::vector<int> begin_, numbers_;
};

/// A lower bound on the cost of the actions to the goal, from landmarks: sets of actions such that each plan contains
/// one of them. Deletes count only for negated preconditions. The effects of an action under different conditions, and
/// the alternatives of a disjunction, are operators of their own; all operators of an action share its cost, so that
/// the bound stays one. Source: Helmert, Domshlak, Landmarks, critical paths and abstractions: what's the difference
/// anyway?, ICAPS 2009; Roeger, Pommerening, Helmert, Optimal planning in the presence of conditional effects, ECAI
/// 2014.
class LandmarkCut {
 public:
  using Cost = std::int64_t;
  static constexpr Cost kNever = std::numeric_limits<Cost>::max() / 4;  ///< no plan leads to the goal

  /// `costs`, one per action.
  LandmarkCut(const GroundProblem& ground, const std::vector<Cost>& costs);

  /// Each action costs 1.
  explicit LandmarkCut(const GroundProblem& ground);

  /// Adds a negated fact to the precondition of an action.
  void require(int action, int fact_not);

  Cost operator()(const FactSet& state);

 private:
  struct Operator {
    std::vector<int> pre, adds, deletes;
    int owner = -1;  ///< the action whose cost it has; -1: none
  };
  int negation(int fact);
  int disjunctionNode(int number) const { return int(negation_.size()) + number; }
  void prepareNegations(const GroundCondition& condition);
  void addOperator(const std::vector<const GroundCondition*>& conditions, const std::vector<int>& adds,
                   const std::vector<int>& deletes, int owner);
  void addOperators(const GroundRule& rule, int owner);
  void link();
  Cost costOf(int op) const {
    const int owner = owner_[std::size_t(op)];
    return owner < 0 ? 0 : cost_[std::size_t(owner)];
  }
  void reach(int node, Cost value);
  void explore(const std::vector<int>& begin);
  void exploreAgain(const std::vector<int>& changed);
  Cost popped(int& node);
  void findSupporter(int op);
  void addFree(int op);
  void markZone();
  Cost cut(const std::vector<int>& begin, std::vector<int>& changed);
  Cost payFor(std::vector<int>& leading, std::vector<int>& changed);

  const GroundProblem& ground_;
  std::vector<Cost> costs_;
  std::vector<int> negation_;     ///< per fact: the node of its negation, or -1
  std::vector<char> is_derived_;  ///< facts that may cease to hold by themselves: their negations are free
  int nodes_ = 0, goal_ = 0, always_ = 0;
  bool linked_ = false;
  bool small_ = true;  ///< small costs: a queue of buckets
  std::vector<Operator> operators_;
  NumberLists pre_, adds_;                ///< of operators
  NumberLists needed_by_, owned_by_;      ///< operators of nodes, of actions
  std::vector<int> owner_, always_free_;  ///< of operators; those without cost
  // Buffers of one evaluation.
  std::vector<Cost> value_, cost_, supporter_value_;
  std::vector<int> missing_, supporter_;
  std::vector<std::vector<int>> bucket_;
  std::size_t at_ = 0;
  std::vector<std::pair<Cost, int>> heap_;
  std::vector<char> zone_, before_;
  struct Free {
    int op, next;
  };
  std::vector<int> free_by_;  ///< per node: the first of the operators without cost that add it, in `free_`; or -1
  std::vector<Free> free_;
};

}  // namespace kinegraph::inline logic_internal
