#pragma once

#include "kinegraph/robot/robot_driver.h"
#include "kinegraph/simulation/simulation.h"

namespace kinegraph {

struct SceneGripper;

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
