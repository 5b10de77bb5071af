#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "kinegraph/task_planning/lgp/lgp_abstraction.h"
#include "kinegraph/task_planning/lgp/lgp_starts.h"

namespace kinegraph {

/// Solves the waypoint problems of plans in logic, and remembers which could be solved. What it is made of must outlive it.
class LgpWaypoints {
 public:
  using Plan = std::vector<TaskAction>;

  LgpWaypoints(const Config& C, LgpAbstraction& tamp, const LgpOptions& options)
      : C_(C), tamp_(tamp), options_(options) {}

  /// How many of the first actions cannot be carried out together; none if all can.
  std::optional<std::size_t> failing(const Plan& plan);

  /// A plan that has failed, from other starts, others in each round from 1 on. Are there waypoints?
  bool tryAgain(const Plan& plan, int round) { return solve(plan, round); }

  /// Where the problem of a plan is tried from, others for each problem and in each round.
  std::vector<VectorXd> starts(const std::shared_ptr<Komo>& problem, int round);

  /// Why problems failed, and how often, the most frequent first.
  std::vector<std::pair<std::string, int>> causes() const;

  std::shared_ptr<Komo> komo;  ///< that was solved last, at its solution
  VectorXd x;                  ///< its variables
  int solves = 0;              ///< starts that were tried so far
  long evaluations = 0;        ///< of them

 private:
  bool isFeasible(const Plan& plan);
  bool solve(const Plan& plan, int round);
  const Config& C_;
  LgpAbstraction& tamp_;
  const LgpOptions& options_;
  int problems_ = 0;  ///< so far: starts of each are others
  std::map<Plan, bool> known_;
  std::vector<std::pair<std::string, int>> causes_;  ///< in the order in which they came
};

}  // namespace kinegraph
