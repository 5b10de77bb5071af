#pragma once

#include <map>
#include <set>

#include "kinegraph/simulation/simulation.h"
#include "kinegraph/simulation/world.h"

namespace kinegraph {

struct Simulation::Impl {
  Impl(const Config& source, SimulationEngine which, const SimulationOptions& chosen, bool for_batch = false);
  Impl(const Impl& other);  ///< of the same model

  std::unique_ptr<World> makeWorld();
  void readConfig(World& to) const;
  void writeConfig();

  /// Returns whether a shape has another pose in its body than in the model, such as a table that was moved.
  bool hasMovedShapes() const;

  /// Rebuilds the model from the present Config and transfers the state.
  void rebuild();

  VectorXd q() const;
  VectorXd qDot() const;
  void readPositions(Eigen::Ref<VectorXd> q) const;
  void readVelocities(Eigen::Ref<VectorXd> velocity) const;
  void requireSize(const Eigen::Ref<VectorXd>& numbers, const char* call) const;
  MatrixXd freePoses() const;
  MatrixXd freeVelocities() const;
  void setFreeVelocities(const MatrixXd& velocities);
  void resetSpline(double ctrl_time);
  void setJoints(const VectorXd& q, const VectorXd* velocity);

  /// Records a call that affects later steps.
  void record(Recording::Call::Kind kind, std::vector<double> numbers, std::vector<std::string> names = {});
  void recordState(const SimulationState& state);
  void recordPoses();
  void warnOfFastRotations();

  /// Returns the frame of that name, or its body. Throws FrameNotFound; `call` names the caller.
  const FrameData& frame(const std::string& name, const char* call) const;
  int body(const std::string& name, const char* call) const;
  std::size_t gripper(const std::string& name, const char* call) const;

  Config config;
  SimulationEngine engine;
  SimulationOptions options;
  bool can_change_frictions = false;
  std::vector<std::shared_ptr<FrameData>> force_frames, acceleration_frames;  ///< frames with a sensor
  std::unique_ptr<World> world;
  std::vector<std::shared_ptr<FrameData>> frames;  ///< of the model, by id
  std::uint64_t revision = 0;                      ///< of the scene's structure when the model was built
  std::map<std::string, Frame> cameras;
  std::string selected_camera;
  bool has_depth_noise = false;
  std::unique_ptr<CameraRenderer> renderer;
  std::unique_ptr<Recording> recording;
  std::shared_ptr<SimulationObserver> observer;
  std::vector<std::string> warnings;
  std::set<std::string> warned;
};

}  // namespace kinegraph
