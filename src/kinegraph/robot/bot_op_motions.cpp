// How a BotOp is told to move.
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "kinegraph/common/text.h"
#include "kinegraph/robot/bot_op.h"
#include "kinegraph/trajectories/spline_part.h"

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

/// What is done now, until a later time.
BSpline BotOp::doneUntil(double time) const {
  const double now = loop_->time();
  const bool has_motion = loop_->mode() == LoopMode::follow || loop_->mode() == LoopMode::hold;
  if (has_motion) return cubicPart(loop_->motion(), now, time);
  MatrixXd still(2, home_.size());
  still.rowwise() = loop_->state().q.transpose();
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
  const VectorXd apart = loop_->reference(loop_->time()).row(0).transpose() - loop_->state().q;
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
  const VectorXd apart = loop_->reference(loop_->time()).row(0).transpose() - loop_->state().q;
  BSpline motion = loop_->braking();
  if (apart.cwiseAbs().maxCoeff() > options_.guards.engage_distance) {  // something keeps it from where it should be
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
  return {loop_->time(), loop_->state().q, loop_->state().velocity, loop_->commanded(), loop_->commandedVelocity()};
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

}  // namespace kinegraph
