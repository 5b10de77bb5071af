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
  enum Kind { kVelocity, kAcceleration, kJerk, kGiven };

  /// |r b + offset| <= size, or size / sqrt(b[root]) where a root is given.
  struct Row {
    Quadratic r;
    double offset, size;
    int root;
    Kind kind;
    double slack[2], dual[2];
  };
  /// c_k or a knot is at most `limit`.
  struct Cap {
    double limit, slack, dual;
  };
  /// One inequality h <= 0 at the present point.
  struct Side {
    double h, along_root;
  };

  void addRows(int k, const LawGrid& grid, const MotionLimits& limits);
  void addGivenRows(int k, const LawGrid& grid, const RowSource& rows);
  void addCaps(const LawGrid& grid, const MotionLimits& limits);
  double restCap(const LawGrid& grid, const MotionLimits& limits, bool at_begin) const;
  void placeKnots();
  Side sideOf(const Row& row, const Quadratic& b, int side) const;
  template <class Visit>
  void forCaps(const Visit& visit);
  double duration() const;
  void slowDown();
  void begin(double barrier);
  void assemble(double barrier);
  void addCost(int k, const Quadratic& b, double weight, int at);
  void spread(int k, const double gradient[3], const double matrix[6]);
  void solveBand();
  struct Steps {
    double primal = 1., dual = 1.;
  };
  Steps findSteps(double barrier) const;
  void take(const Steps& steps, double barrier);
  double gapSum(int* count = nullptr, double* infeasible = nullptr) const;

  int first_, count_;
  SectionEnd ends_[2];
  double rest_width_[2] = {0., 0.};
  std::vector<double> width_, left_, right_;  ///< knot k = left_[k] c_(k-1) + right_[k] c_k
  std::vector<double> middle_, knots_, middle_step_, knot_step_;
  std::vector<Row> rows_;
  std::vector<int> row_begin_;
  std::vector<Cap> middle_caps_, knot_caps_;
  std::vector<std::array<double, 3>> band_;  ///< diagonal, and one and two below it
  std::vector<double> gradient_;
};

}  // namespace kinegraph
