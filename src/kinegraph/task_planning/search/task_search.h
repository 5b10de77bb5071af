#pragma once

#include <chrono>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "kinegraph/task_planning/search/conflict_learner.h"
#include "kinegraph/task_planning/search/plan_task.h"
#include "kinegraph/task_planning/search/sequence_evaluator.h"

namespace kinegraph::inline task_planning_internal {

/// The loop of planTasks: the logic proposes sequences of actions, geometry evaluates them, and failures become
/// constraints of the logic.
class TaskSearch {
 public:
  /// `opening`: of hands that open wider, m.
  TaskSearch(const Config& C, const std::string& goal, const TaskOptions& options,
             double opening = std::numeric_limits<double>::infinity());

  /// See TaskPlans.
  std::optional<TaskPlan> next();

 private:
  using Actions = std::vector<TaskAction>;
  using Outcome = SequenceEvaluator::Outcome;

  /// A sequence of actions that is evaluated with several seeds.
  struct Trial {
    Actions actions;
    std::vector<std::vector<Literal>> states;  ///< in logic, along the actions
    int seed = 0;                              ///< the next one
    bool has_plan = false;
    std::optional<TaskPlan> best = {};                  ///< the most robust plan so far that is not robust
    double robustness = 0.;                             ///< of `best`, m
    long evaluations = 0;                               ///< spent so far
    std::size_t feasible_actions = 0;                   ///< at the beginning, known from pieces
    FutureFailure waypoint_failure = nullptr;           ///< of the next one
    std::optional<TaskFailure> motion_failure = {};     ///< of the last seed that failed
    std::map<int, Speculative<Outcome>> outcomes = {};  ///< by seed
  };

  std::optional<TaskPlan> begin();
  std::vector<double> narrowerThan(const TaskPlan& wide) const;
  std::optional<TaskPlan> withNarrowerHands(const TaskPlan& wide);
  TaskPlan ofNarrowerHands(TaskPlan plan) const;
  std::optional<TaskPlan> nextPlan();
  std::optional<Actions> nextActions();
  std::optional<TaskPlan> nextOf(Trial& trial);
  TaskPlan planned(Trial& trial, TaskPlan plan);
  Speculative<Outcome> outcomeOf(const Trial& trial, int seed, Priority priority);
  void conclude(const Trial& trial);
  bool standsOnItselfIn(const Actions& actions);
  void makeEvaluator();

  long evaluations() const { return evaluations_ + waypoints_.evaluations(); }
  bool isSpent() const { return evaluations() >= options_.max_evaluations || isLate(); }
  bool isLate() const { return std::chrono::steady_clock::now() > deadline_; }
  bool hasPlan() const;

  TaskPlan noSequenceLeft();
  TaskPlan unsolved(const std::string& reason);
  TaskPlan answer(TaskStatus status, std::string message);
  TaskPlan completed(TaskPlan plan);

  const double opening_;  ///< of hands that open wider, m
  const std::shared_ptr<const Config> original_;
  const Config C_;  ///< held objects may overlap the robot as they do at the start
  const std::vector<TaskDoor> doors_;
  TaskOptions options_;  ///< later plans may have more evaluations
  const std::string goal_text_;
  const std::vector<std::string> flaws_;  ///< of the frames of hands
  TaskLogic logic_;
  const MatrixXd limits_;
  const std::chrono::steady_clock::time_point deadline_;
  const WaypointSolver::Settings settings_;
  bool has_begun_ = false, has_ended_ = false;
  bool may_regrasp_ = false;                   ///< regrasps are left to be tried
  bool avoids_poor_ = false;                   ///< poor placements are excluded
  int tried_ = 0;                              ///< sequences
  bool needs_seeds_ = false;                   ///< a sequence with waypoints had no motion
  double best_;                                ///< duration of the last plan, s
  long evaluations_ = 0;                       ///< spent by outcomes
  const std::shared_ptr<const Config> scene_;  ///< a copy of C_ that threads share
  std::optional<Trial> trial_;
  BranchLog log_;
  std::shared_ptr<const SequenceEvaluator> evaluator_;
  SpeculativeExecutor executor_;
  WaypointCache waypoints_;
  ConflictLearner learner_;
  std::unique_ptr<TaskSearch> narrower_;  ///< with hands that open less
};

}  // namespace kinegraph::inline task_planning_internal
