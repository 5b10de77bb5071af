#pragma once

#include "kinegraph/robot/robot_driver.h"

namespace kinegraph {

/// Keeps a command within the limits of a robot, given the last one: joints that would go too fast, change their velocity
/// too fast, or leave their limits go as near to where they should as they can, braking in time. Joints within all limits
/// are left as they are, to the bit.
void limitCommand(RobotCommand& command, const VectorXd& last, const VectorXd& last_velocity, const RobotInfo& robot);

}  // namespace kinegraph
