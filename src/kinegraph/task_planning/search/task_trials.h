#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "kinegraph/common/cancellation.h"
#include "kinegraph/komo/path/sub_problem.h"
#include "kinegraph/task_planning/search/task_attempts.h"
#include "kinegraph/task_planning/search/task_motions.h"
#include "kinegraph/task_planning/search/task_plan.h"
#include "kinegraph/task_planning/task_doors.h"

namespace kinegraph {

/// Tries sequences of actions: finds waypoints from a seed, motions between them, and has these checked. What comes of it
/// depends on the actions and the seed alone. Several threads may try at the same time.
class TaskTrials {
 public:
  /// Scenes are only copied: the one that is planned in, and the one that was given, for the checker. `ahead` and
  /// `settings` must stay.
  TaskTrials(SpeculativeExecutor& ahead, const TaskAttempt::Settings& settings, std::shared_ptr<const Config> scene,
             std::shared_ptr<const Config> given, MatrixXd limits, std::vector<Literal> goal,
             std::vector<Literal> start);

  struct Order {
    std::vector<TaskAction> actions;
    std::vector<std::vector<Literal>> states;  ///< along them
    int seed = 0;
    Priority wanted = Priority::high;
    std::function<void()> at_first_failure = {};  ///< called once the first start has led to no waypoints
  };
  struct Outcome {
    TaskCause cause;                     ///< why there are no waypoints; null: there are
    std::optional<TaskFailure> failure;  ///< why there is no motion
    std::optional<TaskPlan> plan;        ///< what there is to tell of these actions
    long evaluations = 0;
  };
  Outcome run(const Order& order, const CancellationToken& stopped) const;

 private:
  struct Motion {
    SubProblem part;
    TaskAction action, before;
  };
  using Motions = std::vector<Motion>;

  Motions motionsBetween(const Config& C, const TaskWaypoints& waypoints) const;
  std::vector<TimedRows> moved(const Config& C, const std::shared_ptr<const Motions>& parts, Priority wanted,
                               const CancellationToken& stopped, Outcome& outcome) const;
  std::vector<Literal> shutBy(const Config& C, const Motion& motion, const CancellationToken& stopped,
                              Outcome& outcome) const;
  TaskPlan planOf(const Config& C, const TaskWaypoints& waypoints, const std::vector<TimedRows>& rows) const;

  SpeculativeExecutor& ahead_;
  const TaskAttempt::Settings& settings_;
  const std::shared_ptr<const Config> scene_, given_;
  const MatrixXd limits_;
  const std::vector<Literal> goal_, start_;
  const TaskMotions motions_;
};

}  // namespace kinegraph
