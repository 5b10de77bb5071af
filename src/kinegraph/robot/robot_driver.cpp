#include "kinegraph/robot/robot_driver.h"

#include <limits>

#include "kinegraph/common/text.h"
#include "kinegraph/scene/dynamics.h"

namespace kinegraph {

RobotInfo RobotInfo::of(const Config& config, std::string name) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  RobotInfo info;
  info.name = std::move(name);
  info.joints = config.getJointNames();
  const MatrixXd limits = config.getJointLimits();
  info.lower = limits.row(0), info.upper = limits.row(1);
  info.velocity = getVelocityLimits(config);
  info.effort = getEffortLimits(config);
  info.acceleration = VectorXd::Constant(info.velocity.size(), kInfinity);
  return info;
}

void RobotInfo::validate() const {
  const auto n = Eigen::Index(joints.size());
  const auto fits = [&](const char* field, const VectorXd& numbers, bool positive) {
    if (numbers.size() != n)
      throw ValueError(cat("RobotInfo of '", name, "': ", field, " has ", numbers.size(), " numbers; expected ", n,
                           ", one per joint"));
    for (Eigen::Index i = 0; i < n; ++i) {
      if (std::isnan(numbers[i]) || (positive && !(numbers[i] > 0.)))
        throw ValueError(cat("RobotInfo of '", name, "': ", field, "[", i, "] is ", numbers[i], "; expected ",
                             positive ? "a number above 0" : "a number"));
    }
  };
  fits("lower", lower, false);
  fits("upper", upper, false);
  fits("velocity", velocity, true);
  fits("acceleration", acceleration, true);
  fits("effort", effort, true);
  if (!(rate > 0.))
    throw ValueError(cat("RobotInfo of '", name, "': rate is ", rate, " Hz; expected a number above 0"));
  for (const GripperInfo& gripper : grippers) {
    if (!(gripper.min_width <= gripper.max_width) || !(gripper.max_speed > 0.) || !(gripper.max_force > 0.))
      throw ValueError(cat("RobotInfo of '", name, "': gripper '", gripper.name,
                           "': expected min_width <= max_width, and max_speed and max_force above 0"));
  }
}

void RobotDriver::moveGripper(const GripperCommand& command) {
  throw RobotFault(cat("robot '", info().name, "' has no gripper ", command.gripper));
}

}  // namespace kinegraph
