#pragma once

#include <utility>
#include <vector>

namespace kinegraph {

/// Where on a curve a motion is, and how fast: s, ds/dt, d2s/dt2, d3s/dt3.
struct ScalingState {
  double s = 0., speed = 0., acceleration = 0., jerk = 0.;
};

/// A part of a time law, in its own time tau = t - time. Its acceleration grows with time or with the way:
///
///     s'' = acceleration + jerk tau + growth (s - s0);      jerk or growth is zero
struct ScalingPhase {
  double time = 0.;  ///< when it begins, s
  ScalingState begin;
  double growth = 0.;  ///< 1/s^2
  double end = 0.;     ///< s where it ends
  int piece = 0;       ///< of the curve

  ScalingState at(double tau) const;

  /// s'^2 at s, without a jerk.
  double squaredSpeed(double s) const;
};

/// s(t), 0 <= t <= duration(): when a motion is where on its curve.
class TimeScaling {
 public:
  TimeScaling() = default;

  /// What another one had.
  TimeScaling(std::vector<ScalingPhase> phases, double duration) : phases_(std::move(phases)), duration_(duration) {}

  double duration() const { return duration_; }
  const std::vector<ScalingPhase>& phases() const { return phases_; }

  /// The phase of this time, held within 0 and duration(); where two meet, the later one. There is one at least.
  const ScalingPhase& phaseAt(double t) const;

  /// When the motion is at s first.
  double timeOf(double s) const;

  /// s'^2 at s, where no phase has a jerk.
  double squaredSpeedAt(double s) const;

  /// Appends a phase that begins now and takes `time`; it should end where the next begins.
  void add(ScalingPhase phase, double time);

  /// The phase that leads from one speed at s0 to another at s1 at constant acceleration, of which `most` is known: in brief
  /// phases rounding makes more of it.
  void addConstantAcceleration(double s0, double s1, double speed0, double speed1, double most, int piece);

  /// The phase from s0 to s1 in which s'^2 is a quadratic of s with these Bernstein coefficients, the middle one > 0.
  void addQuadratic(double s0, double s1, double first, double middle, double last, int piece);

  /// Appends all phases of another law.
  void append(const TimeScaling& other);

  /// Everything takes `factor` times as long.
  void slowDown(double factor);

 private:
  std::vector<ScalingPhase>::const_iterator phaseTo(double s) const;

  std::vector<ScalingPhase> phases_;
  double duration_ = 0.;
};

}  // namespace kinegraph
