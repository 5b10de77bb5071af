#pragma once

#include <utility>
#include <vector>

namespace kinegraph::inline trajectories_internal {

/// State of a motion along a curve: s, ds/dt, d2s/dt2, d3s/dt3.
struct ScalingState {
  double s = 0., speed = 0., acceleration = 0., jerk = 0.;
};

/// A phase of a time scaling, in its own time tau = t - time. Its acceleration is linear in time or in s:
///
///     s'' = acceleration + jerk tau + growth (s - s0);      jerk or growth is zero
struct ScalingPhase {
  double time = 0.;  ///< start of the phase, s
  ScalingState begin;
  double growth = 0.;  ///< 1/s^2
  double end = 0.;     ///< s at the end of the phase
  int piece = 0;       ///< of the curve

  ScalingState at(double tau) const;

  /// Returns s'^2 at s, for a phase without jerk.
  double squaredSpeed(double s) const;
};

/// The time scaling s(t), 0 <= t <= duration(), of a motion along a curve.
class TimeScaling {
 public:
  TimeScaling() = default;

  /// Builds a time scaling from its members.
  TimeScaling(std::vector<ScalingPhase> phases, double duration) : phases_(std::move(phases)), duration_(duration) {}

  double duration() const { return duration_; }
  const std::vector<ScalingPhase>& phases() const { return phases_; }

  /// Returns the phase at a time, clamped to [0, duration()]; the later one at a boundary. There must be a phase.
  const ScalingPhase& phaseAt(double t) const;

  /// Returns the first time at which the motion reaches s.
  double timeOf(double s) const;

  /// Returns s'^2 at s, if no phase has a jerk.
  double squaredSpeedAt(double s) const;

  /// Appends a phase of `time` s. The next phase has to start at its end.
  void add(ScalingPhase phase, double time);

  /// Appends a phase of constant acceleration from one speed at s0 to another at s1. The acceleration is clamped to
  /// `most`, because rounding may exceed it in short phases.
  void addConstantAcceleration(double s0, double s1, double speed0, double speed1, double most, int piece);

  /// Appends a phase from s0 to s1 with a quadratic s'^2 of these Bernstein coefficients, the middle one > 0.
  void addQuadratic(double s0, double s1, double first, double middle, double last, int piece);

  /// Appends all phases of another time scaling.
  void append(const TimeScaling& other);

  /// Multiplies all times by `factor`.
  void slowDown(double factor);

 private:
  std::vector<ScalingPhase>::const_iterator phaseTo(double s) const;

  std::vector<ScalingPhase> phases_;
  double duration_ = 0.;
};

}  // namespace kinegraph::inline trajectories_internal
