#include "kinegraph/robot/motion_limits.h"

#include <algorithm>
#include <cmath>

#include "kinegraph/common/text.h"

namespace kinegraph {

namespace {

constexpr double kRounding = 1. + 1e-9;
constexpr double kPositionTolerance = 1e-3;  // rad or m: what an optimizer calls within its limits
constexpr int kSamples = 1000;

struct Peak {
  double value = 0., time = 0.;
  void take(double other, double when) {
    if (std::abs(other) > value) *this = {std::abs(other), when};
  }
};

/// The times at which one polynomial follows another, from `from` on.
std::vector<double> pieceTimes(const BSpline& motion, double from) {
  std::vector<double> times = {std::max(from, motion.start())};
  for (const double knot : motion.getKnots()) {
    if (knot > times.back()) times.push_back(knot);
  }
  return times;
}

/// Seen as times by which it must be slower.
std::string slower(double factor) { return cat("take at least ", factor, " times as long"); }

std::string beyond(const RobotInfo& robot, Eigen::Index i, double time, double value, const char* unit, double limit) {
  return cat("joint '", robot.joints[std::size_t(i)], "' would ", value, unit, " ", time,
             " s after its start; its limit is ", limit);
}

}  // namespace

double MotionPeaks::slowdown(const VectorXd& velocity_limits, const VectorXd& acceleration_limits) const {
  double factor = 1.;
  for (Eigen::Index i = 0; i < velocity.size(); ++i) {
    factor = std::max(factor, velocity[i] / velocity_limits[i]);
    factor = std::max(factor, std::sqrt(acceleration[i] / acceleration_limits[i]));
  }
  return factor;
}

MotionPeaks peaksOf(const BSpline& motion, double from) {
  const int n = motion.dimension();
  const auto count = std::size_t(n);
  std::vector<Peak> fastest(count), hardest(count);
  const std::vector<double> times = pieceTimes(motion, from);
  for (std::size_t k = 0; k + 1 < times.size(); ++k) {
    const double start = times[k], length = times[k + 1] - start;
    const VectorXd v = motion.eval(start, 1), a = motion.eval(start, 2), jerk = motion.eval(start, 3);
    for (int i = 0; i < n; ++i) {
      Peak& fast = fastest[std::size_t(i)];
      Peak& hard = hardest[std::size_t(i)];
      fast.take(v[i], start);
      fast.take(v[i] + length * (a[i] + .5 * length * jerk[i]), start + length);
      const double turn = jerk[i] != 0. ? -a[i] / jerk[i] : -1.;  // where its acceleration changes sign
      if (turn > 0. && turn < length) fast.take(v[i] + .5 * turn * a[i], start + turn);
      hard.take(a[i], start);
      hard.take(a[i] + length * jerk[i], start + length);
    }
  }
  MotionPeaks peaks{VectorXd(n), VectorXd(n), VectorXd(n), VectorXd(n)};
  for (int i = 0; i < n; ++i) {
    peaks.velocity[i] = fastest[std::size_t(i)].value;
    peaks.velocity_time[i] = fastest[std::size_t(i)].time;
    peaks.acceleration[i] = hardest[std::size_t(i)].value;
    peaks.acceleration_time[i] = hardest[std::size_t(i)].time;
  }
  return peaks;
}

std::optional<std::string> brokenLimit(const BSpline& motion, double from, const RobotInfo& robot) {
  MatrixXd points = motion.getCtrlPoints();  // the motion is within their hull, and often well within
  const auto beyond_limits = [&](Eigen::Index i) {
    return points.col(i).minCoeff() < robot.lower[i] || points.col(i).maxCoeff() > robot.upper[i];
  };
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    if (beyond_limits(i))
      points = motion.eval(VectorXd::LinSpaced(kSamples, std::max(from, motion.start()), motion.end()));
    const double lowest = points.col(i).minCoeff(), highest = points.col(i).maxCoeff();
    if (lowest >= robot.lower[i] - kPositionTolerance && highest <= robot.upper[i] + kPositionTolerance) continue;
    const bool low = lowest < robot.lower[i] - kPositionTolerance;
    return cat("joint '", robot.joints[std::size_t(i)], "' would go to ", low ? lowest : highest, "; its limits are ",
               robot.lower[i], " to ", robot.upper[i]);
  }
  const MotionPeaks peaks = peaksOf(motion, from);
  const double factor = peaks.slowdown(robot.velocity, robot.acceleration);
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    if (peaks.velocity[i] > kRounding * robot.velocity[i])
      return cat(beyond(robot, i, peaks.velocity_time[i] - from, peaks.velocity[i], " /s", robot.velocity[i]), " /s; ",
                 slower(factor));
    if (peaks.acceleration[i] > kRounding * robot.acceleration[i])
      return cat(
          beyond(robot, i, peaks.acceleration_time[i] - from, peaks.acceleration[i], " /s^2", robot.acceleration[i]),
          " /s^2; ", slower(factor));
  }
  return std::nullopt;
}

std::optional<std::string> brokenEffort(const BSpline& motion, double from, double period, const RobotInfo& robot,
                                        Config& model) {
  const bool any_limit = (robot.effort.array() < std::numeric_limits<double>::infinity()).any();
  const std::vector<LinkInertia> inertias = model.inertias();
  const bool any_mass =
      std::any_of(inertias.begin(), inertias.end(), [](const LinkInertia& inertia) { return inertia.mass > 0.; });
  if (!any_limit || !any_mass) return std::nullopt;
  VectorXd most = VectorXd::Zero(robot.effort.size()), when = most;
  const double start = std::max(from, motion.start()), step = std::max(period, (motion.end() - start) / kSamples);
  for (double t = start; t < motion.end(); t += step) {
    model.setJointState(motion.eval(t));
    const VectorXd effort = model.inverseDynamics(motion.eval(t, 1), motion.eval(t, 2)).cwiseAbs();
    when = (effort.array() > most.array()).select(t, when);
    most = most.cwiseMax(effort);
  }
  for (Eigen::Index i = 0; i < most.size(); ++i) {
    if (most[i] > kRounding * robot.effort[i])
      return cat(beyond(robot, i, when[i] - from, most[i], " N m", robot.effort[i]),
                 " N m; take longer, or carry less");
  }
  return std::nullopt;
}

}  // namespace kinegraph
