#pragma once

#include <limits>
#include <vector>

#include "kinegraph/logic/grounding.h"

namespace kinegraph {

/// A lower bound on the number of actions to the goal, from landmarks: sets of actions such that each plan contains one
/// of them. Deletes count only for negated preconditions. Source: Helmert, Domshlak, Landmarks, critical paths and
/// abstractions: what's the difference anyway?, ICAPS 2009.
class LandmarkCut {
 public:
  static constexpr int kNever = std::numeric_limits<int>::max() / 4;  ///< no plan leads to the goal

  explicit LandmarkCut(const GroundProblem& ground);

  /// Adds a negated fact to the precondition of an action.
  void require(int action, int fact_not);

  int operator()(const FactSet& state);

 private:
  struct Operator {
    std::vector<int> pre, adds;
    int cost = 0;
  };
  int negation(int fact);
  void addOperator(const GroundRule& rule, int cost);
  void link();
  bool explore(const std::vector<int>& begin);
  int cut(const std::vector<int>& begin);

  const GroundProblem& ground_;
  std::vector<int> negation_;  ///< per fact: the node of its negation, or -1
  int nodes_ = 0, goal_ = 0, always_ = 0;
  bool linked_ = false;
  std::vector<Operator> operators_;  ///< actions, rules, and one that reaches the goal
  std::vector<std::vector<int>> needed_by_, added_by_;
  // Buffers of one evaluation.
  std::vector<int> value_, cost_, missing_, supporter_;
  std::vector<std::vector<int>> bucket_;
  std::vector<char> zone_, before_;
};

}  // namespace kinegraph
