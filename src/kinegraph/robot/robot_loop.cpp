#include "kinegraph/robot/robot_loop.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "kinegraph/common/text.h"
#include "kinegraph/robot/robot_joint.h"
#include "kinegraph/robot/safety_limits.h"
#include "kinegraph/scene/tree/scene_tree.h"

namespace kinegraph::inline robot_internal {

namespace {

void requireFit(const char* field, const VectorXd& numbers, std::size_t expected, bool may_be_empty) {
  if (may_be_empty && numbers.size() == 0) return;
  if (std::size_t(numbers.size()) != expected)
    throw RobotFault(cat("the robot's state has a ", field, " of ", numbers.size(), " numbers; expected ", expected));
}

/// Returns whether a joint of the robot moves a frame.
bool isOnRobot(const SceneTree& scene, const std::string& name) {
  const FrameData* frame = scene.find(name);
  while (frame && !isRobotJoint(*frame)) frame = frame->parent;
  return frame;
}

/// Names the pair of shapes, one of them on the robot, that press on each other the most in a simulated world; empty
/// if none do.
std::string strongestContact(RobotDriver& driver) {
  constexpr double kLeastForce = .5;  // N: less is rounded to none
  const SimulatedWorld* world = driver.world();
  if (!world) return {};
  std::vector<Contact> contacts = world->contacts();
  const SceneTree& scene = *world->config().scene();
  std::erase_if(contacts, [&](const Contact& c) {
    return c.force.norm() < kLeastForce || !(isOnRobot(scene, c.frame_a) || isOnRobot(scene, c.frame_b));
  });
  const auto weaker = [](const Contact& a, const Contact& b) { return a.force.norm() < b.force.norm(); };
  const auto most = std::ranges::max_element(contacts, weaker);
  if (most == contacts.end()) return {};
  const bool on_ground = most->frame_a == "ground" || most->frame_b == "ground";
  return cat(" '", most->frame_a, "' and '", most->frame_b, "' press on each other with ",
             std::round(most->force.norm()), " N",
             on_ground ? "; the ground is the plane at z = 0 of simulations" : "");
}

}  // namespace

RobotLoop::RobotLoop(std::shared_ptr<RobotDriver> driver, double period, const SafetyLimits& safety)
    : driver_(std::move(driver)), safety_(safety) {
  if (!driver_) throw ValueError("RobotLoop: there is no driver");
  if (!(period > 0.) || !std::isfinite(period))
    throw ValueError(cat("RobotLoop: the control period is ", period, " s; expected a number above 0"));
  log_.period = period;
  driver_->connect();
  info_ = driver_->info();
  info_.validate();
  accept(driver_->read());
  if (!fault_.empty()) {
    driver_->disconnect();
    throw RobotFault(cat("robot '", info_.name, "' cannot move: ", fault_));
  }
  restAtState();
}

RobotLoop::~RobotLoop() {
  try {
    driver_->disconnect();
  } catch (const std::exception&) {  // a destructor reports no errors
  }
}

void RobotLoop::step() {
  ++log_.ticks;
  try {
    if (mode_ != LoopMode::fault) driver_->write(nextCommand());
    driver_->step(period());
    accept(driver_->read());
  } catch (const Error& error) {
    stop(error.what());
  }
}

MatrixXd RobotLoop::reference(double time) const {
  if (mode_ == LoopMode::follow || mode_ == LoopMode::hold) return motion_.eval(time);
  MatrixXd still = MatrixXd::Zero(3, state_.q.size());
  still.row(0) = state_.q.transpose();
  return still;
}

RobotCommand RobotLoop::nextCommand() {
  const MatrixXd target = reference(time());
  RobotCommand command{period(), target.row(0).transpose(), target.row(1).transpose(), target.row(2).transpose(), {}};
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

void RobotLoop::accept(const RobotState& state) {
  const std::size_t n = info_.joints.size();
  requireFit("q", state.q, n, false);
  requireFit("velocity", state.velocity, n, false);
  requireFit("effort", state.effort, n, true);
  requireFit("external_effort", state.external_effort, n, true);
  clock_pause_ = state.time > state_.time || log_.ticks == 0 ? 0. : clock_pause_ + period();
  std::string error = state.error;
  if (!state.q.allFinite() || !state.velocity.allFinite()) {
    error = "its state has numbers that are not finite";
  } else {
    state_ = state;
    if (error.empty() && clock_pause_ > safety_.clock_timeout)
      error = cat("its clock has stood still for ", clock_pause_, " s");
    const std::string lag = error.empty() ? trackingFault() : "";
    if (!lag.empty() && safety_.lag_stops) {
      error = lag + strongestContact(*driver_);
    } else if (!lag.empty() && !lags_) {
      warn(lag + strongestContact(*driver_));
    }
    lags_ = !lag.empty();
  }
  if (!error.empty()) stop(error);
}

/// Describes the joint that is too far from its command; empty if none is, or if the robot is compliant.
std::string RobotLoop::trackingFault() const {
  if (mode_ == LoopMode::floating || mode_ == LoopMode::fault || stiffness_.size() > 0) return {};
  for (Eigen::Index i = 0; i < commanded_.size(); ++i) {
    const double distance = std::abs(commanded_[i] - state_.q[i]);
    if (distance <= safety_.tracking_distance) continue;
    const std::string& name = info_.joints[std::size_t(i)];
    const bool is_part = name.find(':') != std::string::npos;  // of a joint with several dofs
    return cat("joint '", name, "' is ", distance, " from its command; does an obstacle block it",
               is_part ? ", or is it the free joint of a base or an object, which no motor moves?" : "?");
  }
  return {};
}

void RobotLoop::stop(const std::string& reason) {
  if (mode_ == LoopMode::fault) return;
  mode_ = LoopMode::fault;
  fault_ = reason.empty() ? "it was stopped without a reason" : reason;
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
  motion_.add(BSpline(1, still, times), -std::numeric_limits<double>::infinity(), now);
}

BSpline RobotLoop::stoppingSegment(double time, const MatrixXd& reference, double duration) const {
  const VectorXd q = reference.row(0).transpose(), velocity = reference.row(1).transpose();
  // The velocity falls to zero along a parabola: the deceleration is at most 2 v / T, and q moves on by v T / 3.
  for (Eigen::Index i = 0; i < q.size(); ++i)
    duration = std::max(duration, 2. * std::abs(velocity[i]) / info_.acceleration[i]);
  const VectorXd end =
      (q + duration / 3. * velocity).cwiseMax(info_.lower.cwiseMin(q)).cwiseMin(info_.upper.cwiseMax(q));
  VectorXd times(2);
  times << time, time + duration;
  MatrixXd points(2, q.size());
  points << q.transpose(), end.transpose();
  return BSpline(3, points, times, velocity);
}

void RobotLoop::requireReady(const char* call, const VectorXd& q) const {
  if (mode_ == LoopMode::fault)
    throw RobotFault(cat(call, ": the robot was stopped: ", fault_, "; resolve the cause, then call recover()"));
  for (Eigen::Index i = 0; i < q.size(); ++i) {
    const double distance = std::abs(q[i] - state_.q[i]);
    if (distance <= safety_.start_distance || mode_ == LoopMode::floating || !safety_.lag_stops) continue;
    throw RobotFault(cat(call, ": joint '", info_.joints[std::size_t(i)], "' is at ", state_.q[i], ", ", distance,
                         " from the start of the motion; call hold() first, so that the motion starts at the robot"));
  }
}

void RobotLoop::apply(const LoopCommand& command) {
  std::visit([&](const auto& c) { execute(c); }, command);
  log_.entries.push_back({log_.ticks, command});
}

void RobotLoop::requireDimension(int dimension) const {
  if (dimension != int(state_.q.size()))
    throw ValueError(cat("RobotLoop: a motion has ", dimension, " dofs; the robot has ", state_.q.size(), " joints"));
}

void RobotLoop::startFollowing() {
  if (mode_ == LoopMode::fault) requireReady("RobotLoop", {});
  if (mode_ == LoopMode::floating) restAtState();
  mode_ = LoopMode::follow;
}

void RobotLoop::execute(const FollowSpline& command) {
  requireDimension(command.motion.dimension());
  startFollowing();
  motion_.add(command.motion, command.begin, time());
}

void RobotLoop::execute(const FollowTrajectory& command) {
  if (!command.motion) throw ValueError("RobotLoop: the command to follow has no trajectory");
  requireDimension(command.motion->dimension());
  startFollowing();
  motion_.add(command.motion, command.begin, time(), period());
}

void RobotLoop::execute(const HoldRobot& command) {
  requireDimension(command.motion.dimension());
  if (mode_ == LoopMode::fault) return;
  if (mode_ == LoopMode::floating) restAtState();
  mode_ = LoopMode::hold;
  motion_.add(command.motion, -std::numeric_limits<double>::infinity(), time());
  stiffness_.resize(0, 0);
}

void RobotLoop::execute(const FloatRobot& command) {
  if (!info_.compliant) throw RobotFault(cat("robot '", info_.name, "' cannot float: its stiffness is fixed"));
  if (mode_ == LoopMode::fault) requireReady("RobotLoop", {});
  mode_ = LoopMode::floating;
  floating_damping_ = command.damping;
}

void RobotLoop::execute(const SetStiffness& command) {
  const Eigen::Index n = state_.q.size();
  const bool fits = command.stiffness.size() == 0 || (command.stiffness.rows() == n && command.stiffness.cols() == n);
  if (!fits)
    throw ValueError(cat("RobotLoop: the stiffness has shape (", command.stiffness.rows(), ", ",
                         command.stiffness.cols(), "); expected (", n, ", ", n, ")"));
  if (command.stiffness.size() > 0 && !info_.compliant)
    throw RobotFault(cat("robot '", info_.name, "' cannot be compliant: its stiffness is fixed"));
  stiffness_ = command.stiffness;
}

void RobotLoop::execute(const GripperCommand& command) {
  driver_->moveGripper(command);
  if (const auto i = std::size_t(command.gripper); i < state_.grippers.size()) state_.grippers[i].is_done = false;
}

SimulatedWorld& RobotLoop::world(const char* call) {
  SimulatedWorld* world = driver_->world();
  if (!world) throw RobotFault(cat(call, ": robot '", info_.name, "' is not simulated"));
  return *world;
}

void RobotLoop::execute(const AttachFrames& command) {
  if (command.attach) {
    world("attach").attach(command.from, command.to);
  } else {
    world("detach").detach(command.from, command.to);
  }
}

void RobotLoop::execute(const PlaceFrame& command) { world("setFramePose").setFramePose(command.frame, command.pose); }

void RobotLoop::execute(const RecoverRobot&) {
  driver_->recover();
  mode_ = LoopMode::hold;
  fault_.clear();
  clock_pause_ = 0.;
  stiffness_.resize(0, 0);
  const RobotState state = driver_->read();
  commanded_ = state.q;  // the distance to the last command caused the fault
  accept(state);
  if (mode_ != LoopMode::fault) restAtState();
}

}  // namespace kinegraph::inline robot_internal
