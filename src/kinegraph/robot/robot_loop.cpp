#include "kinegraph/robot/robot_loop.h"

#include <algorithm>
#include <cmath>

#include "kinegraph/common/text.h"
#include "kinegraph/robot/safety_limits.h"

namespace kinegraph {

namespace {

void requireFit(const char* field, const VectorXd& numbers, std::size_t expected, bool may_be_empty) {
  if (may_be_empty && numbers.size() == 0) return;
  if (std::size_t(numbers.size()) != expected)
    throw RobotFault(cat("the robot's reading has a ", field, " of ", numbers.size(), " numbers; expected ", expected));
}

}  // namespace

RobotLoop::RobotLoop(std::shared_ptr<RobotDriver> driver, double period, const GuardLimits& guards)
    : driver_(std::move(driver)), guards_(guards) {
  if (!driver_) throw ValueError("RobotLoop: there is no driver");
  if (!(period > 0.) || !std::isfinite(period))
    throw ValueError(cat("RobotLoop: period is ", period, " s; expected more than 0"));
  log_.period = period;
  driver_->connect();
  info_ = driver_->info();
  info_.validate();
  look(driver_->read());
  if (!fault_.empty()) {
    driver_->disconnect();
    throw RobotFault(cat("robot '", info_.name, "' cannot be moved: ", fault_));
  }
  restAtState();
}

RobotLoop::~RobotLoop() {
  try {
    driver_->disconnect();
  } catch (const std::exception&) {  // nobody is left who could be told
  }
}

void RobotLoop::step() {
  ++log_.ticks;
  try {
    if (mode_ != LoopMode::fault) driver_->write(nextCommand());
    driver_->step(period());
    look(driver_->read());
  } catch (const Error& error) {
    stop(error.what());
  }
}

MatrixXd RobotLoop::reference(double time) const {
  if (mode_ == LoopMode::follow || mode_ == LoopMode::hold) return motion_.eval3(time);
  MatrixXd still = MatrixXd::Zero(3, state_.q.size());
  still.row(0) = state_.q.transpose();
  return still;
}

RobotCommand RobotLoop::nextCommand() {
  const MatrixXd wanted = reference(time());
  RobotCommand command{period(), wanted.row(0).transpose(), wanted.row(1).transpose(), wanted.row(2).transpose(), {}};
  if (mode_ == LoopMode::floating) {
    command.stiffness = MatrixXd::Zero(command.q.size(), command.q.size());
    command.damping = floating_damping_;
  } else {
    command.stiffness = stiffness_;
    limitCommand(command, commanded_, commanded_velocity_, info_);
  }
  commanded_ = command.q;
  commanded_velocity_ = command.velocity;
  return command;
}

void RobotLoop::look(const RobotState& state) {
  const std::size_t n = info_.joints.size();
  requireFit("q", state.q, n, false);
  requireFit("velocity", state.velocity, n, false);
  requireFit("effort", state.effort, n, true);
  requireFit("external_effort", state.external_effort, n, true);
  still_ = state.time > state_.time || log_.ticks == 0 ? 0. : still_ + period();
  std::string wrong = state.error;
  if (!state.q.allFinite() || !state.velocity.allFinite()) {
    wrong = "its reading has numbers that are not finite";
  } else {
    state_ = state;
    if (wrong.empty() && still_ > guards_.stale_time) wrong = cat("its clock has stood still for ", still_, " s");
    if (wrong.empty()) wrong = heldUp();
  }
  if (!wrong.empty()) stop(wrong);
}

/// Which joint is far from where it was told to be; empty if none is, or if the robot may give way.
std::string RobotLoop::heldUp() const {
  if (mode_ == LoopMode::floating || mode_ == LoopMode::fault || stiffness_.size() > 0) return {};
  for (Eigen::Index i = 0; i < commanded_.size(); ++i) {
    const double behind = std::abs(commanded_[i] - state_.q[i]);
    if (behind > guards_.follow_distance)
      return cat("joint '", info_.joints[std::size_t(i)], "' is ", behind,
                 " from where it shall be; is something in its way?");
  }
  return {};
}

void RobotLoop::stop(const std::string& reason) {
  if (mode_ == LoopMode::fault) return;
  mode_ = LoopMode::fault;
  fault_ = reason.empty() ? "it was stopped" : reason;
  try {
    driver_->stop(fault_);
  } catch (const Error& error) {
    fault_ += cat("; and stopping it failed: ", error.what());
  }
}

void RobotLoop::restAtState() {
  const double now = time();
  commanded_ = state_.q;
  commanded_velocity_ = VectorXd::Zero(state_.q.size());
  MatrixXd still(2, state_.q.size());
  still.rowwise() = state_.q.transpose();
  VectorXd times(2);
  times << now, now + period();
  motion_.set(1, still, times);
}

BSpline RobotLoop::braking(double most) const {
  const double now = time();
  const MatrixXd here = reference(now);
  const VectorXd q = here.row(0).transpose(), velocity = here.row(1).transpose();
  // The velocity falls to zero along a parabola: by at most 2 v / T at once, and q goes on by v T / 3.
  double duration = most;
  for (Eigen::Index i = 0; i < q.size(); ++i)
    duration = std::max(duration, 2. * std::abs(velocity[i]) / info_.acceleration[i]);
  const VectorXd end =
      (q + duration / 3. * velocity).cwiseMax(info_.lower.cwiseMin(q)).cwiseMin(info_.upper.cwiseMax(q));
  VectorXd times(2);
  times << now, now + duration;
  MatrixXd points(2, q.size());
  points << q.transpose(), end.transpose();
  return BSpline(3, points, times, velocity);
}

void RobotLoop::requireReady(const char* call, const VectorXd& reference) const {
  if (mode_ == LoopMode::fault)
    throw RobotFault(cat(call, ": the robot was stopped: ", fault_, "; call recover() when that is mended"));
  for (Eigen::Index i = 0; i < reference.size(); ++i) {
    const double apart = std::abs(reference[i] - state_.q[i]);
    if (apart <= guards_.engage_distance || mode_ == LoopMode::floating) continue;
    throw RobotFault(cat(call, ": joint '", info_.joints[std::size_t(i)], "' is at ", state_.q[i], ", ", apart,
                         " from where the motion begins; call hold() first, to begin where the robot is"));
  }
}

void RobotLoop::apply(const LoopCommand& command) {
  std::visit([&](const auto& c) { applyNow(c); }, command);
  log_.entries.push_back({log_.ticks, command});
}

void RobotLoop::requireMotion(const BSpline& motion) const {
  if (motion.isEmpty() || motion.dimension() != state_.q.size())
    throw ValueError(cat("RobotLoop: a motion of ", motion.dimension(), " numbers; expected ", state_.q.size()));
}

void RobotLoop::applyNow(const FollowSpline& command) {
  requireMotion(command.motion);
  if (mode_ == LoopMode::fault) requireReady("RobotLoop", {});
  if (mode_ == LoopMode::floating) restAtState();
  mode_ = LoopMode::follow;
  motion_ = command.motion;
}

void RobotLoop::applyNow(const HoldRobot& command) {
  requireMotion(command.motion);
  if (mode_ == LoopMode::fault) return;
  if (mode_ == LoopMode::floating) restAtState();
  mode_ = LoopMode::hold;
  motion_ = command.motion;
  stiffness_.resize(0, 0);
}

void RobotLoop::applyNow(const FloatRobot& command) {
  if (!info_.compliant) throw RobotFault(cat("robot '", info_.name, "' cannot float: it is always stiff"));
  if (mode_ == LoopMode::fault) requireReady("RobotLoop", {});
  mode_ = LoopMode::floating;
  floating_damping_ = command.damping;
}

void RobotLoop::applyNow(const SetStiffness& command) {
  const Eigen::Index n = state_.q.size();
  const bool fits = command.stiffness.size() == 0 || (command.stiffness.rows() == n && command.stiffness.cols() == n);
  if (!fits) throw ValueError(cat("RobotLoop: a stiffness of ", command.stiffness.rows(), " rows; expected ", n));
  if (command.stiffness.size() > 0 && !info_.compliant)
    throw RobotFault(cat("robot '", info_.name, "' cannot be compliant: it is always stiff"));
  stiffness_ = command.stiffness;
}

void RobotLoop::applyNow(const GripperCommand& command) {
  driver_->moveGripper(command);
  if (const auto i = std::size_t(command.gripper); i < state_.grippers.size()) state_.grippers[i].is_done = false;
}

SimulatedWorld& RobotLoop::world(const char* call) {
  SimulatedWorld* world = driver_->world();
  if (!world) throw RobotFault(cat(call, ": robot '", info_.name, "' is not simulated"));
  return *world;
}

void RobotLoop::applyNow(const AttachFrames& command) {
  if (command.attach) {
    world("attach").attach(command.from, command.to);
  } else {
    world("detach").detach(command.from, command.to);
  }
}

void RobotLoop::applyNow(const PlaceFrame& command) { world("setFramePose").setFramePose(command.frame, command.pose); }

void RobotLoop::applyNow(const RecoverRobot&) {
  driver_->recover();
  mode_ = LoopMode::hold;
  fault_.clear();
  still_ = 0.;
  stiffness_.resize(0, 0);
  look(driver_->read());
  if (mode_ != LoopMode::fault) restAtState();
}

}  // namespace kinegraph
