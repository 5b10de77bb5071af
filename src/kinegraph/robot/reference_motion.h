#pragma once

#include <memory>
#include <vector>

#include "kinegraph/trajectories/trajectory.h"

namespace kinegraph::inline robot_internal {

/// The reference of a robot over control time: the present motion, and those that follow it. Each motion ends the one
/// before it when it begins. After its own end it stays at its last q, at rest.
class ReferenceMotion {
 public:
  /// Adds a spline in control time that takes over at `begin` (s). If `begin` is not after `now`, it replaces
  /// everything.
  void add(const BSpline& spline, double begin, double now);

  /// Adds a trajectory whose t = 0 is the control time `begin` (s), in the same way. It has samples at all control
  /// periods, multiples of `period` (s), so that the reference at each of them is a sample to the bit.
  void add(std::shared_ptr<const SampledTrajectory> trajectory, double begin, double now, double period);

  /// Returns the time from `begin` to the next control period, s.
  static double firstPeriod(double begin, double period);

  /// Returns q, velocity and acceleration at a control time (s): 3 x n.
  MatrixXd eval(double time) const;

  /// The control time at which the last motion ends, s.
  double end() const { return parts_.back().end(); }

  /// The control time at which the last motion takes over, s.
  double lastBegin() const { return parts_.back().begin; }

  /// The last motion if it is a spline, else null.
  const BSpline* lastSpline() const { return parts_.back().trajectory ? nullptr : &parts_.back().spline; }

 private:
  struct Part {
    double begin = 0.;
    BSpline spline;  ///< in control time; empty for a trajectory
    std::shared_ptr<const SampledTrajectory> trajectory;
    double period = 0.;  ///< control period

    double end() const { return trajectory ? begin + trajectory->duration() : spline.end(); }
    MatrixXd eval(double time) const;
  };

  void add(Part part, double now);

  std::vector<Part> parts_;
};

}  // namespace kinegraph::inline robot_internal
