#pragma once

#include "kinegraph/robot/scene_grippers.h"

namespace kinegraph {

/// A robot that is exactly where it is told to be, in a world where nothing else moves: no forces, no contacts. What a
/// gripper has grasped by name moves with it.
class KinematicDriver final : public RobotDriver, private SimulatedWorld {
 public:
  /// A world of its own, as `config` is now.
  explicit KinematicDriver(const Config& config);

  RobotInfo info() override;
  RobotState read() override;
  void write(const RobotCommand& command) override;
  void stop(const std::string& reason) override;
  void moveGripper(const GripperCommand& command) override;
  void step(double period) override;
  SimulatedWorld* world() override { return this; }

 private:
  struct Gripper {
    SceneGripper scene;
    GripperCommand command;
    double width = 0.;
    bool is_done = true;
    std::string held;  ///< the frame that is attached
  };

  void updateConfig(Config& config) const override { copyMotion(config_, config); }
  const Config& config() const override { return config_; }
  void attach(const std::string& from, const std::string& to) override;
  void detach(const std::string& from, const std::string& to) override;
  void setFramePose(const std::string& frame, const Pose& pose) override;
  int addObjects(const Config& config) override { return copyNewFrames(config, config_); }
  void moveFingers(Gripper& gripper, double period);

  Config config_;
  std::vector<Gripper> grippers_;
  VectorXd target_, target_velocity_, velocity_;
  double time_ = 0.;
};

}  // namespace kinegraph
