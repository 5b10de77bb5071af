#pragma once

#include <string>

#include "kinegraph/robot/bot_op.h"
#include "kinegraph/task_planning/search/task_plan.h"

namespace kinegraph {

/// The result of an execution.
struct TaskExecution {
  bool feasible = false;  ///< all actions were executed, and the goal holds
  std::string message;    ///< "" if feasible, else the reason for which the robot stopped
  int done = 0;           ///< the number of executed actions
  Config C;               ///< the final scene: held objects are attached to hands, standing objects to their places

  std::string str() const;
};

/// Executes a plan on a robot, action by action. Grippers close and open. Before and after each motion, the world is
/// compared with the plan: held objects have to be in the hand, all others at their places. The world of `bot` is the
/// scene of the plan; objects that actions move need a mass there. `seen` is a copy of that world (BotOp::getWorld),
/// and is kept up to date. Throws ValueError if there is no motion or the robot cannot begin it, RobotFault if the
/// robot was stopped.
TaskExecution execute(const TaskPlan& plan, BotOp& bot, Config& seen);

}  // namespace kinegraph
