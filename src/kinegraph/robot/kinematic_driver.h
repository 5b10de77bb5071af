#pragma once

#include "kinegraph/robot/robot_driver.h"

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

}  // namespace kinegraph
