#pragma once

#include "kinegraph/robot/robot_driver.h"

namespace kinegraph {

/// A robot of which everything is known beforehand: what it will say, period after period. It notes what it is told. For
/// tests of whoever moves robots, and to see again what a real one did.
class RecordedDriver final : public RobotDriver {
 public:
  /// `readings` are given one after the other, then the last one for ever, its clock going on. Without any, the robot is
  /// where it was told to be, from `start` on. Throws ValueError if there is neither.
  RecordedDriver(RobotInfo info, std::vector<RobotState> states, const VectorXd& start = {});

  RobotInfo info() override { return info_; }
  RobotState read() override;
  void write(const RobotCommand& command) override { commands_.push_back(command); }
  void stop(const std::string& reason) override { stops_.push_back(reason); }
  void recover() override { ++recoveries_; }
  void moveGripper(const GripperCommand& command) override;
  void step(double period) override { time_ += period; }

  const std::vector<RobotCommand>& commands() const { return commands_; }
  const std::vector<GripperCommand>& gripperCommands() const { return gripper_commands_; }
  const std::vector<std::string>& stops() const { return stops_; }
  int recoveries() const { return recoveries_; }

 private:
  RobotInfo info_;
  std::vector<RobotState> states_;
  std::size_t next_ = 0;
  VectorXd start_;
  double time_ = 0.;
  std::vector<RobotCommand> commands_;
  std::vector<GripperCommand> gripper_commands_;
  std::vector<std::string> stops_;
  int recoveries_ = 0;
};

}  // namespace kinegraph
