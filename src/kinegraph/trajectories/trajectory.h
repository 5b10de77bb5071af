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

/// A motion x(t) of d dofs as a B-spline with control points c_i and basis functions B_i, which the knots define:
///
///     x(t) = sum_i B_i(t) c_i
///
/// Callers pass points with times. A spline of degree 2 or more comes near the inner points, but does not pass through
/// them. The first and the last point are repeated (*duplicates*, floor(degree / 2) of each), so that the spline starts
/// and ends at them, at rest or with a given velocity. Before its first knot it stays at the first control point, from
/// its last knot on at the last one, with zero derivatives. At a knot, a derivative that jumps has its right-hand
/// value. Source: de Boor, A Practical Guide to Splines, ch. IX-X.
class BSpline {
 public:
  BSpline() = default;

  /// Calls `set`.
  BSpline(int degree, const MatrixXd& points, const VectorXd& times, const VectorXd& start_velocity = {},
          const VectorXd& end_velocity = {});

  /// Sets the knots for n points at `times` (n,), s, and removes the control points. The first and the last time are
  /// knots degree + 1 times. Between them, the knots of an odd degree are the inner times, those of an even degree the
  /// midpoints of neighbors. Throws ValueError for a degree outside of 0..9, for fewer than two times, for times that
  /// decrease or are not finite, and if all are equal.
  BSpline& setKnots(int degree, const VectorXd& times);

  /// Sets the control points (n x d). The duplicates of an end are added, or are already among the points. A velocity
  /// (d,) at an end moves its duplicates so that the spline has that velocity there; it requires a degree of 2 or more.
  /// Throws ValueError for wrong sizes, and for numbers that are not finite.
  BSpline& setCtrlPoints(const MatrixXd& points, bool add_start_duplicates = true, bool add_end_duplicates = true,
                         const VectorXd& start_velocity = {}, const VectorXd& end_velocity = {});

  /// Calls `setKnots` and `setCtrlPoints`. An error leaves the spline unchanged.
  BSpline& set(int degree, const MatrixXd& points, const VectorXd& times, const VectorXd& start_velocity = {},
               const VectorXd& end_velocity = {});

  /// Appends `points` (k x d) at `times` (k,), s after the present end. With `inside` false, the spline passes through
  /// its previous end: at rest if it ended at rest, else with its velocity. With `inside` true, the previous end
  /// becomes an inner point, and the last piece changes. Throws ValueError for wrong sizes, and for times that decrease
  /// or are negative; an error leaves the spline unchanged.
  BSpline& append(const MatrixXd& points, const VectorXd& times, bool inside = false);

  /// Replaces the spline by one that starts with its position and velocity at `time_cut`, and has `points` at `times`
  /// after that. Throws ValueError as `append` does.
  BSpline& overwriteSmooth(const MatrixXd& points, const VectorXd& times, double time_cut);

  /// Returns x or a derivative of it (1 velocity, 2 acceleration, ...) at several times: m x d. Throws ValueError
  /// without control points, for a negative derivative, and for NaN.
  MatrixXd eval(const VectorXd& times, int derivative = 0) const;
  VectorXd eval(double time, int derivative = 0) const;

  /// Returns position, velocity and acceleration at a time: 3 x d.
  MatrixXd eval3(double time) const;

  /// Returns B (m x number of control points) of x = B c at several times, or of a derivative of x. With
  /// `start_duplicates` or `end_duplicates`, the columns of duplicates are added to the column of their point, so that
  /// B multiplies the points alone.
  MatrixXd getBmatrix(const VectorXd& times, bool start_duplicates = false, bool end_duplicates = false,
                      int derivative = 0) const;

  int degree() const { return degree_; }
  const VectorXd& getKnots() const { return knots_; }
  const MatrixXd& getCtrlPoints() const { return ctrl_points_; }  ///< one per row, with duplicates
  int dimension() const { return int(ctrl_points_.cols()); }      ///< d
  bool isEmpty() const { return ctrl_points_.rows() == 0; }       ///< true without control points
  double start() const;                                           ///< first knot, s; throws ValueError without knots
  double end() const;                                             ///< last knot, s

  /// Builds a spline from its members. Throws ValueError if their sizes do not match.
  static BSpline fromParts(int degree, const VectorXd& knots, const MatrixXd& ctrl_points);

 private:
  int duplicates() const { return degree_ / 2; }
  int ctrlCount() const { return int(knots_.size()) - degree_ - 1; }
  void requirePoints(const char* call) const;
  void moveDuplicates(bool at_end, const VectorXd& velocity);
  void appendInside(const MatrixXd& points, const VectorXd& times);
  void appendAtRest(const MatrixXd& points, const VectorXd& times);
  void appendInMotion(const MatrixXd& points, const VectorXd& times, const VectorXd& velocity);

  int degree_ = 0;
  VectorXd knots_;
  MatrixXd ctrl_points_;
};

/// A trajectory through given states. At a sample's time its state is returned to the bit; between two samples, each
/// dof is the quintic polynomial with their positions, velocities and accelerations (Hermite interpolation).
class SampledTrajectory final : public Trajectory {
 public:
  SampledTrajectory() = default;

  /// `samples` have at least one row; their times start at 0 and increase. Throws ValueError otherwise, for sizes that
  /// differ, and for numbers that are not finite.
  explicit SampledTrajectory(MotionStates samples);

  /// Reads a file of Trajectory::writeCsv. Throws FileError if it cannot be read, ParseError with line and column for
  /// other content, and ValueError as the constructor.
  static SampledTrajectory read(const std::string& file);

  int dimension() const override { return int(samples_.q.cols()); }
  double duration() const override { return samples_.times.size() ? samples_.times[samples_.times.size() - 1] : 0.; }
  void evalTo(double t, double* q, double* velocity, double* acceleration) const override;

  const MotionStates& samples() const { return samples_; }

 private:
  MotionStates samples_;
};

/// A B-spline as a Trajectory: t = 0 is the spline's `origin`, and the trajectory ends with the spline.
class SplineTrajectory final : public Trajectory {
 public:
  /// Keeps a copy of the spline; t = 0 is its first knot. Throws ValueError if it has no control points.
  explicit SplineTrajectory(BSpline spline);

  /// The same, with the time of the spline (s) at t = 0. Before its first knot a spline stays at its first control
  /// point. Throws ValueError if the spline ends before `origin`.
  SplineTrajectory(BSpline spline, double origin);

  int dimension() const override { return spline_.dimension(); }
  double duration() const override { return duration_; }

  /// At the end, velocity and acceleration are the left-hand limits; those of the spline itself are zero there.
  void evalTo(double t, double* q, double* velocity, double* acceleration) const override;

  const BSpline& spline() const { return spline_; }

 private:
  BSpline spline_;
  double origin_, duration_;
};

}  // namespace kinegraph
