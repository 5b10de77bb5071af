#pragma once

#include "kinegraph/robot/robot_driver.h"

namespace kinegraph {

/// A robot that returns given states, one per period, and records its commands: for tests, and to replay the states of
/// a real robot.
class RecordedDriver final : public RobotDriver {
 public:
  /// `states` are returned in order; the last one repeats, with an increasing clock. Without states, the robot follows
  /// its commands exactly, from `start` on. Throws ValueError without states and start.
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
