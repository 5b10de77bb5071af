#pragma once

#include "kinegraph/robot/robot_driver.h"
#include "kinegraph/simulation/simulation.h"

namespace kinegraph::inline robot_internal {
struct SceneGripper;
}

namespace kinegraph {

/// A robot that follows its commands exactly, in a world without forces and contacts. An object that a gripper grasps
/// by name moves with the gripper.
class KinematicDriver final : public RobotDriver, private SimulatedWorld {
 public:
  /// Copies `config` as the world.
  explicit KinematicDriver(const Config& config);
  ~KinematicDriver() override;
  KinematicDriver(const KinematicDriver&) = delete;

  RobotInfo info() override;
  RobotState read() override;
  void write(const RobotCommand& command) override;
  void stop(const std::string& reason) override;
  void moveGripper(const GripperCommand& command) override;
  void step(double period) override;
  SimulatedWorld* world() override { return this; }

 private:
  struct Gripper;

  void updateConfig(Config& config) const override;
  const Config& config() const override { return config_; }
  void attach(const std::string& from, const std::string& to) override;
  void detach(const std::string& from, const std::string& to) override;
  void setFramePose(const std::string& frame, const Pose& pose) override;
  int addObjects(const Config& config) override;
  void moveFingers(Gripper& gripper, double period);

  Config config_;
  std::vector<Gripper> grippers_;
  VectorXd target_, target_velocity_, velocity_;
  double time_ = 0.;
};

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

/// A robot in a simulated world with masses, contacts and friction. A gripper holds objects by force.
class SimulatedDriver final : public RobotDriver, private SimulatedWorld {
 public:
  /// Copies `config` as the world. Throws ValueError if it cannot be simulated.
  explicit SimulatedDriver(const Config& config, const SimulationOptions& options = {});
  ~SimulatedDriver() override;

  RobotInfo info() override;
  RobotState read() override;
  void write(const RobotCommand& command) override { command_ = command; }
  void stop(const std::string& reason) override;
  void moveGripper(const GripperCommand& command) override;
  void step(double period) override;
  SimulatedWorld* world() override { return this; }

  const Simulation& simulation() const { return simulation_; }

 private:
  void updateConfig(Config& config) const override;
  const Config& config() const override { return config_; }
  void attach(const std::string& from, const std::string& to) override { simulation_.attach(from, to); }
  void detach(const std::string& from, const std::string& to) override { simulation_.detach(from, to); }
  void setFramePose(const std::string& frame, const Pose& pose) override;
  int addObjects(const Config& config) override;
  std::vector<Contact> contacts() const override { return simulation_.getContacts(); }
  void stepStiff(double period);
  void stepCompliant(double period);

  Config config_;
  Simulation simulation_;
  std::vector<SceneGripper> grippers_;
  RobotCommand command_;
};

}  // namespace kinegraph
