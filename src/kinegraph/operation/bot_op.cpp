#include "kinegraph/operation/bot_op.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>

#include "kinegraph/base/text.h"
#include "kinegraph/spline/spline_part.h"

namespace kinegraph {

namespace {

constexpr double kShortest = .1;  // s, that moveTo takes

VectorXd evenTimes(const char* call, const VectorXd& times, Eigen::Index count) {
  if (times.size() == count && count != 1) return times;
  if (times.size() != 1)
    throw ValueError(
        cat(call, ": ", count, " points and ", times.size(), " times; expected one time per point, or one"));
  if (!(times[0] > 0.) || !std::isfinite(times[0]))
    throw ValueError(cat(call, ": the time is ", times[0], "; expected more than 0"));
  return VectorXd::LinSpaced(count, times[0] / double(count), times[0]);
}

void requirePath(const char* call, const MatrixXd& path, Eigen::Index n) {
  if (path.rows() == 0) throw ValueError(cat(call, ": the path has no points"));
  if (path.cols() != n)
    throw ValueError(cat(call, ": points of ", path.cols(), " numbers; the robot has ", n, " joints"));
  if (!path.allFinite()) throw ValueError(cat(call, ": the path has numbers that are not finite"));
}

MatrixXd asRow(const VectorXd& q) { return q.transpose(); }
VectorXd asVector(double number) { return VectorXd::Constant(1, number); }

}  // namespace

BotOp::BotOp(const Config& config, std::shared_ptr<RobotDriver> driver, BotOpOptions options)
    : options_(std::move(options)), model_(config), home_(config.getJointState()) {
  asked_.fill(-1);
  if (home_.size() == 0) throw ValueError("BotOp: the configuration has no joints that are active; expected a robot");
  const bool is_simulated = driver && driver->world();
  loop_ = std::make_unique<RobotLoop>(std::move(driver), options_.period, options_.guards);
  const std::size_t joints = loop_->info().joints.size();
  if (joints != std::size_t(home_.size()))
    throw ValueError(cat("BotOp: robot '", loop_->info().name, "' has ", joints, " joints; the configuration has ",
                         home_.size(), ": ", join(config.getJointNames())));
  if (options_.realtime && !is_simulated) options_.hyper_speed = 1.;
  if (options_.realtime && !(options_.hyper_speed > 0.)) options_.realtime = false;  // as fast as it can
  if (options_.realtime) thread_ = std::jthread([this](const std::stop_token& stop) { runThread(stop); });
}

BotOp::~BotOp() {
  thread_.request_stop();
  if (thread_.joinable()) thread_.join();
}

// --- state ---------------------------------------------------------------------------------------------------------------

double BotOp::get_t() {
  ask(askTime);
  const Lock lock(mutex_);
  return loop_->time();
}

VectorXd BotOp::get_q() {
  ask(askQ);
  const Lock lock(mutex_);
  return loop_->reading().q;
}

VectorXd BotOp::get_qDot() {
  ask(askVelocity);
  const Lock lock(mutex_);
  return loop_->reading().velocity;
}

VectorXd BotOp::get_qHome() const { return home_; }

VectorXd BotOp::get_tauExternal() {
  ask(askExternal);
  const Lock lock(mutex_);
  VectorXd mean = VectorXd::Constant(home_.size(), std::numeric_limits<double>::quiet_NaN());
  if (external_count_ > 0) {
    mean = external_sum_ / double(external_count_);
  } else if (loop_->reading().external_effort.size() > 0) {
    mean = loop_->reading().external_effort;
  }
  external_count_ = 0;
  return mean;
}

double BotOp::getTimeToEnd() {
  ask(askEnd);
  const Lock lock(mutex_);
  return timeToEnd();
}

double BotOp::timeToEnd() const {
  return loop_->mode() == LoopMode::follow ? loop_->motion().end() - loop_->time() : 0.;
}

LoopMode BotOp::getMode() const {
  const Lock lock(mutex_);
  return loop_->mode();
}

std::string BotOp::getFault() const {
  const Lock lock(mutex_);
  return loop_->fault();
}

// --- motions -------------------------------------------------------------------------------------------------------------

/// What is done now, until a later time.
BSpline BotOp::doneUntil(double time) const {
  const double now = loop_->time();
  const bool has_motion = loop_->mode() == LoopMode::follow || loop_->mode() == LoopMode::hold;
  if (has_motion) return cubicPart(loop_->motion(), now, time);
  MatrixXd still(2, home_.size());
  still.rowwise() = loop_->reading().q.transpose();
  VectorXd times(2);
  times << now, time;
  return BSpline(3, still, times);
}

/// The motion that goes on along a path after what is done now, or instead of it from `cut` on.
BSpline BotOp::continued(const MatrixXd& path, const VectorXd& times, bool overwrite, double cut) const {
  const double now = loop_->time();
  const bool moves = loop_->mode() == LoopMode::follow && loop_->motion().end() > now;
  if (moves && !overwrite && loop_->motion().degree() == 3) return BSpline(loop_->motion()).append(path, times);
  const double start = overwrite && cut >= 0. ? cut : now;
  if (start > now) return doneUntil(start).append(path, times);
  const MatrixXd here = loop_->reference(start);
  MatrixXd points(path.rows() + 1, path.cols());
  points << here.row(0), path;
  VectorXd absolute(times.size() + 1);
  absolute << start, times.array() + start;
  return BSpline(3, points, absolute, here.row(1).transpose());
}

/// Follows a motion of which what comes after `from` is new.
void BotOp::engage(const char* call, const BSpline& motion, double from) {
  loop_->requireReady(call, motion.eval(loop_->time()));
  if (const auto broken = brokenLimit(motion, from, loop_->info())) throw ValueError(cat(call, ": ", *broken));
  if (const auto broken = brokenEffort(motion, from, options_.period, loop_->info(), model_))
    throw ValueError(cat(call, ": ", *broken));
  loop_->apply(FollowSpline{motion});
}

/// Before a motion takes the place of what is done now: a robot that something keeps from where it should be rests where
/// it is, and the motion begins there.
void BotOp::giveWay() {
  const bool drives = loop_->mode() == LoopMode::follow || loop_->mode() == LoopMode::hold;
  const VectorXd apart = loop_->reference(loop_->time()).row(0).transpose() - loop_->reading().q;
  if (drives && apart.cwiseAbs().maxCoeff() > options_.guards.engage_distance) holdNow();
}

/// When a motion that is added begins: at the end of what is done now, or now.
double BotOp::nextStart() const { return loop_->time() + std::max(0., timeToEnd()); }

void BotOp::move(const MatrixXd& path, const VectorXd& times, bool overwrite, double overwrite_time) {
  constexpr const char* call = "BotOp::move";
  requirePath(call, path, home_.size());
  const VectorXd all_times = evenTimes(call, times, path.rows());
  const Lock lock(mutex_);
  const double now = loop_->time();
  if (overwrite && overwrite_time >= 0. && overwrite_time + all_times[all_times.size() - 1] <= now)
    throw ValueError(cat(call, ": the motion from ", overwrite_time, " s on would be over; it is ", now, " s"));
  if (overwrite && overwrite_time < 0.) giveWay();
  const double from = overwrite ? std::max(now, overwrite_time) : nextStart();
  const BSpline motion = continued(path, all_times, overwrite, overwrite_time);
  const double jump = (motion.eval(now) - loop_->reference(now).row(0).transpose()).cwiseAbs().maxCoeff();
  if (jump > options_.guards.engage_distance)
    throw ValueError(
        cat(call, ": overwriting from ", overwrite_time, " s on would make the robot jump by ", jump, " now"));
  engage(call, motion, from);
}

void BotOp::moveTo(const VectorXd& q, double time_cost, bool overwrite) {
  constexpr const char* call = "BotOp::moveTo";
  requirePath(call, asRow(q), home_.size());
  if (!(time_cost > 0.)) throw ValueError(cat(call, ": time_cost is ", time_cost, "; expected more than 0"));
  const Lock lock(mutex_);
  if (overwrite) giveWay();
  const double now = loop_->time();
  const bool goes_on = !overwrite && timeToEnd() > 0.;
  const MatrixXd from = loop_->reference(goes_on ? loop_->motion().end() : now);
  const VectorXd way = q - from.row(0).transpose();
  const double distance = way.norm(), velocity = distance > 0. ? from.row(1).dot(way) / distance : 0.;
  double duration =
      std::max(kShortest, (std::sqrt(6. * time_cost * distance + velocity * velocity) - velocity) / time_cost);
  BSpline motion = continued(asRow(q), asVector(duration), overwrite, -1.);
  for (int tries = 0; tries < 20; ++tries) {  // once, unless it is in motion
    const double start = goes_on ? motion.end() - duration : now;
    const double factor = peaksOf(motion, start).slowdown(loop_->info().velocity, loop_->info().acceleration);
    if (factor <= 1.) break;
    duration *= factor * (1. + 1e-9);
    motion = continued(asRow(q), asVector(duration), overwrite, -1.);
  }
  engage(call, motion, goes_on ? motion.end() - duration : now);
}

void BotOp::moveAutoTimed(const MatrixXd& path, double max_velocity, double max_acceleration) {
  constexpr const char* call = "BotOp::moveAutoTimed";
  requirePath(call, path, home_.size());
  if (!(max_velocity > 0.) || !(max_acceleration > 0.))
    throw ValueError(cat(call, ": maximal velocity ", max_velocity, " and acceleration ", max_acceleration,
                         "; expected more than 0"));
  const Lock lock(mutex_);
  const MatrixXd from = loop_->reference(timeToEnd() > 0. ? loop_->motion().end() : loop_->time());
  MatrixXd points(path.rows() + 1, path.cols());
  points << from.row(0), path;
  const BSpline in_one_second(3, points, VectorXd::LinSpaced(points.rows(), 0., 1.));
  const MotionPeaks peaks = peaksOf(in_one_second, 0.);
  const VectorXd velocity = loop_->info().velocity.cwiseMin(max_velocity);
  const VectorXd acceleration = loop_->info().acceleration.cwiseMin(max_acceleration);
  const double duration = std::max({loop_->period(), (peaks.velocity.array() / velocity.array()).maxCoeff(),
                                    std::sqrt((peaks.acceleration.array() / acceleration.array()).maxCoeff())});
  const double start = nextStart();
  engage(call, continued(path, evenTimes(call, asVector(duration), path.rows()), false, -1.), start);
}

void BotOp::follow(const BSpline& motion) {
  if (motion.isEmpty() || motion.dimension() != home_.size())
    throw ValueError(
        cat("BotOp::follow: a motion of ", motion.dimension(), " numbers; the robot has ", home_.size(), " joints"));
  if (motion.degree() > 3)
    throw ValueError(cat("BotOp::follow: a motion of degree ", motion.degree(), "; expected 3 at most"));
  const Lock lock(mutex_);
  engage("BotOp::follow", motion, loop_->time());
}

void BotOp::holdNow() {
  const VectorXd apart = loop_->reference(loop_->time()).row(0).transpose() - loop_->reading().q;
  BSpline motion = loop_->braking();
  if (apart.cwiseAbs().maxCoeff() > options_.guards.engage_distance) {  // something keeps it from where it should be
    MatrixXd still(2, home_.size());
    still.rowwise() = loop_->reading().q.transpose();
    VectorXd times(2);
    times << loop_->time(), loop_->time() + loop_->period();
    motion = BSpline(1, still, times);
  }
  loop_->apply(HoldRobot{motion});
}

void BotOp::hold() {
  const Lock lock(mutex_);
  holdNow();
}

void BotOp::floating(double damping) {
  if (!(damping >= 0. && damping <= 1.))
    throw ValueError(cat("BotOp::floating: damping is ", damping, "; expected 0 to 1"));
  const Lock lock(mutex_);
  loop_->apply(FloatRobot{damping});
}

void BotOp::setCompliance(const MatrixXd& J, double compliance) {
  constexpr const char* call = "BotOp::setCompliance";
  if (!(compliance >= 0. && compliance <= 1.))
    throw ValueError(cat(call, ": compliance is ", compliance, "; expected 0 to 1"));
  if (J.cols() != home_.size() || !J.allFinite())
    throw ValueError(
        cat(call, ": J has ", J.cols(), " columns; expected finite numbers for ", home_.size(), " joints"));
  const Eigen::FullPivLU<MatrixXd> lu(J * J.transpose());
  if (J.rows() == 0 || !lu.isInvertible())
    throw ValueError(cat(call, ": the ", J.rows(), " rows of J are not independent; expected full row rank"));
  MatrixXd stiffness;
  if (compliance > 0.)
    stiffness = MatrixXd::Identity(home_.size(), home_.size()) - compliance * J.transpose() * lu.solve(J);
  const Lock lock(mutex_);
  loop_->apply(SetStiffness{stiffness});
}

StepObservation BotOp::stepObservation() {
  ask(askObservation);
  const Lock lock(mutex_);
  return {loop_->time(), loop_->reading().q, loop_->reading().velocity, loop_->commanded(), loop_->commandedVelocity()};
}

void BotOp::stepAction(const VectorXd& delta, const StepObservation& observation, double lambda,
                       double max_acceleration, double xi) {
  constexpr const char* call = "BotOp::stepAction";
  const Eigen::Index n = home_.size();
  if (delta.size() != n || observation.qref.size() != n || observation.qvel.size() != n)
    throw ValueError(cat(call, ": delta of ", delta.size(), " numbers, an observation of ", observation.qref.size(),
                         "; expected ", n));
  if (!delta.allFinite() || !(lambda > 0.) || !(max_acceleration > 0.))
    throw ValueError(cat(call, ": expected a finite delta, lambda (", lambda, ") and max_acceleration (",
                         max_acceleration, ") more than 0"));
  VectorXd acceleration = (delta - 2. * xi * lambda * observation.qvel) / (lambda * lambda);
  const double largest = acceleration.cwiseAbs().maxCoeff();
  if (largest > max_acceleration) acceleration *= max_acceleration / largest;
  const VectorXd v = observation.qvel, faster = v + lambda * acceleration;
  MatrixXd points(4, n);
  points.row(0) = observation.qref.transpose();
  points.row(1) = points.row(0) + .5 * lambda * v.transpose();
  points.row(2) = points.row(1) + lambda * faster.transpose();
  points.row(3) = points.row(2);
  const double t = observation.ctrl_time;
  VectorXd knots(7);
  knots << t, t, t, t + lambda, t + 2. * lambda, t + 2. * lambda, t + 2. * lambda;
  const BSpline motion = BSpline::fromParts(2, knots, points);
  const Lock lock(mutex_);
  loop_->requireReady(call, motion.eval(loop_->time()));
  loop_->apply(FollowSpline{motion});  // kept within limits by the guard: a loop of feedback must not end here
}

void BotOp::home(Config& C) {
  moveTo(home_, 1., true);
  wait(C, false);
}

void BotOp::stop(Config& C) {
  double left = 0.;
  {
    const Lock lock(mutex_);
    holdNow();
    left = loop_->motion().end() - loop_->time();
  }
  sync(C, left + options_.period);
}

void BotOp::recover() {
  const Lock lock(mutex_);
  loop_->apply(RecoverRobot{});
  if (!loop_->fault().empty()) throw RobotFault(cat("BotOp::recover: the robot is still stopped: ", loop_->fault()));
}

void BotOp::setLimits(const VectorXd& velocity, const VectorXd& acceleration, const VectorXd& effort) {
  const Lock lock(mutex_);
  RobotInfo changed = loop_->info();
  const auto set = [&](VectorXd& limits, const VectorXd& given) {
    if (given.size() == 1) limits.setConstant(given[0]);
    if (given.size() > 1) limits = given;
  };
  set(changed.velocity, velocity);
  set(changed.acceleration, acceleration);
  set(changed.effort, effort);
  changed.validate();
  loop_->info() = changed;
}

// --- grippers ------------------------------------------------------------------------------------------------------------

void BotOp::requireGripper(const char* call, int gripper) const {
  const auto& grippers = loop_->info().grippers;
  if (gripper >= 0 && std::size_t(gripper) < grippers.size()) return;
  std::vector<std::string> names;
  for (const GripperInfo& info : grippers) names.push_back(info.name);
  throw ValueError(cat(call, ": there is no gripper ", gripper, "; the robot has ",
                       names.empty() ? std::string("none") : cat(names.size(), ": ", join(names))));
}

void BotOp::gripper(const char* call, GripperCommand command) {
  const Lock lock(mutex_);
  requireGripper(call, command.gripper);
  const GripperInfo& info = loop_->info().grippers[std::size_t(command.gripper)];
  if (!std::isfinite(command.width) || !(command.speed > 0.) || !(command.force > 0.))
    throw ValueError(cat(call, ": width ", command.width, ", speed ", command.speed, ", force ", command.force,
                         "; expected finite numbers, speed and force more than 0"));
  command.width = std::clamp(command.width, info.min_width, info.max_width);
  command.speed = std::min(command.speed, info.max_speed);
  command.force = std::min(command.force, info.max_force);
  loop_->apply(command);
}

void BotOp::gripperMove(int gripper, double width, double speed) {
  this->gripper("BotOp::gripperMove", {gripper, false, width, speed, 1e9, {}});
}

void BotOp::gripperClose(int gripper, double force, double width, double speed) {
  this->gripper("BotOp::gripperClose", {gripper, true, width, speed, force, {}});
}

void BotOp::gripperCloseGrasp(int gripper, const std::string& object, double force, double width, double speed) {
  if (loop_->driver().world()) model_.getFrame(object);  // throws FrameNotFound
  this->gripper("BotOp::gripperCloseGrasp", {gripper, true, width, speed, force, object});
}

double BotOp::getGripperPos(int gripper) {
  requireGripper("BotOp::getGripperPos", gripper);
  ask(askGripper);
  const Lock lock(mutex_);
  return loop_->reading().grippers.at(std::size_t(gripper)).width;
}

bool BotOp::gripperDone(int gripper) {
  requireGripper("BotOp::gripperDone", gripper);
  ask(askDone);
  const Lock lock(mutex_);
  return loop_->reading().grippers.at(std::size_t(gripper)).is_done;
}

// --- the simulated world -------------------------------------------------------------------------------------------------

Config BotOp::getWorld() const {
  const Lock lock(mutex_);
  SimulatedWorld* world = loop_->driver().world();
  if (!world) throw RobotFault(cat("BotOp::getWorld: robot '", loop_->info().name, "' is not simulated"));
  return world->config();
}

std::vector<Contact> BotOp::getContacts() const {
  const Lock lock(mutex_);
  const SimulatedWorld* world = loop_->driver().world();
  return world ? world->contacts() : std::vector<Contact>{};
}

void BotOp::update(Config& config) const {
  const Lock lock(mutex_);
  if (SimulatedWorld* world = loop_->driver().world()) {
    world->updateConfig(config);
  } else {
    config.setJointState(loop_->reading().q);
  }
}

void BotOp::attach(const std::string& from, const std::string& to) {
  const Lock lock(mutex_);
  loop_->apply(AttachFrames{from, to, true});
}

void BotOp::detach(const std::string& from, const std::string& to) {
  const Lock lock(mutex_);
  loop_->apply(AttachFrames{from, to, false});
}

void BotOp::setFramePose(const std::string& frame, const Pose& pose) {
  const Lock lock(mutex_);
  loop_->apply(PlaceFrame{frame, pose});
}

// --- records -------------------------------------------------------------------------------------------------------------

CommandLog BotOp::getLog() const {
  const Lock lock(mutex_);
  return loop_->log();
}

void BotOp::replay(const CommandLog& log) {
  constexpr const char* call = "BotOp::replay";
  Lock lock(mutex_);
  if (options_.realtime) throw ValueError(cat(call, ": time is real here; a log is replayed in virtual time"));
  if (loop_->tick() != 0 || !loop_->log().entries.empty())
    throw ValueError(cat(call, ": the robot was moved before; expected a BotOp that is new"));
  if (log.period != options_.period)
    throw ValueError(
        cat(call, ": the log's period is ", log.period, " s; that of this BotOp is ", options_.period, " s"));
  const auto go = [&](long tick) {
    while (loop_->tick() < tick) {
      lock.unlock();
      advanceVirtually(options_.period);
      lock.lock();
    }
  };
  for (const CommandLog::Entry& entry : log.entries) {
    go(entry.tick);
    loop_->apply(entry.command);
  }
  go(log.ticks);
}

void BotOp::recordTo(const std::string& path) {
  const Lock lock(mutex_);
  record_.reset();
  if (path.empty()) return;
  record_ = std::make_unique<std::ofstream>(path);
  if (!*record_) {
    record_.reset();
    throw FileError(cat("BotOp::recordTo: cannot write '", path, "'"));
  }
  *record_ << "# t, q, velocity, reference of q, of velocity; joints: " << join(loop_->info().joints, " ") << '\n';
}

}  // namespace kinegraph
