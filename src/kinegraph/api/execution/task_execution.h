#pragma once

#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "kinegraph/robot/bot_op.h"
#include "kinegraph/task_planning/search/task_plan.h"

namespace kinegraph {

/// The result of an execution.
struct TaskExecution {
  bool feasible = false;  ///< all actions were executed, and the goal holds
  std::string message;    ///< "" if feasible, else the reason for which the robot stopped
  int done = 0;           ///< the number of executed actions, of all plans
  int repairs = 0;        ///< the number of plans that were made on the way
  Config C;               ///< the final scene: held objects are attached to hands, standing objects to their places

  std::string str() const;
};
/// What happened in an execution.
enum class TaskEventKind {
  start,    ///< the robot is where the plan begins
  motion,   ///< the motion of an action is done
  grip,     ///< hands have closed or opened: an action is done
  failure,  ///< the world deviates from the plan, and the robot has stopped
  repair,   ///< there is a new plan
  end,      ///< the goal is reached, or the execution was given up
};

/// The enumerator's spelling: "motion".
std::string taskEventName(TaskEventKind kind);

/// A step of an execution that is done. The robot rests.
struct TaskEvent {
  TaskEventKind kind = TaskEventKind::start;
  int index = -1;       ///< of the action in the present plan; -1 for start, repair and end
  TaskAction action;    ///< its words
  std::string message;  ///< of `failure`: the reason; of `repair`: the actions; of `end`: the result

  std::string str() const;
};

/// Observed poses by the names of objects; none for an object that was not seen.
using ObservedPoses = std::map<std::string, std::optional<Pose>>;

/// Options of an execution.
struct ExecutionOptions {
  int repairs = 3;  ///< new plans, at most, if the world deviates from the plan

  /// Returns the poses of objects, as cameras see them, such as SceneObserver::observe does. It is given the believed
  /// scene of this moment, with objects in the hands that hold them. Cells that it attaches there, as
  /// OccupancyMap::attach does, become obstacles: the robot stops before a motion that would enter them, and new plans
  /// avoid them. Objects without a pose are taken to be where they were, or in the hand that holds them. Null: the
  /// poses of the simulated world.
  std::function<ObservedPoses(Config& scene)> observe = {};

  /// Called after each step; false ends the execution.
  std::function<bool(const TaskEvent&)> callback = {};

  /// Torque or force of contacts (N m, N) at a joint above which a motion stops; one number, or one per dof; empty:
  /// none.
  VectorXd max_external_effort = {};

  RepairOptions repair = {};  ///< limits of each search for a new plan
};

/// An execution of a plan on a robot, step by step; the robot rests between two steps.
///
///     TaskRun run(plan, bot, seen);
///     while (const auto event = run.next()) std::cout << event->str() << '\n';
///     if (!run.result().feasible) ...
///
/// First the robot moves to the start of the plan, collision-free. Motions follow the plan exactly (BotOp::follow), and
/// hands close and open after them. Before and after each motion and grip, the world is compared with the plan: held
/// objects have to be in the hand and pressed by its fingers, all others at their places, and the arm in its
/// configuration. During motions, held objects must not slip, and contacts must not exceed `max_external_effort`. After
/// a deviation the robot stops, opens hands that have lost their objects, backs out of collisions, and plans again from
/// there. Deviations, faults of the robot and missing plans are results, not exceptions.
class TaskRun {
 public:
  /// `seen` is a copy of the world of `bot` (worldOf), and is kept up to date; both have to outlive the run. Throws
  /// ValueError if the plan has no motion, an object that actions move has no mass, or a motor moves a door.
  TaskRun(const TaskPlan& plan, BotOp& bot, Config& seen, ExecutionOptions options = {});
  TaskRun(TaskRun&&) noexcept;
  ~TaskRun();

  /// Executes the next step; none after the end.
  std::optional<TaskEvent> next();

  /// Ends the execution: the robot holds, also during a motion. May be called from any thread, and from callbacks.
  void stop();

  const TaskExecution& result() const;  ///< complete after the event `end`
  const TaskPlan& plan() const;         ///< the present plan

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

/// Returns the simulated world of a robot; for a real robot, its scene with the
/// robot's q and the objects of the plan at their places. If cameras observe it, the scene of the plan: what the robot
/// believes.
Config worldOf(BotOp& bot, const TaskPlan& plan, bool is_observed = false);

/// Executes a plan on a robot, and makes new plans if the world deviates; see TaskRun.
TaskExecution execute(const TaskPlan& plan, BotOp& bot, Config& seen, const ExecutionOptions& options = {});

}  // namespace kinegraph
