#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "kinegraph/task_planning/task_actions.h"
#include "kinegraph/trajectories/trajectory.h"

namespace kinegraph {

class BotOp;
struct ExecutionOptions;
struct TaskExecution;
/// How planTask ended.
enum class TaskStatus {
  solved,         ///< there is a plan, and checkTaskPlan accepted it
  infeasible,     ///< proved: no motion reaches the goal
  no_plan_found,  ///< no plan was found within the budget of evaluations; this proves nothing
  timeout,        ///< no plan was found within the time limit
};

/// The enumerator's spelling: "no_plan_found".
std::string taskStatusName(TaskStatus status);

/// A sequence of actions that the search tried.
struct TaskBranch {
  std::vector<TaskAction> actions;
  std::string cause;  ///< the reason for which the search gave the branch up; "" for a plan

  /// The scene at the waypoint that failed, as close to the demands of the last action as the solver came; null if no
  /// waypoint failed.
  std::shared_ptr<const Config> failed_configuration;
};

/// Consecutive rows of a matrix: begin <= row < end.
struct RowRange {
  Eigen::Index begin = 0, end = 0;
  Eigen::Index size() const { return end - begin; }
};

/// The error of the poses of the robot and of objects that a step survives.
struct StepTolerance {
  double error = 0.;  ///< m
  std::string limit;  ///< what happens with a larger one: "'l_palm' meets 'b'"
};

/// Limits of the search of TaskPlan::repair; none: those of the plan.
struct RepairOptions {
  std::optional<double> time_limit = {};     ///< s of wall time
  std::optional<long> max_evaluations = {};  ///< of the functions of waypoint and motion problems
  std::optional<int> threads = {};
  std::string also = {};  ///< further literals of the goal, such as "(up z cup)"; those only if the domain has `up`
};

/// The result of planTask: actions with their timed motion, or the causes for which there is none.
///
/// As a Trajectory, the plan is piecewise linear in time between the rows of `path`. Its velocity is constant between
/// two rows and 0 before the start and after the end; its acceleration is 0. Grippers take no time.
struct TaskPlan : Trajectory {
  TaskStatus status = TaskStatus::no_plan_found;
  std::string message;                ///< "" if solved, else the reason for which there is no plan
  std::vector<std::string> warnings;  ///< caveats of a plan
  std::vector<TaskAction> actions;
  MatrixXd waypoints;              ///< (K, n): q after each action
  MatrixXd path;                   ///< (T, n), rad or m; no rows without a motion. It is straight between two rows
  VectorXd times;                  ///< (T,), s
  MatrixXd limits;                 ///< (2, n): the velocity and acceleration limits of the motion; empty: unknown
  std::vector<RowRange> segments;  ///< rows of each action; the motion is at rest at the beginning of each
  std::vector<std::pair<std::string, int>> causes;  ///< of branches that were given up, the most frequent first
  std::vector<TaskBranch> tree;                     ///< all branches, in the order in which they were tried
  std::vector<std::string> violations;              ///< found by checkTaskPlan
  double margin =
      0.;  ///< m: kept by all pairs whose contact is not meant; less than TaskOptions::margin with a warning
  std::vector<StepTolerance> tolerances;                         ///< of each action
  long evaluations = 0;                                          ///< of motion problems
  long expansions = 0;                                           ///< of states in logic
  std::vector<std::pair<std::string, std::string>> attachments;  ///< (parent, object) after each action that moves one
  std::vector<Config> scenes;        ///< the scene of each action, with held objects attached to hands
  std::vector<Literal> goal, start;  ///< literals of the goal, and facts that hold initially

  /// Plans to the same goal with the same options in another scene.
  std::function<TaskPlan(const Config&, const RepairOptions&)> replanner;

  bool feasible() const { return status == TaskStatus::solved; }

  int dimension() const override { return int(path.cols()); }
  double duration() const override { return times.size() == 0 ? 0. : times[times.size() - 1]; }
  void evalTo(double t, double* q, double* velocity, double* acceleration) const override;

  /// "4 actions, 12.31 s" for a plan, else the message.
  std::string summary() const;

  /// Several lines: the status, the weakest step with the error of poses that it survives, the spent evaluations, and
  /// all causes for which branches were given up.
  std::string explain() const;

  /// The branches as a tree: a line per action, with the cause behind the last action of each branch.
  std::string searchTree() const;

  /// Plays the plan on the page of `C`, with a time slider; without a motion, the page shows the search tree and, if a
  /// waypoint failed, the failedConfiguration. `C` is the scene of the call to planTask. Returns the key pressed, or 0.
  int view(Config& C, bool pause = true) const;

  /// Shows the motion of each action, with held objects moving along; `pause` waits for a key before each action. `C`
  /// ends in the final scene. Throws ValueError if there is no motion.
  void play(Config& C, bool pause = false) const;

  /// Poses of all frames, (frames, 7) each, at equal time steps of 1 / `rate` s. Throws ValueError if there is no
  /// motion.
  std::vector<MatrixXd> frames(const Config& C, double rate = 25.) const;

  /// A copy of the scene with a translucent red copy of the waypoint that failed in the longest branch. Throws
  /// ValueError if no branch failed at a waypoint.
  Config failedConfiguration(const Config& C) const;

  /// Executes the plan on a robot; see kinegraph::execute in api/execution/task_execution.h.
  TaskExecution execute(BotOp& bot) const;
  TaskExecution execute(BotOp& bot, const ExecutionOptions& options) const;

  /// Throws ValueError, in the name of `call`, if there is no motion.
  void requireMotion(const char* call) const;

  /// The same, also if there is not one scene and one segment per action.
  void requireScenes(const char* call) const;

  /// Plans the remaining actions to the same goal from the current scene `C`. Throws ValueError for plans without a
  /// replanner; planTask and planTasks set it.
  TaskPlan repair(const Config& C, const RepairOptions& options = {}) const;

  /// The status and summary, the actions, and the most frequent causes.
  std::string str() const;
};

/// Branches as a tree: a common prefix of consecutive branches is written once.
std::string treeText(const std::vector<TaskBranch>& branches);

}  // namespace kinegraph
