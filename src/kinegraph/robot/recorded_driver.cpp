#include "kinegraph/robot/recorded_driver.h"

namespace kinegraph {

RecordedDriver::RecordedDriver(RobotInfo info, std::vector<RobotReading> readings, const VectorXd& start)
    : info_(std::move(info)), readings_(std::move(readings)), start_(start) {
  if (readings_.empty() && std::size_t(start_.size()) != info_.joints.size())
    throw ValueError("RecordedDriver: expected readings, or a start with a number per joint");
}

RobotReading RecordedDriver::read() {
  if (next_ < readings_.size()) return readings_[next_++];
  RobotReading reading;
  if (!readings_.empty()) {
    reading = readings_.back();
    reading.time += time_;
    return reading;
  }
  reading.time = time_;
  reading.q = commands_.empty() ? start_ : commands_.back().q;
  reading.velocity = commands_.empty() ? VectorXd(VectorXd::Zero(start_.size())) : commands_.back().velocity;
  reading.grippers.resize(info_.grippers.size());
  return reading;
}

void RecordedDriver::moveGripper(const GripperCommand& command) {
  const bool is_there = command.gripper >= 0 && std::size_t(command.gripper) < info_.grippers.size();
  if (!is_there) return RobotDriver::moveGripper(command);
  gripper_commands_.push_back(command);
}

}  // namespace kinegraph
