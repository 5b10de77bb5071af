#pragma once

#include <string>

#include "kinegraph/robot/bot_op.h"
#include "kinegraph/task_planning/search/task_plan.h"

namespace kinegraph {

/// How far a robot came with a plan.
struct TaskExecution {
  bool feasible = false;  ///< all actions were carried out, and what the goal says stands where it says
  std::string message;    ///< why it stopped
  int done = 0;           ///< the number of actions that were carried out
  Config C;  ///< the scene as it is then: what is held hangs below the hand, what stands on something below that

  std::string str() const;
};

/// Moves a robot along a plan, action by action: grippers take and release, and after each motion it is looked at
/// whether what is held is in the hand, and whether all else is where the plan has it. The world of `bot` is the scene
/// of the plan; what is moved needs a mass there. `seen` is a copy of that world (BotOp::getWorld), in which it goes
/// on. Throws ValueError where there is no motion or the robot cannot begin it, RobotFault if it was stopped.
TaskExecution execute(const TaskPlan& plan, BotOp& bot, Config& seen);

}  // namespace kinegraph
