#pragma once

#include <array>
#include <functional>
#include <limits>
#include <vector>

#include "kinegraph/trajectories/jerk_limited_kernel.h"
#include "kinegraph/trajectories/scaling_grid.h"

namespace kinegraph::inline trajectories_internal {

/// Start or end of a section of a curve.
struct SectionEnd {
  bool at_rest = true;
  double squared_speed = 0.;  ///< s'^2, if it is not at rest
  double acceleration = 0.;   ///< s'' there
};

/// Bernstein coefficients of b = s'^2 in an interval.
using Quadratic = std::array<double, 3>;

/// The program for the fastest s'^2 =: b(s) with a continuous slope along a section of a curve, within limits of
/// velocity, acceleration and jerk, and constraints; see jerk_limited.h. b is quadratic in each interval of a grid,
/// except for a first or last interval at rest: there s is a cubic of time, and b grows with s^(4/3).
///
/// The unknowns are the middle coefficients c_k; a knot is the weighted mean of its neighbors that makes the slope
/// continuous. Velocity and acceleration limits hold throughout, as bounds on all coefficients of b and on the
/// Bernstein coefficients of q' b'/2 + q'' b. Constraints of the caller hold at the knots, jerk limits at both ends of
/// each interval.
class JerkLimitedProgram {
 public:
  /// Keeps a reference to `budget`.
  JerkLimitedProgram(const ScalingGrid& grid, const MotionLimits& limits, const ConstraintSource& rows,
                     SectionEnd begin, SectionEnd end, const ScalingBudget& budget);

  /// Sets the initial guess of `improve`: the shape of b in the middle of each interval of the grid, and its estimated
  /// relative distance `gap` from the least duration.
  void begin(const std::vector<double>& start, double gap);

  /// Takes interior-point steps until the duration is within the relative `gap` of the least one, and all relative
  /// violations of limits are at most `violation`. Returns false after max_steps. May be called again.
  bool improve(double gap, double violation, int max_steps);

  /// Tells whether b is a positive number everywhere, so that some multiple of it keeps the limits.
  bool isFinite() const { return middle_.head(count_).allFinite() && (middle_.head(count_) > 0.).all(); }

  int first() const { return first_; }  ///< the first interval of the grid with a quadratic b
  int count() const { return count_; }
  Quadratic at(int k) const { return {knots_[k], middle_[k], knots_[k + 1]}; }

  /// Divides the limits of velocity, acceleration and jerk in interval k by these ratios.
  void tighten(int k, const std::array<double, 3>& ratios);

 private:
  using Array = Eigen::ArrayXd;
  using Rows = JerkLimitedKernel::Rows;
  static constexpr int kLanes = JerkLimitedKernel::kLanes;
  static constexpr double kOpen = std::numeric_limits<double>::infinity();  ///< no limit
  enum Kind { kVelocity, kAcceleration, kJerk, kConstraint };

  /// Largest shares of the primal and the dual step that keep slacks, multipliers and coefficients positive.
  struct Steps {
    double primal = 1., dual = 1.;
  };
  /// Sum of slacks times multipliers, and the largest relative violation of a limit.
  struct Gap {
    double sum = 0., violation = 0.;
  };
  /// A constraint row in an interval.
  struct RowPlace {
    Rows& rows;
    int lane;
    void add(double r0, double r1, double r2) { rows.r[0][lane] += r0, rows.r[1][lane] += r1, rows.r[2][lane] += r2; }
  };

  int rowsPerBlock() const { return int(kinds_.size()); }
  int beginRoots() const { return int(kinds_.size()) - 2 * jerks_; }
  /// Returns row r in interval k; k = count() stands for the end of the last interval.
  RowPlace row(int r, int k);
  void addBlocks();
  void addMotionRows(const ScalingGrid& grid, const MotionLimits& limits);
  void addConstraints(const ScalingGrid& grid, const ConstraintSource& rows);
  void addCaps(const ScalingGrid& grid, const MotionLimits& limits);
  double restCap(const ScalingGrid& grid, const MotionLimits& limits, bool at_begin) const;
  void placeKnots();
  double duration() const;
  void slowDown();
  void scaleJerkRows();
  void forBlocks(const std::function<void(const JerkLimitedKernel::Block*, int)>& visit) const;
  void addCost();
  void assemble();
  void spread(int k);
  void solveBand();
  Steps findSteps();
  Gap take(const Steps& steps);

  int first_, count_;
  SectionEnd ends_[2];
  double fixed_middle_[2] = {0., 0.};  ///< middle coefficients of the first and last interval, if not at rest
  const ScalingBudget& budget_;
  double rest_width_[2] = {0., 0.};
  Array width_, left_, right_;  ///< knot k = left_[k] c_(k-1) + right_[k] c_k
  Array middle_, knots_, middle_step_, knot_step_;
  Array roots_;  ///< 1 / sqrt(b) at the knots
  /// Kinds of the rows of a block: velocity, acceleration, constraint, jerk at the start and the end of intervals.
  std::vector<Kind> kinds_;
  int jerks_ = 0;  ///< number of dofs with a jerk limit
  std::vector<Rows> rows_;
  std::vector<JerkLimitedKernel::Block> blocks_;  ///< the last one has the rows at the end of the section
  Array slope_[3], by_barrier_[3], matrix_[6];    ///< per interval, see JerkLimitedKernel::Sums
  std::vector<std::array<double, 3>> band_;       ///< diagonal, first and second subdiagonal
  std::vector<double> gradient_;
  double barrier_ = 0.;
  Gap gap_;
};

}  // namespace kinegraph::inline trajectories_internal
