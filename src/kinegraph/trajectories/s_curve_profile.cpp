#include "kinegraph/trajectories/s_curve_profile.h"

#include <algorithm>
#include <cmath>

namespace kinegraph::inline trajectories_internal {

namespace {

constexpr double kNoLimit = 1e15;  // represents an infinite limit

/// The fastest change of speed: jerk up for `ramp`, constant acceleration for `hold`, jerk down for `ramp`.
struct SpeedChange {
  double ramp, hold, acceleration, jerk;  ///< the last two with the sign of the change

  SpeedChange(double from, double to, const LineMotionLimits& limits) {
    const double change = std::abs(to - from), sign = to < from ? -1. : 1.;
    const double full = limits.acceleration / limits.jerk;  // time until the largest acceleration
    ramp = change >= limits.acceleration * full ? full : std::sqrt(change / limits.jerk);
    const double peak = ramp * limits.jerk;
    hold = peak > 0. ? std::max(0., change / peak - ramp) : 0.;
    acceleration = sign * peak, jerk = sign * limits.jerk;
  }
  double time() const { return 2. * ramp + hold; }
};

/// Returns the distance of a change of speed; its mean speed is the mean of both.
double distanceOf(double from, double to, const LineMotionLimits& limits) {
  return (from + to) / 2. * SpeedChange(from, to, limits).time();
}

/// Appends phases of constant jerk; each starts at the end of the last one.
struct PhaseAppender {
  TimeScaling& scaling;
  ScalingState now;
  double end;
  int piece;

  void add(double jerk, double time) {
    if (time <= 0.) return;
    now.jerk = jerk;
    ScalingPhase phase{0., now, 0., end, piece};
    now = phase.at(time);
    phase.end = std::min(end, now.s);
    scaling.add(phase, time);
  }
  void add(const SpeedChange& change) {
    add(change.jerk, change.ramp);
    now.acceleration = change.acceleration;
    add(0., change.hold);
    add(-change.jerk, change.ramp);
    now.acceleration = 0.;
  }
};

}  // namespace

LineMotionLimits limitsAlong(const double* tangent, const MotionLimits& limits) {
  LineMotionLimits along{kNoLimit, kNoLimit, kNoLimit};
  for (int j = 0; j < limits.velocity.size(); ++j) {
    const double d = std::abs(tangent[j]);
    if (d == 0.) continue;
    along.speed = std::min(along.speed, limits.velocity[j] / d);
    along.acceleration = std::min(along.acceleration, limits.acceleration[j] / d);
    along.jerk = std::min(along.jerk, limits.jerk[j] / d);
  }
  return along;
}

bool addSCurve(TimeScaling& scaling, double s0, double s1, double speed0, double speed1, const LineMotionLimits& limits,
               int piece) {
  const double distance = s1 - s0;
  const auto needed = [&](double top) { return distanceOf(speed0, top, limits) + distanceOf(top, speed1, limits); };
  double low = std::max(speed0, speed1), high = limits.speed;
  if (low > high || needed(low) > distance * (1. + 1e-12)) return false;
  if (!std::isfinite(high)) {
    high = 2. * low + 1e-9;
    while (needed(high) < distance) high *= 2.;
  }
  if (needed(high) <= distance) low = high;
  for (int i = 0; i < 200 && low < high; ++i) {
    const double middle = (low + high) / 2.;
    if (middle <= low || middle >= high) break;
    (needed(middle) <= distance ? low : high) = middle;
  }
  PhaseAppender phases{scaling, {s0, speed0, 0., 0.}, s1, piece};
  phases.add(SpeedChange(speed0, low, limits));
  const double rest = distance - needed(low);
  if (low > 0.) phases.add(0., rest / low);
  phases.now.speed = low;
  phases.add(SpeedChange(low, speed1, limits));
  return true;
}

}  // namespace kinegraph::inline trajectories_internal
