#include "kinegraph/robot/safety_limits.h"

#include <algorithm>
#include <cmath>

namespace kinegraph {

namespace {

constexpr double kSlack = 1. + 1e-6;  // of what a motion that was checked asks between two periods
constexpr double kLimitSlack = 2e-3;  // rad or m beyond a limit that checked motions may go

}  // namespace

void limitCommand(RobotCommand& command, const VectorXd& last, const VectorXd& last_velocity, const RobotInfo& robot) {
  const double h = command.period;
  for (Eigen::Index i = 0; i < last.size(); ++i) {
    const double fastest = robot.velocity[i], hardest = robot.acceleration[i];
    const double target = std::clamp(command.q[i], std::min(robot.lower[i] - kLimitSlack, last[i]),
                                     std::max(robot.upper[i] + kLimitSlack, last[i]));
    const double mean = (target - last[i]) / h;
    const bool is_free = target == command.q[i] && std::abs(mean) <= kSlack * fastest &&
                         std::abs(command.velocity[i]) <= kSlack * fastest &&
                         std::abs(command.velocity[i] - last_velocity[i]) <= kSlack * hardest * h;
    if (is_free) continue;
    double velocity = std::clamp(mean, -fastest, fastest);
    if (std::isfinite(hardest)) {  // at the reference it must not be faster than that is
      const double way = target - last[i],
                   along = std::clamp(std::copysign(1., way) * command.velocity[i], 0., fastest);
      const double stoppable = std::sqrt(along * along + 2. * hardest * std::abs(way));
      velocity = std::clamp(velocity, -stoppable, stoppable);
      velocity = std::clamp(velocity, last_velocity[i] - hardest * h, last_velocity[i] + hardest * h);
    }
    command.q[i] = last[i] + h * velocity;
    command.velocity[i] = velocity;
    command.acceleration[i] = 0.;
  }
}

}  // namespace kinegraph
