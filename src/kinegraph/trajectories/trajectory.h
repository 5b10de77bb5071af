#pragma once

#include <string>
#include <vector>

#include "kinegraph/math/pose.h"

namespace kinegraph {

/// A configuration with its velocity and acceleration, (n,) each: rad or m, and s.
struct MotionState {
  VectorXd q, velocity, acceleration;
};

/// States of a trajectory at several times: one row per time, (T, n) each.
struct MotionStates {
  VectorXd times;  ///< (T,), s
  MatrixXd q, velocity, acceleration;
};

/// A timed motion q(t), 0 <= t <= duration(). Splines, retimed paths, motion plans, task plans and receding horizons
/// implement it, so that a robot follows any of them without resampling.
class Trajectory {
 public:
  virtual ~Trajectory() = default;

  /// n, the length of q.
  virtual int dimension() const = 0;

  /// s; 0 if there is no motion.
  virtual double duration() const = 0;

  /// Writes q, dq/dt and d2q/dt2 at time t (s), n numbers each. Times outside of [0, duration()] are clamped. Throws
  /// ValueError if there is no motion, and if t is NaN.
  virtual void evalTo(double t, double* q, double* velocity, double* acceleration) const = 0;

  /// Returns the state at time t (s); errors as `evalTo`.
  MotionState eval(double t) const;

  /// Writes the state at time t (s); a control loop that passes the same `state` again requests no memory.
  void eval(double t, MotionState& state) const;

  /// Returns the states at several times (s).
  MotionStates eval(const VectorXd& times) const;

  /// Returns the states at equal steps of time, at most 1 / rate s apart, from 0 to duration(), both included. Throws
  /// ValueError if `rate` (Hz) is not positive, or asks for more than 1e8 samples.
  MotionStates sample(double rate) const;

  /// Writes the samples of `sample(rate)` to a text file, separated by commas: a line of names, then a row per sample
  /// with the time, q, velocities and accelerations. `names` are those of the dofs; "q0", "q1", ... if empty. Numbers
  /// are exact, with a point in each locale. Throws FileError, ValueError for another number of names, and as `sample`.
  void writeCsv(const std::string& file, double rate = 100., const std::vector<std::string>& names = {}) const;
};

}  // namespace kinegraph
