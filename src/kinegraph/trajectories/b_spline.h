#pragma once

#include <string>

#include "kinegraph/math/pose.h"

namespace kinegraph {

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

}  // namespace kinegraph
