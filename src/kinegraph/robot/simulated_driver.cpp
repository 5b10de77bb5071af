#include "kinegraph/robot/drivers.h"

#include <cmath>

#include "kinegraph/robot/scene_grippers.h"

namespace kinegraph {

namespace {

/// Natural frequency (rad/s) of a compliant robot in its stiff directions. Torques that are constant over an inner step
/// are stable far beyond it; a lower stiffness gives smaller contact forces.
constexpr double kCompliantFrequency = 30.;

}  // namespace

SimulatedDriver::SimulatedDriver(const Config& config, const SimulationOptions& options)
    : config_(config), simulation_(config_, SimulationEngine::physx, options), grippers_(findGrippers(config_)) {
  stop("");
}

SimulatedDriver::~SimulatedDriver() = default;

void SimulatedDriver::updateConfig(Config& config) const { copyMotion(config_, config); }

int SimulatedDriver::addObjects(const Config& config) { return copyNewFrames(config, config_); }

RobotInfo SimulatedDriver::info() {
  RobotInfo info = RobotInfo::of(config_, "simulated");
  info.compliant = true;
  for (const SceneGripper& gripper : grippers_) info.grippers.push_back(gripper.info);
  return info;
}

RobotState SimulatedDriver::read() {
  RobotState state{simulation_.get_t(),
                   simulation_.get_q(),
                   simulation_.get_qDot(),
                   simulation_.getJointTorques(),
                   simulation_.getExternalTorques(),
                   {},
                   {}};
  for (const SceneGripper& gripper : grippers_)
    state.grippers.push_back(
        {simulation_.getGripperWidth(gripper.info.name), simulation_.gripperIsDone(gripper.info.name)});
  return state;
}

void SimulatedDriver::stop(const std::string&) {
  command_ = RobotCommand();
  command_.q = simulation_.get_q();
  command_.velocity = command_.acceleration = VectorXd::Zero(command_.q.size());
}

void SimulatedDriver::moveGripper(const GripperCommand& command) {
  if (command.gripper < 0 || std::size_t(command.gripper) >= grippers_.size()) return RobotDriver::moveGripper(command);
  const SceneGripper& gripper = grippers_[std::size_t(command.gripper)];
  const double of_finger = .5 * command.speed;
  if (command.grasp) {
    simulation_.closeGripper(gripper.info.name, gripper.info.min_width, of_finger, command.force);
  } else {
    simulation_.moveGripper(gripper.info.name, command.width, of_finger);
  }
}

void SimulatedDriver::step(double period) {
  if (command_.isStiff()) {
    stepStiff(period);
  } else {
    stepCompliant(period);
  }
}

void SimulatedDriver::stepStiff(double period) {
  VectorXd reference(2 * command_.q.size());
  reference << command_.q, command_.velocity;
  simulation_.step(reference, period, ControlMode::positionVelocity);
}

/// Applies the torques of springs and dampers, scaled by the mass matrix so that all stiff directions have the same
/// natural frequency, computed in each inner step.
void SimulatedDriver::stepCompliant(double period) {
  const Eigen::Index n = command_.q.size();
  const double w = kCompliantFrequency;
  const double armature = simulation_.options().armature;
  const int parts = std::max(1, int(std::ceil(period / simulation_.options().inner_step - 1e-9)));
  const bool floats = command_.stiffness.isZero(0.);
  for (int i = 0; i < parts; ++i) {
    const VectorXd velocity = simulation_.get_qDot();
    MatrixXd mass = config_.equationOfMotion(VectorXd::Zero(n)).M;
    mass.diagonal().array() += armature;
    VectorXd acceleration = 2. * w * (floats ? command_.damping : 1.) * (command_.velocity - velocity);
    if (!floats) {
      const VectorXd spring = w * w * (command_.q - simulation_.get_q());
      acceleration = command_.stiffness * (spring + acceleration) + command_.acceleration;
    }
    simulation_.step(mass * acceleration, period / parts, ControlMode::torque);
  }
}

void SimulatedDriver::setFramePose(const std::string& frame, const Pose& pose) {
  const std::vector<Frame> free = simulation_.getFreeFrames();
  for (std::size_t i = 0; i < free.size(); ++i) {  // motors and grippers keep their references
    if (free[i].getName() != frame) continue;
    SimulationState state = simulation_.getState();
    state.freePos.row(Eigen::Index(i)) << pose.p.transpose(), wxyz(pose.q).transpose();
    simulation_.setState(state);
    return;
  }
  const MatrixXd velocities = simulation_.get_frameVelocities();
  const VectorXd joint_velocities = simulation_.get_qDot();
  config_.getFrame(frame).setPose(pose);
  simulation_.pushConfigToSim(velocities, joint_velocities);
}

}  // namespace kinegraph
