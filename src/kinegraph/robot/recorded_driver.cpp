#include "kinegraph/robot/drivers.h"

namespace kinegraph {

RecordedDriver::RecordedDriver(RobotInfo info, std::vector<RobotState> states, const VectorXd& start)
    : info_(std::move(info)), states_(std::move(states)), start_(start) {
  if (states_.empty() && std::size_t(start_.size()) != info_.joints.size())
    throw ValueError("RecordedDriver: there are no states; expected states, or a start with one number per joint");
}

RobotState RecordedDriver::read() {
  if (next_ < states_.size()) return states_[next_++];
  RobotState state;
  if (!states_.empty()) {
    state = states_.back();
    state.time += time_;
    return state;
  }
  state.time = time_;
  state.q = commands_.empty() ? start_ : commands_.back().q;
  state.velocity = commands_.empty() ? VectorXd(VectorXd::Zero(start_.size())) : commands_.back().velocity;
  state.grippers.resize(info_.grippers.size());
  return state;
}

void RecordedDriver::moveGripper(const GripperCommand& command) {
  const bool is_there = command.gripper >= 0 && std::size_t(command.gripper) < info_.grippers.size();
  if (!is_there) return RobotDriver::moveGripper(command);
  gripper_commands_.push_back(command);
}

}  // namespace kinegraph
