#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "kinegraph/task_planning/lgp/lgp_abstraction.h"
#include "kinegraph/task_planning/lgp/lgp_tool.h"

namespace kinegraph::inline task_planning_internal {

/// Solves the waypoint problems of plans in logic, and caches the results. Its arguments must outlive it.
class LgpWaypoints {
 public:
  using Plan = std::vector<TaskAction>;

  LgpWaypoints(const Config& C, LgpAbstraction& tamp, const LgpOptions& options)
      : C_(C), tamp_(tamp), options_(options) {}

  /// Returns the length of the shortest infeasible prefix; none if the plan is feasible.
  std::optional<std::size_t> failing(const Plan& plan);

  /// Solves a failed plan from other guesses, which differ in each round from 1 on. Returns whether there are
  /// waypoints.
  bool tryAgain(const Plan& plan, int round) { return solve(plan, round); }

  /// Returns the initial guesses of a problem, which differ for each problem and round.
  std::vector<VectorXd> starts(const std::shared_ptr<Komo>& problem, int round);

  /// Returns the causes of failures and their counts, the most frequent first.
  std::vector<std::pair<std::string, int>> causes() const;

  std::shared_ptr<Komo> komo;  ///< the last problem, at its solution
  VectorXd x;                  ///< its variables
  int solves = 0;              ///< guesses that were tried so far
  long evaluations = 0;        ///< spent by them

 private:
  bool isFeasible(const Plan& plan);
  bool solve(const Plan& plan, int round);
  std::shared_ptr<Komo> problemOf(const Plan& plan) const;
  LgpSolve count(LgpSolve solved);
  std::string avoidOthers(const Plan& plan, const std::shared_ptr<Komo>& problem, int round);
  void addCause(const Plan& plan, const std::string& why);

  const Config& C_;
  LgpAbstraction& tamp_;
  const LgpOptions& options_;
  int problems_ = 0;  ///< so far; each has other guesses
  std::map<Plan, bool> known_;
  std::vector<std::pair<std::string, int>> causes_;  ///< in the order of occurrence
};

}  // namespace kinegraph::inline task_planning_internal
