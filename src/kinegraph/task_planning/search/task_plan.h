#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "kinegraph/task_planning/task_actions.h"

namespace kinegraph {

class BotOp;
struct TaskExecution;

enum class TaskStatus {
  solved,      ///< the plan passed checkTaskPlan
  infeasible,  ///< no motion can do it
  not_found,   ///< within the effort: that is no proof
};

/// "solved", "proved impossible" or "not found"
std::string taskStatusName(TaskStatus status);

/// A sequence of actions that was tried, and why it was given up.
struct TaskBranch {
  std::vector<TaskAction> actions;
  std::string why;                      ///< "" where it was not given up
  std::shared_ptr<const Config> ghost;  ///< the scene at the waypoint that it failed at, as near as was found; or null
};

/// Rows of a matrix.
struct RowRange {
  Eigen::Index begin = 0, end = 0;
  Eigen::Index size() const { return end - begin; }
};

/// What planTask found, or why it found nothing.
struct TaskPlan {
  TaskStatus status = TaskStatus::not_found;
  std::string message;
  std::vector<TaskAction> actions;
  MatrixXd waypoints;              ///< K x n: q after each action
  MatrixXd path;                   ///< T x n, rad or m; no rows without a motion. Between two rows it is straight
  VectorXd times;                  ///< (T,), s
  MatrixXd limits;                 ///< 2 x n: velocities and accelerations that it keeps; empty: not known
  std::vector<RowRange> segments;  ///< of each action; the motion is at rest where one begins
  std::vector<std::pair<std::string, int>> causes;  ///< why branches were given up, the most frequent first
  std::vector<TaskBranch> tree;
  std::vector<std::string> violations;  ///< of the checker
  long evaluations = 0, expansions = 0;
  std::vector<std::pair<std::string, std::string>> attachments;  ///< what objects hang below after their action
  std::vector<Config> scenes;                                    ///< of each action, with what is held attached
  std::vector<Literal> goal, start;                              ///< what shall hold, what holds at first
  std::function<TaskPlan(const Config&)> again;                  ///< the same call for another scene

  bool feasible() const { return status == TaskStatus::solved; }

  /// Of the motion, s, without the time that grippers take; 0 without a motion.
  double duration() const { return times.size() == 0 ? 0. : times[times.size() - 1]; }

  /// Where the motion is at t (s, held within 0 and duration): (n,). Throws ValueError if there is none.
  VectorXd at(double t) const;

  /// Why there is no plan, or what stood in the way of others: a line per cause.
  std::string why() const;

  /// What was tried, as a tree: a line per action, causes behind the last one of a branch.
  std::string searchTree() const;

  /// Shows the plan: its motion, or, where there is none, the tree of the search and the failedConfiguration. C is the scene that was
  /// planned in, and ends as it was. Returns the key pressed, or 0.
  int view(Config& C, bool pause = true) const;

  /// Shows the motion of each action, with what is held moving along; `pause` waits for a key before each. C ends as after
  /// the plan. Throws ValueError if there is no motion.
  void play(Config& C, bool pause = false) const;

  /// Where all frames are (frames x 7) at equal steps of time, `rate` per second. Throws ValueError if there is no motion.
  std::vector<MatrixXd> frames(const Config& C, double rate = 25.) const;

  /// A copy of the scene in which the waypoint that the farthest branch failed at stands as a red ghost. Throws ValueError
  /// where no branch failed at one.
  Config failedConfiguration(const Config& C) const;

  /// Moves a robot along the plan; see kinegraph::execute in api/task_execution.h.
  TaskExecution execute(BotOp& bot) const;

  /// Throws ValueError if there is no motion; `call` is what asks.
  void requireMotion(const char* call) const;

  /// Plans what is left to do: to the same goal, from a scene as it is now. Throws ValueError for plans that planTask did
  /// not make.
  TaskPlan repair(const Config& C) const;

  std::string str() const;  ///< the status, actions, and causes
};

/// The branches as a tree: actions that several begin with stand once.
std::string treeText(const std::vector<TaskBranch>& branches);

}  // namespace kinegraph
