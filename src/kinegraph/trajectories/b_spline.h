#pragma once

#include <string>

#include "kinegraph/math/pose.h"

namespace kinegraph {

/// A motion x(t) of d numbers as a B-spline: control points c_i, and knots that say when each counts.
///
///     x(t) = sum_i B_i(t) c_i
///
/// The users' points stand at times; a spline of degree 2 or more comes near inner points and does not pass through
/// them. First and last point are repeated (*duplicates*, floor(degree / 2) of each), so that it starts and ends at
/// them, at rest or with a velocity that is given. Before its first knot it is at the first control point, from its last
/// knot on at the last one; its derivatives are zero there. At a knot where a derivative jumps it is that of what follows.
/// Source: de Boor, A Practical Guide to Splines, ch. IX-X.
class BSpline {
 public:
  BSpline() = default;

  /// The same as `set`.
  BSpline(int degree, const MatrixXd& points, const VectorXd& times, const VectorXd& start_velocity = {},
          const VectorXd& end_velocity = {});

  /// Takes `times` (n,) in s for the points to come, of which there will be n and the duplicates. The first and the last
  /// time are knots degree + 1 times. Between them, knots of an odd degree are the inner times, those of an even one the
  /// midpoints of neighbors. Forgets the control points. Throws ValueError for a degree outside of 0..9, for less than
  /// two times, for times that fall or are not finite, and if they are all the same.
  BSpline& setKnots(int degree, const VectorXd& times);

  /// Takes `points` (n x d), one row each. Duplicates at an end are added, or are among the points already. With a
  /// velocity (d,) at an end, of a degree of at least 2, its duplicates are moved so that the motion has it there.
  /// Throws ValueError for a wrong number of points or sizes, and for numbers that are not finite.
  BSpline& setCtrlPoints(const MatrixXd& points, bool add_start_duplicates = true, bool add_end_duplicates = true,
                         const VectorXd& start_velocity = {}, const VectorXd& end_velocity = {});

  /// Both. On an error the spline is as it was.
  BSpline& set(int degree, const MatrixXd& points, const VectorXd& times, const VectorXd& start_velocity = {},
               const VectorXd& end_velocity = {});

  /// Goes on to `points` (k x d) at `times` (k,) after the present end, s. Not `inside`, it passes through what was its
  /// end: at rest if it ended at rest, else with its velocity. Inside, that point becomes an inner one, and the last
  /// piece changes. Throws ValueError for wrong sizes, times that fall or are negative; then it is as it was.
  BSpline& append(const MatrixXd& points, const VectorXd& times, bool inside = false);

  /// Forgets all but where it is at `time_cut`, and how fast; goes on from there to `points` at `times` after it. Throws
  /// ValueError as `append`.
  BSpline& overwriteSmooth(const MatrixXd& points, const VectorXd& times, double time_cut);

  /// The motion, or its first, second, ... derivative, at these times: m x d. Throws ValueError if there are no control
  /// points yet, for a negative derivative and for times that are not numbers.
  MatrixXd eval(const VectorXd& times, int derivative = 0) const;
  VectorXd eval(double time, int derivative = 0) const;

  /// Position, velocity and acceleration at a time: 3 x d.
  MatrixXd eval3(double time) const;

  /// B (m x number of control points) of x = B c at these times, or of a derivative. With duplicates at an end their
  /// columns are added to that of the point that they repeat, so that B multiplies the points alone.
  MatrixXd getBmatrix(const VectorXd& times, bool start_duplicates = false, bool end_duplicates = false,
                      int derivative = 0) const;

  int degree() const { return degree_; }
  const VectorXd& getKnots() const { return knots_; }
  const MatrixXd& getCtrlPoints() const { return ctrl_points_; }  ///< one row each, duplicates included
  int dimension() const { return int(ctrl_points_.cols()); }      ///< d
  bool isEmpty() const { return ctrl_points_.rows() == 0; }       ///< has no control points yet
  double start() const;  ///< the first knot, s; throws ValueError without knots
  double end() const;    ///< the last one

  /// From what another one had. Throws ValueError if they do not fit.
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

}  // namespace kinegraph
