#include "kinegraph/tool_paths/path_timing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "kinegraph/tool_paths/slow_stretches.h"

namespace kinegraph::inline tool_paths_internal {

namespace {

constexpr int kLeastTimingIntervals = 100;
constexpr int kMostTimingIntervals = 500, kFinest = 2;  // the latter per piece of the joint curve
constexpr int kIntervalsOfEstimate = 50;
constexpr double kIdle = .02, kMuchIdle = .03;  // share of the duration without a limit that is reached
constexpr double kUnlimited = std::numeric_limits<double>::infinity();
constexpr double kBelowLimits = 1. - 1e-6;  // rounding

/// Appends the limits of one more dof: velocity, acceleration, and jerk if jerks are limited.
MotionLimits withDof(MotionLimits limits, const std::array<double, 3>& more) {
  const std::array<VectorXd*, 3> all = {&limits.velocity, &limits.acceleration, &limits.jerk};
  for (std::size_t k = 0; k < std::size_t(limits.limitsJerk() ? 3 : 2); ++k) {
    all[k]->conservativeResize(all[k]->size() + 1);
    (*all[k])[all[k]->size() - 1] = more[k];
  }
  return limits;
}

}  // namespace

PathTiming::PathTiming(ToolKinematics& tool, const ToolCurve& curve, const JointCurve& joints,
                       const MotionLimits& limits, const ToolPathOptions& options,
                       const CancellationToken& cancellation)
    : curve_(curve),
      options_(options),
      cancellation_(cancellation),
      has_speeds_(!curve.speedChanges().empty()),
      limits_(withDof(limits, {curve.largestSpeed(options.speed), options.tool_acceleration, options.tool_jerk})),
      // Several speeds are the velocity limit of one more dof, for the time of a call.
      all_(has_speeds_ ? withDof(limits_, {1., kUnlimited, kUnlimited}) : limits_),
      way_(withToolWay(tool, curve, joints.pieces)),
      path_(has_speeds_ ? withSpeedShare(way_, [this](double s) { return speedAt(s); }) : way_),
      points_(way_.pieces() + 1, way_.dofs()) {
  for (int k = 0; k <= way_.pieces(); ++k)
    points_.row(k) = way_.eval(k < way_.pieces() ? way_.begin(k) : way_.length()).transpose();
}

double PathTiming::speedAt(double s) const {
  const double speed = curve_.speedAt(s);
  return speed > 0. ? speed : options_.speed;
}

double PathTiming::fastestStart() const {
  double fastest = kUnlimited;
  const std::array<const VectorXd*, 3> limits = {&all_.velocity, &all_.acceleration, &all_.jerk};
  for (int order = 1; order <= (all_.limitsJerk() ? 3 : 2); ++order) {
    const VectorXd rate = path_.eval(0., order).cwiseAbs();
    for (Eigen::Index j = 0; j < rate.size(); ++j)
      if (rate[j] > 0.)
        fastest = std::min(fastest, std::pow((*limits[std::size_t(order - 1)])[j] / rate[j], 1. / order));
  }
  return kBelowLimits * fastest;
}

TimedPath PathTiming::timedOn(int intervals, double start) const {
  RetimeOptions options;
  options.cancellation = cancellation_;
  options.intervals = intervals;
  if (start > 0.) options.start_velocity = start * path_.eval(0., 1);
  TimedPath result = retimeTightly(points_, path_, all_, options);
  if (!has_speeds_ || !result.feasible()) return result;
  return TimedPath::fromParts(result.status, result.message, points_, result.times, way_, result.scaling());
}

TimedPath PathTiming::timed(double start) const {
  // A coarse grid leaves limits unused between its points: a finer one, by the share of the time that is lost.
  int intervals = std::max(kLeastTimingIntervals, path_.pieces());
  const int most = std::max(kMostTimingIntervals, kFinest * path_.pieces());
  TimedPath timed = timedOn(intervals, start);
  while (timed.feasible() && intervals < most) {
    const double idle = idleShare(timed, limits_, [this](double s) { return speedAt(s); });
    if (idle <= kIdle) break;
    intervals = std::min(most, intervals * (idle > kMuchIdle ? 4 : 2));
    TimedPath finer = timedOn(intervals, start);
    if (!finer.feasible() || finer.duration() >= timed.duration()) break;
    timed = std::move(finer);
  }
  return timed;
}

double PathTiming::estimatedDuration() const {
  RetimeOptions options;
  options.cancellation = cancellation_;
  options.intervals = kIntervalsOfEstimate;
  const TimedPath timed = retime(points_, path_, {all_.velocity, all_.acceleration, {}}, options);
  return timed.feasible() ? timed.duration() : kUnlimited;
}

}  // namespace kinegraph::inline tool_paths_internal
