#pragma once

#include "kinegraph/robot/robot_driver.h"

namespace kinegraph::inline robot_internal {

/// Keeps a command within a robot's limits of position, velocity and acceleration, given the last command. A joint that
/// would exceed a limit approaches its target as fast as the limits allow, and brakes in time. Other joints keep their
/// command to the bit.
void limitCommand(RobotCommand& command, const VectorXd& last, const VectorXd& last_velocity, const RobotInfo& robot);

}  // namespace kinegraph::inline robot_internal
