// The motions of a BotOp.
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "kinegraph/common/text.h"
#include "kinegraph/robot/bot_op.h"
#include "kinegraph/robot/robot_loop.h"
#include "kinegraph/robot/scene_grippers.h"
#include "kinegraph/trajectories/retime.h"

namespace kinegraph {

namespace {

constexpr double kShortest = .1;     // s, of moveTo
constexpr double kShortGap = 1e-6;   // of a period: between two samples of a trajectory, at least
constexpr double kMaxPeriods = 1e7;  // of a trajectory

VectorXd evenTimes(const char* call, const VectorXd& times, Eigen::Index count) {
  if (times.size() == count && count != 1) return times;
  if (times.size() != 1)
    throw ValueError(
        cat(call, ": there are ", count, " points and ", times.size(), " times; expected one time per point, or one"));
  if (!(times[0] > 0.) || !std::isfinite(times[0]))
    throw ValueError(cat(call, ": the time is ", times[0], " s; expected a number above 0"));
  return VectorXd::LinSpaced(count, times[0] / double(count), times[0]);
}

void requirePath(const char* call, const MatrixXd& path, Eigen::Index n) {
  if (path.rows() == 0) throw ValueError(cat(call, ": the path has no points"));
  if (path.cols() != n)
    throw ValueError(cat(call, ": the points have ", path.cols(), " numbers; the robot has ", n, " joints"));
  if (!path.allFinite()) throw ValueError(cat(call, ": the path has numbers that are not finite"));
}

MatrixXd asRow(const VectorXd& q) { return q.transpose(); }
VectorXd asVector(double number) { return VectorXd::Constant(1, number); }

/// Evaluates a trajectory that starts at the control time `begin`: at its start, at all control periods, at its end.
std::shared_ptr<const SampledTrajectory> sampled(const Trajectory& trajectory, double begin, double period) {
  const double duration = trajectory.duration();
  if (!(duration >= 0.) || !(duration / period < kMaxPeriods))
    throw ValueError(cat("BotOp::follow: the trajectory takes ", duration, " s; expected a number from 0 to ",
                         kMaxPeriods * period));
  const double first = ReferenceMotion::firstPeriod(begin, period), gap = kShortGap * period;
  std::vector<double> times = {0.};
  for (long k = first > gap ? 0 : 1; first + double(k) * period < duration - gap; ++k)
    times.push_back(first + double(k) * period);
  if (duration > 0.) times.push_back(duration);
  return std::make_shared<const SampledTrajectory>(
      trajectory.eval(Eigen::Map<const VectorXd>(times.data(), Eigen::Index(times.size()))));
}

}  // namespace

void FollowOptions::validate() const {
  if (!(tolerance >= 0.)) throw ValueError(cat("BotOp::follow: tolerance is ", tolerance, "; expected 0 or more"));
  if (!(velocity_tolerance >= 0.))
    throw ValueError(cat("BotOp::follow: velocity_tolerance is ", velocity_tolerance, "; expected 0 or more"));
}

/// The spline along a path after the present motion, or instead of it from the control time `cut` on.
FollowSpline BotOp::continuation(const MatrixXd& path, const VectorXd& times, bool overwrite, double cut) const {
  const double now = loop_->time();
  const bool moves = loop_->mode() == LoopMode::follow && loop_->motion().end() > now;
  const bool appends = moves && !overwrite;
  if (appends && loop_->motion().lastSpline() && loop_->motion().lastSpline()->degree() == 3)
    return {BSpline(*loop_->motion().lastSpline()).append(path, times), loop_->motion().lastBegin()};
  double begin = overwrite && cut >= 0. ? cut : now;
  if (appends && !loop_->motion().lastSpline()) begin = loop_->motion().end();
  const MatrixXd reference = loop_->reference(begin);
  MatrixXd points(path.rows() + 1, path.cols());
  points << reference.row(0), path;
  VectorXd absolute(times.size() + 1);
  absolute << begin, times.array() + begin;
  FollowSpline following{BSpline(3, points, absolute, reference.row(1).transpose())};
  if (begin > now) following.begin = begin;
  return following;
}

/// Follows a spline that differs from the present motion after the control time `from`.
void BotOp::start(const char* call, const FollowSpline& following, double from) {
  const double now = loop_->time();
  const bool is_later = following.begin > now;
  loop_->requireReady(call, is_later ? VectorXd(loop_->reference(now).row(0)) : following.motion.eval(now));
  if (const auto violation = violatedLimit(following.motion, from, loop_->info()))
    throw ValueError(cat(call, ": ", *violation));
  if (const auto violation = violatedEffort(following.motion, from, options_.period, loop_->info(), model_))
    throw ValueError(cat(call, ": ", *violation));
  loop_->apply(following);
}

/// The largest distance of a joint from its reference, rad or m.
double BotOp::trackingError() const {
  return (loop_->reference(loop_->time()).row(0).transpose() - loop_->state().q).cwiseAbs().maxCoeff();
}

/// A motion that replaces the present one starts at the robot's q, at rest, if the robot is blocked.
void BotOp::holdIfBlocked() {
  const bool is_stiff = loop_->mode() == LoopMode::follow || loop_->mode() == LoopMode::hold;
  if (is_stiff && trackingError() > options_.safety.start_distance) holdNow();
}

/// The control time at which a motion starts that is appended.
double BotOp::nextStart() const { return loop_->time() + std::max(0., timeToEnd()); }

void BotOp::move(const MatrixXd& path, const VectorXd& times, bool overwrite, double overwrite_time) {
  constexpr const char* call = "BotOp::move";
  requirePath(call, path, home_.size());
  const VectorXd all_times = evenTimes(call, times, path.rows());
  const Lock lock(mutex_);
  const double now = loop_->time();
  if (overwrite && overwrite_time >= 0. && overwrite_time + all_times[all_times.size() - 1] <= now)
    throw ValueError(cat(call, ": the motion from ", overwrite_time, " s on would have ended; it is ", now, " s"));
  if (overwrite && overwrite_time < 0.) holdIfBlocked();
  const double from = overwrite ? std::max(now, overwrite_time) : nextStart();
  const FollowSpline following = continuation(path, all_times, overwrite, overwrite_time);
  if (following.begin <= now) {
    const VectorXd reference = loop_->reference(now).row(0).transpose();
    const double jump = (following.motion.eval(now) - reference).cwiseAbs().maxCoeff();
    if (jump > options_.safety.start_distance)
      throw ValueError(
          cat(call, ": overwriting from ", overwrite_time, " s on would make the robot jump by ", jump, " now"));
  }
  start(call, following, from);
}

void BotOp::moveTo(const VectorXd& q, double time_cost, bool overwrite) {
  constexpr const char* call = "BotOp::moveTo";
  requirePath(call, asRow(q), home_.size());
  if (!(time_cost > 0.)) throw ValueError(cat(call, ": time_cost is ", time_cost, "; expected a number above 0"));
  const Lock lock(mutex_);
  if (overwrite) holdIfBlocked();
  const double now = loop_->time();
  const bool appends = !overwrite && timeToEnd() > 0.;
  const MatrixXd from = loop_->reference(appends ? loop_->motion().end() : now);
  const VectorXd difference = q - from.row(0).transpose();
  const double distance = difference.norm(), velocity = distance > 0. ? from.row(1).dot(difference) / distance : 0.;
  double duration =
      std::max(kShortest, (std::sqrt(6. * time_cost * distance + velocity * velocity) - velocity) / time_cost);
  FollowSpline following = continuation(asRow(q), asVector(duration), overwrite, -1.);
  for (int i = 0; i < 20; ++i) {  // once from rest; a start velocity changes the shape of the motion
    const double start = appends ? following.motion.end() - duration : now;
    const double factor = peaksOf(following.motion, start).slowdown(loop_->info().velocity, loop_->info().acceleration);
    if (factor <= 1.) break;
    duration *= factor * (1. + 1e-9);
    following = continuation(asRow(q), asVector(duration), overwrite, -1.);
  }
  start(call, following, appends ? following.motion.end() - duration : now);
}

void BotOp::moveAutoTimed(const MatrixXd& path, double max_velocity, double max_acceleration) {
  constexpr const char* call = "BotOp::moveAutoTimed";
  requirePath(call, path, home_.size());
  if (!(max_velocity > 0.) || !(max_acceleration > 0.))
    throw ValueError(cat(call, ": the maximal velocity is ", max_velocity, ", the maximal acceleration ",
                         max_acceleration, "; expected numbers above 0"));
  const Lock lock(mutex_);
  const bool moves = loop_->mode() == LoopMode::follow || loop_->mode() == LoopMode::hold;
  const double begin = moves ? std::max(loop_->time(), loop_->motion().end()) : loop_->time();  // at rest
  MatrixXd points(path.rows() + 1, path.cols());
  points << loop_->reference(begin).row(0), path;
  const TimedPath timed = retime(points, {.velocity = loop_->info().velocity.cwiseMin(max_velocity),
                                          .acceleration = loop_->info().acceleration.cwiseMin(max_acceleration),
                                          .jerk = {}});
  start(call, timed, {}, begin);
}

/// The robot or its reference must be at the first state of a trajectory that starts at the control time `begin`.
void BotOp::requireStart(const char* call, const Trajectory& trajectory, const FollowOptions& options,
                         double begin) const {
  const MotionState first = trajectory.eval(0.);
  const MatrixXd reference = loop_->reference(begin);
  const bool is_now = begin <= loop_->time();
  for (Eigen::Index i = 0; i < home_.size(); ++i) {
    const std::string& joint = loop_->info().joints[std::size_t(i)];
    const double q = is_now ? loop_->state().q[i] : reference(0, i);
    const double distance = std::min(std::abs(first.q[i] - reference(0, i)), std::abs(first.q[i] - q));
    if (distance > options.tolerance)
      throw ValueError(cat(call, ": the trajectory starts with joint '", joint, "' at ", first.q[i], ", the robot ",
                           is_now ? "is" : "will be", " at ", q, "; the tolerance is ", options.tolerance,
                           ". Move there first, or plan from the robot's q"));
    if (std::abs(first.velocity[i] - reference(1, i)) > options.velocity_tolerance)
      throw ValueError(cat(call, ": the trajectory starts with joint '", joint, "' at a velocity of ",
                           first.velocity[i], " /s, the robot's is ", reference(1, i), " /s; the tolerance is ",
                           options.velocity_tolerance, " /s"));
  }
}

void BotOp::follow(const Trajectory& trajectory, const FollowOptions& options) {
  constexpr const char* call = "BotOp::follow";
  options.validate();
  if (trajectory.dimension() != home_.size())
    throw ValueError(
        cat(call, ": the trajectory has ", trajectory.dimension(), " dofs; the robot has ", home_.size(), " joints"));
  const Lock lock(mutex_);
  const double now = loop_->time();
  if (options.start_time >= 0. && (!options.overwrite || options.start_time < now))
    throw ValueError(cat(call, ": start_time is ", options.start_time, " s; expected overwrite, and a time from now, ",
                         now, " s, on"));
  const bool appends = !options.overwrite && timeToEnd() > 0.;
  start(call, trajectory, options, appends ? loop_->motion().end() : std::max(now, options.start_time));
}

/// Follows a trajectory from the control time `begin` on.
void BotOp::start(const char* call, const Trajectory& trajectory, const FollowOptions& options, double begin) {
  const double now = loop_->time();
  const auto trajectory_samples = sampled(trajectory, begin, options_.period);
  const MotionStates& samples = trajectory_samples->samples();
  loop_->requireReady(call, {});
  requireStart(call, *trajectory_samples, options, begin);
  loop_->requireReady(call, begin > now ? VectorXd(loop_->reference(now).row(0)) : VectorXd(samples.q.row(0)));
  if (const auto violation = violatedLimit(samples, loop_->info())) throw ValueError(cat(call, ": ", *violation));
  if (const auto violation = violatedEffort(samples, loop_->info(), model_))
    throw ValueError(cat(call, ": ", *violation));
  loop_->apply(FollowTrajectory{begin, trajectory_samples});
  const MotionState last = trajectory_samples->eval(trajectory_samples->duration());
  if (last.velocity.cwiseAbs().maxCoeff() <= options.velocity_tolerance) return;
  MatrixXd state(3, last.q.size());
  state << last.q.transpose(), last.velocity.transpose(), last.acceleration.transpose();
  const double end = loop_->motion().end();
  loop_->apply(FollowSpline{loop_->stoppingSegment(end, state), end});
}

void BotOp::holdNow() {
  BSpline motion = loop_->stoppingSegment(loop_->time(), loop_->reference(loop_->time()));
  if (trackingError() > options_.safety.start_distance) {  // a blocked robot holds its own q
    MatrixXd still(2, home_.size());
    still.rowwise() = loop_->state().q.transpose();
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
    throw ValueError(cat(call, ": the ", J.rows(), " rows of J are linearly dependent; expected full row rank"));
  MatrixXd stiffness;
  if (compliance > 0.)
    stiffness = MatrixXd::Identity(home_.size(), home_.size()) - compliance * J.transpose() * lu.solve(J);
  const Lock lock(mutex_);
  loop_->apply(SetStiffness{stiffness});
}

StepObservation BotOp::stepObservation() {
  countQuery(queryObservation);
  const Lock lock(mutex_);
  return {loop_->time(), loop_->state().q, loop_->state().velocity, loop_->commanded(), loop_->commandedVelocity()};
}

void BotOp::stepAction(const VectorXd& delta, const StepObservation& observation, double lambda,
                       double max_acceleration, double xi) {
  constexpr const char* call = "BotOp::stepAction";
  const Eigen::Index n = home_.size();
  if (delta.size() != n || observation.qref.size() != n || observation.qvel.size() != n)
    throw ValueError(cat(call, ": delta has ", delta.size(), " numbers, the observation ", observation.qref.size(),
                         "; expected ", n));
  if (!delta.allFinite() || !(lambda > 0.) || !(max_acceleration > 0.))
    throw ValueError(cat(call, ": lambda is ", lambda, ", max_acceleration ", max_acceleration,
                         "; expected numbers above 0, and a finite delta"));
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
  loop_->apply(FollowSpline{motion});  // limitCommand keeps the limits: feedback loops must not end with an error
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
  if (!loop_->fault().empty()) throw RobotFault(cat("BotOp::recover: the robot is still in fault: ", loop_->fault()));
}

void BotOp::setLimits(const VectorXd& velocity, const VectorXd& acceleration, const VectorXd& effort) {
  const Lock lock(mutex_);
  RobotInfo changed = loop_->info();
  const auto set = [&](VectorXd& limits, const VectorXd& values) {
    if (values.size() == 1) limits.setConstant(values[0]);
    if (values.size() > 1) limits = values;
  };
  set(changed.velocity, velocity);
  set(changed.acceleration, acceleration);
  set(changed.effort, effort);
  changed.validate();
  loop_->info() = changed;
}

}  // namespace kinegraph
