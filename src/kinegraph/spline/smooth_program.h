#pragma once

#include <array>
#include <vector>

#include "kinegraph/spline/law_grid.h"

namespace kinegraph {

/// How a section of a curve begins or ends.
struct SectionEnd {
  bool at_rest = true;
  double squared_speed = 0.;  ///< s'^2, where it is not at rest; s'' is zero there
};

/// Bernstein coefficients of b = s'^2 in an interval.
using Quadratic = std::array<double, 3>;

/// The fastest s'^2 =: b(s) with a continuous slope along a section of a curve, within limits of velocity, acceleration,
/// rows and jerk; see jerk_limited.h. b is quadratic in each interval of a grid, but for the first and the last one where
/// the section is at rest: there s is a cubic of time, and b grows with s^(4/3).
///
/// The unknowns are the middle coefficients c_k; a knot is the mean of its neighbors that makes the slope continuous.
class SmoothProgram {
 public:
  SmoothProgram(const LawGrid& grid, const MotionLimits& limits, const RowSource& rows, SectionEnd begin,
                SectionEnd end);

  /// Interior-point steps from the shape `start` of b, in the middle of each interval of the grid, until the duration is
  /// within `gap` of the least one, as a share; `first_gap` is how far it is thought to be at first. False if no law
  /// within the limits was found.
  bool solve(const std::vector<double>& start, double first_gap, double gap, int most_steps);

  int first() const { return first_; }  ///< the first interval of the grid in which b is quadratic
  int count() const { return count_; }
  Quadratic at(int k) const { return {knots_[k], middle_[k], knots_[k + 1]}; }

  /// Divides the limits in interval k by these: of velocity, acceleration, jerk.
  void tighten(int k, const std::array<double, 3>& ratios);

 private:
  using Array = Eigen::ArrayXd;
  static constexpr double kOpen = std::numeric_limits<double>::infinity();  ///< no limit
  enum Kind { kVelocity, kAcceleration, kJerk, kGiven };

  /// Rows |r b + offset| <= size, or size / sqrt(b[root]) where a root is given: one of a kind in each of consecutive
  /// intervals, which are computed side by side.
  struct Strip {
    Kind kind;
    int root, first;  ///< -1, 0 or 2; the first interval
    Array r[3], offset, size;
    Array slack[2], dual[2];            ///< of both sides
    Array slack_step[2], dual_step[2];  ///< found last
    int count() const { return int(size.size()); }
  };
  /// c_k or a knot is at most `limit`.
  struct Cap {
    double limit, slack, dual, slack_step = 0., dual_step = 0.;
  };
  /// h <= 0 of both sides at the present b, and the slope of both along the coefficient whose root divides the size.
  template <int N>
  struct Sides {
    Eigen::Array<double, N, 1> h[2], along_root;
  };
  struct Steps {
    double primal = 1., dual = 1.;
  };
  /// Of all slacks times their multipliers; and by how much a limit is missed at most, as a share.
  struct Gap {
    double sum = 0., infeasible = 0.;
  };

  Strip& addStrip(Kind kind, int root, int first, int count);
  void addRows(const LawGrid& grid, const MotionLimits& limits);
  void addGivenRows(const LawGrid& grid, const RowSource& rows);
  void addCaps(const LawGrid& grid, const MotionLimits& limits);
  double restCap(const LawGrid& grid, const MotionLimits& limits, bool at_begin) const;
  void placeKnots();
  template <int N>
  Sides<N> sidesOf(const Strip& strip, Eigen::Index i) const;
  template <class Visit>
  void forCaps(const Visit& visit);
  int inequalities();
  double duration() const;
  void slowDown();
  void begin(double barrier);
  void assemble(double barrier);
  void addStrips(double barrier);
  void addCaps(double barrier);
  void spread(int k);
  void solveBand();
  Steps findSteps(double barrier);
  Gap take(const Steps& steps);

  int first_, count_;
  SectionEnd ends_[2];
  double rest_width_[2] = {0., 0.};
  Array width_, left_, right_;  ///< knot k = left_[k] c_(k-1) + right_[k] c_k
  Array middle_, knots_, middle_step_, knot_step_;
  Array roots_;  ///< 1 / sqrt(b) at the knots
  std::vector<Strip> strips_;
  std::vector<Cap> middle_caps_, knot_caps_;
  Array slope_[3], matrix_[6];               ///< on the coefficients of each interval: 0, 1, 2; 00, 10, 11, 20, 21, 22
  std::vector<std::array<double, 3>> band_;  ///< diagonal, and one and two below it
  std::vector<double> gradient_;
};

}  // namespace kinegraph
