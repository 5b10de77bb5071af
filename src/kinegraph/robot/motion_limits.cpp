#include "kinegraph/robot/motion_limits.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "kinegraph/common/guessed_units.h"
#include "kinegraph/common/text.h"

namespace kinegraph::inline robot_internal {

namespace {

constexpr double kRounding = 1. + 1e-9;
constexpr double kDifference = 1. + 1e-6;    // of differences between two control periods, as in limitCommand
constexpr double kPositionTolerance = 1e-3;  // rad or m: the constraint tolerance of the optimizers
constexpr int kSamples = 1000;

struct Peak {
  double value = 0., time = 0.;
  void take(double other, double when) {
    if (std::abs(other) > value) *this = {std::abs(other), when};
  }
};

/// Returns the times at which the polynomial pieces begin and end, from `from` on.
std::vector<double> pieceTimes(const BSpline& motion, double from) {
  std::vector<double> times = {std::max(from, motion.start())};
  for (const double knot : motion.getKnots()) {
    if (knot > times.back()) times.push_back(knot);
  }
  return times;
}

std::string slower(double factor) { return cat("take at least ", factor, " times as long"); }

std::string exceeded(const RobotInfo& robot, Eigen::Index i, double time, const char* quantity, double value,
                     const char* unit, double limit) {
  return cat("joint '", robot.joints[std::size_t(i)], "' would have ", quantity, " of ", value, unit, " ", time,
             " s after the start of the motion; its limit is ", limit, unit);
}

std::string outOfRange(const RobotInfo& robot, Eigen::Index i, double q) {
  constexpr double kLeastDegrees = 4.;
  constexpr double kLeastRange = 1.;  // rad; joints that slide have less, in m
  const double radians = q * std::numbers::pi / 180.;
  const bool may_turn = robot.upper[i] - robot.lower[i] >= kLeastRange;
  const bool is_degrees = may_turn && (mayBeDegrees(q, kLeastDegrees) || std::abs(q) > 4. * std::numbers::pi);
  const bool is_within = radians > robot.lower[i] - .01 && radians < robot.upper[i] + .01;
  return cat("joint '", robot.joints[std::size_t(i)], "' would go to ", q, "; its limits are ", robot.lower[i], " to ",
             robot.upper[i], is_degrees && is_within ? cat("; ", askForRadians(q)) : "");
}

/// Describes a joint that leaves its range, or is outside before it moves.
std::string outOfRange(const RobotInfo& robot, Eigen::Index i, double q, double start) {
  if (start >= robot.lower[i] - kPositionTolerance && start <= robot.upper[i] + kPositionTolerance)
    return outOfRange(robot, i, q);
  return cat("joint '", robot.joints[std::size_t(i)], "' is at ", start, ", beyond its limits ", robot.lower[i], " to ",
             robot.upper[i], "; place it within them before the robot starts, as by setJointState");
}

bool hasEffortLimits(const RobotInfo& robot, const Config& model) {
  const bool any_limit = (robot.effort.array() < std::numeric_limits<double>::infinity()).any();
  const std::vector<LinkInertia> inertias = model.inertias();
  return any_limit &&
         std::any_of(inertias.begin(), inertias.end(), [](const LinkInertia& inertia) { return inertia.mass > 0.; });
}

/// The largest efforts of a motion, (n,) N m or N, and their times.
class EffortPeaks {
 public:
  explicit EffortPeaks(Eigen::Index n) : effort_(VectorXd::Zero(n)), time_(effort_) {}

  void take(double time, const MotionState& state, Config& model) {
    model.setJointState(state.q);
    const VectorXd effort = model.inverseDynamics(state.velocity, state.acceleration).cwiseAbs();
    time_ = (effort.array() > effort_.array()).select(time, time_);
    effort_ = effort_.cwiseMax(effort);
  }

  std::optional<std::string> violation(const RobotInfo& robot, double from) const {
    for (Eigen::Index i = 0; i < effort_.size(); ++i) {
      if (effort_[i] > kRounding * robot.effort[i])
        return cat(exceeded(robot, i, time_[i] - from, "an effort", effort_[i], " N m", robot.effort[i]),
                   "; take longer, or carry less");
    }
    return std::nullopt;
  }

 private:
  VectorXd effort_, time_;
};

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
      const double peak = jerk[i] != 0. ? -a[i] / jerk[i] : -1.;  // the acceleration changes its sign there
      if (peak > 0. && peak < length) fast.take(v[i] + .5 * peak * a[i], start + peak);
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

std::optional<std::string> violatedLimit(const BSpline& motion, double from, const RobotInfo& robot) {
  MatrixXd points = motion.getCtrlPoints();  // their hull contains the motion, which may stay far inside
  const auto beyond_limits = [&](Eigen::Index i) {
    return points.col(i).minCoeff() < robot.lower[i] || points.col(i).maxCoeff() > robot.upper[i];
  };
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    if (beyond_limits(i))
      points = motion.eval(VectorXd::LinSpaced(kSamples, std::max(from, motion.start()), motion.end()));
    const double lowest = points.col(i).minCoeff(), highest = points.col(i).maxCoeff();
    if (lowest >= robot.lower[i] - kPositionTolerance && highest <= robot.upper[i] + kPositionTolerance) continue;
    return outOfRange(robot, i, lowest < robot.lower[i] - kPositionTolerance ? lowest : highest,
                      motion.eval(std::max(from, motion.start()))[i]);
  }
  const MotionPeaks peaks = peaksOf(motion, from);
  const double factor = peaks.slowdown(robot.velocity, robot.acceleration);
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    if (peaks.velocity[i] > kRounding * robot.velocity[i])
      return cat(
          exceeded(robot, i, peaks.velocity_time[i] - from, "a velocity", peaks.velocity[i], " /s", robot.velocity[i]),
          "; ", slower(factor));
    if (peaks.acceleration[i] > kRounding * robot.acceleration[i])
      return cat(exceeded(robot, i, peaks.acceleration_time[i] - from, "an acceleration", peaks.acceleration[i],
                          " /s^2", robot.acceleration[i]),
                 "; ", slower(factor));
  }
  return std::nullopt;
}

std::optional<std::string> violatedLimit(const MotionStates& motion, const RobotInfo& robot) {
  const Eigen::Index count = motion.times.size();
  double factor = 1.;
  std::string violation;
  const auto check = [&](Eigen::Index i, double time, const char* quantity, double value, const char* unit,
                         double limit, double slack, double power) {
    if (!(std::abs(value) > slack * limit)) return;
    if (violation.empty()) violation = exceeded(robot, i, time, quantity, std::abs(value), unit, limit);
    factor = std::max(factor, std::pow(std::abs(value) / limit, power));
  };
  for (Eigen::Index i = 0; i < motion.q.cols(); ++i) {
    const double lowest = motion.q.col(i).minCoeff(), highest = motion.q.col(i).maxCoeff();
    if (lowest < robot.lower[i] - kPositionTolerance) return outOfRange(robot, i, lowest, motion.q(0, i));
    if (highest > robot.upper[i] + kPositionTolerance) return outOfRange(robot, i, highest, motion.q(0, i));
    for (Eigen::Index k = 0; k < count; ++k) {
      const double time = motion.times[k];
      check(i, time, "a velocity", motion.velocity(k, i), " /s", robot.velocity[i], kRounding, 1.);
      check(i, time, "an acceleration", motion.acceleration(k, i), " /s^2", robot.acceleration[i], kRounding, .5);
      if (k == 0) continue;
      const double h = time - motion.times[k - 1];
      const double velocity = (motion.q(k, i) - motion.q(k - 1, i)) / h;
      const double acceleration = (motion.velocity(k, i) - motion.velocity(k - 1, i)) / h;
      check(i, time, "a velocity", velocity, " /s", robot.velocity[i], kDifference, 1.);
      check(i, time, "an acceleration", acceleration, " /s^2", robot.acceleration[i], kDifference, .5);
    }
  }
  if (violation.empty()) return std::nullopt;
  return cat(violation, "; ", slower(factor));
}

std::optional<std::string> violatedEffort(const BSpline& motion, double from, double period, const RobotInfo& robot,
                                          Config& model) {
  if (!hasEffortLimits(robot, model)) return std::nullopt;
  EffortPeaks peaks(robot.effort.size());
  const double start = std::max(from, motion.start()), step = std::max(period, (motion.end() - start) / kSamples);
  for (double t = start; t < motion.end(); t += step)
    peaks.take(t, {motion.eval(t), motion.eval(t, 1), motion.eval(t, 2)}, model);
  return peaks.violation(robot, from);
}

std::optional<std::string> violatedEffort(const MotionStates& motion, const RobotInfo& robot, Config& model) {
  if (!hasEffortLimits(robot, model)) return std::nullopt;
  EffortPeaks peaks(robot.effort.size());
  const Eigen::Index count = motion.times.size(), step = 1 + count / kSamples;
  for (Eigen::Index k = 0; k < count; k += step)
    peaks.take(motion.times[k], {motion.q.row(k), motion.velocity.row(k), motion.acceleration.row(k)}, model);
  return peaks.violation(robot, 0.);
}

}  // namespace kinegraph::inline robot_internal
