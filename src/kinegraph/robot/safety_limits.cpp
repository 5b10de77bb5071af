#include "kinegraph/robot/safety_limits.h"

#include <algorithm>
#include <cmath>

namespace kinegraph::inline robot_internal {

namespace {

constexpr double kSlack = 1. + 1e-6;  // rounding, for motions that were checked before
constexpr double kLimitSlack = 2e-3;  // rad or m: checked motions may exceed a limit of position by half as much

}  // namespace

void limitCommand(RobotCommand& command, const VectorXd& last, const VectorXd& last_velocity, const RobotInfo& robot) {
  const double h = command.period;
  for (Eigen::Index i = 0; i < last.size(); ++i) {
    const double fastest = robot.velocity[i], hardest = robot.acceleration[i];
    const double target = std::clamp(command.q[i], std::min(robot.lower[i] - kLimitSlack, last[i]),
                                     std::max(robot.upper[i] + kLimitSlack, last[i]));
    const double mean = (target - last[i]) / h;
    const bool keeps_limits = target == command.q[i] && std::abs(mean) <= kSlack * fastest &&
                              std::abs(command.velocity[i]) <= kSlack * fastest &&
                              std::abs(command.velocity[i] - last_velocity[i]) <= kSlack * hardest * h;
    if (keeps_limits) continue;
    double velocity = std::clamp(mean, -fastest, fastest);
    if (std::isfinite(hardest)) {  // so that the joint can brake to the velocity of the reference when it arrives
      const double distance = target - last[i],
                   along = std::clamp(std::copysign(1., distance) * command.velocity[i], 0., fastest);
      const double stoppable = std::sqrt(along * along + 2. * hardest * std::abs(distance));
      velocity = std::clamp(velocity, -stoppable, stoppable);
      velocity = std::clamp(velocity, last_velocity[i] - hardest * h, last_velocity[i] + hardest * h);
    }
    command.q[i] = last[i] + h * velocity;
    command.velocity[i] = velocity;
    command.acceleration[i] = 0.;
  }
}

}  // namespace kinegraph::inline robot_internal
