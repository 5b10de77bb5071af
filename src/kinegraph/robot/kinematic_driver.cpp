#include "kinegraph/robot/drivers.h"

#include <algorithm>
#include <cmath>

#include "kinegraph/robot/scene_grippers.h"

namespace kinegraph {

struct KinematicDriver::Gripper {
  SceneGripper scene;
  GripperCommand command;
  double width = 0.;
  bool is_done = true;
  std::string held;  ///< the attached frame
};

KinematicDriver::~KinematicDriver() = default;

void KinematicDriver::updateConfig(Config& config) const { copyMotion(config_, config); }

int KinematicDriver::addObjects(const Config& config) { return copyNewFrames(config, config_); }

KinematicDriver::KinematicDriver(const Config& config)
    : config_(config),
      target_(config_.getJointState()),
      target_velocity_(VectorXd::Zero(target_.size())),
      velocity_(target_velocity_) {
  for (const SceneGripper& found : findGrippers(config_)) {
    const double width = found.opening.widthAt(config_.getFrame(found.joint).getJointState()[0]);
    grippers_.push_back({found, {}, width, true, {}});
    grippers_.back().command.width = width;
  }
}

RobotInfo KinematicDriver::info() {
  RobotInfo info = RobotInfo::of(config_, "kinematic");
  info.compliant = true;  // without forces, stiffness has no effect
  for (const Gripper& gripper : grippers_) info.grippers.push_back(gripper.scene.info);
  return info;
}

RobotState KinematicDriver::read() {
  RobotState state;
  state.time = time_;
  state.q = config_.getJointState();
  state.velocity = velocity_;
  for (const Gripper& gripper : grippers_) state.grippers.push_back({gripper.width, gripper.is_done});
  return state;
}

void KinematicDriver::write(const RobotCommand& command) {
  const bool floats = !command.isStiff() && command.stiffness.isZero(0.);
  target_ = floats ? config_.getJointState() : command.q;
  target_velocity_ = floats ? VectorXd(VectorXd::Zero(target_.size())) : command.velocity;
}

void KinematicDriver::stop(const std::string&) {
  target_ = config_.getJointState();
  target_velocity_.setZero();
}

void KinematicDriver::step(double period) {
  config_.setJointState(target_);
  velocity_ = target_velocity_;
  for (Gripper& gripper : grippers_) moveFingers(gripper, period);
  time_ += period;
}

void KinematicDriver::moveGripper(const GripperCommand& command) {
  if (command.gripper < 0 || std::size_t(command.gripper) >= grippers_.size()) return RobotDriver::moveGripper(command);
  Gripper& gripper = grippers_[std::size_t(command.gripper)];
  if (!gripper.held.empty()) {  // each command first releases the object
    detach(gripper.scene.info.name, gripper.held);
    gripper.held.clear();
  }
  gripper.command = command;
  gripper.is_done = false;
}

/// Moves the fingers towards the commanded width. At that width they hold the object that the command names.
void KinematicDriver::moveFingers(Gripper& gripper, double period) {
  if (gripper.is_done) return;
  const double step = gripper.command.speed * period, left = gripper.command.width - gripper.width;
  gripper.is_done = std::abs(left) <= step;
  gripper.width = gripper.is_done ? gripper.command.width : gripper.width + std::copysign(step, left);
  config_.setJointState(VectorXd::Constant(1, gripper.scene.opening.positionAt(gripper.width)), {gripper.scene.joint});
  if (!gripper.is_done || !gripper.command.grasp || gripper.command.object.empty()) return;
  gripper.held = gripper.command.object;
  attach(gripper.scene.info.name, gripper.held);
}

void KinematicDriver::attach(const std::string& from, const std::string& to) { config_.attach(from, to); }

void KinematicDriver::detach(const std::string& from, const std::string& to) {
  config_.getFrame(from);
  const Frame head = headOfLink(config_.getFrame(to));
  if (head.getParent()) Frame(head).unLink();
}

void KinematicDriver::setFramePose(const std::string& frame, const Pose& pose) {
  config_.getFrame(frame).setPose(pose);
}

}  // namespace kinegraph
