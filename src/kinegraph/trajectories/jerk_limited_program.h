#pragma once

#include <array>
#include <functional>
#include <vector>

#include "kinegraph/trajectories/jerk_limited_kernel.h"
#include "kinegraph/trajectories/scaling_grid.h"

namespace kinegraph {

/// How a section of a curve begins or ends.
struct SectionEnd {
  bool at_rest = true;
  double squared_speed = 0.;  ///< s'^2, where it is not at rest
  double acceleration = 0.;   ///< s'' there
};

/// Bernstein coefficients of b = s'^2 in an interval.
using Quadratic = std::array<double, 3>;

/// The fastest s'^2 =: b(s) with a continuous slope along a section of a curve, within limits of velocity, acceleration,
/// rows and jerk; see jerk_limited.h. b is quadratic in each interval of a grid, but for the first and the last one where
/// the section is at rest: there s is a cubic of time, and b grows with s^(4/3).
///
/// The unknowns are the middle coefficients c_k; a knot is the mean of its neighbors that makes the slope continuous.
/// Velocities and accelerations hold all along: a cap on all coefficients of b, and on the Bernstein coefficients of
/// q' b'/2 + q'' b. Rows of the caller hold at the knots, jerks at both ends of each interval.
class JerkLimitedProgram {
 public:
  /// `effort` must stay.
  JerkLimitedProgram(const ScalingGrid& grid, const MotionLimits& limits, const ConstraintSource& rows,
                     SectionEnd begin, SectionEnd end, const ScalingBudget& effort);

  /// Takes the shape `start` of b, in the middle of each interval of the grid, as where `improve` begins; `gap` is how far
  /// it is thought to be from the least duration, as a share.
  void begin(const std::vector<double>& start, double gap);

  /// Interior-point steps until the duration is within `gap` of the least one, as a share, and no limit is exceeded by
  /// more than `missed`, likewise. False if that takes more than so many steps. May be called again.
  bool improve(double gap, double missed, int most_steps);

  int first() const { return first_; }  ///< the first interval of the grid in which b is quadratic
  int count() const { return count_; }
  Quadratic at(int k) const { return {knots_[k], middle_[k], knots_[k + 1]}; }

  /// Divides the limits in interval k by these: of velocity, acceleration, jerk.
  void tighten(int k, const std::array<double, 3>& ratios);

 private:
  using Array = Eigen::ArrayXd;
  using Rows = JerkLimitedKernel::Rows;
  static constexpr int kLanes = JerkLimitedKernel::kLanes;
  static constexpr double kOpen = std::numeric_limits<double>::infinity();  ///< no limit
  enum Kind { kVelocity, kAcceleration, kJerk, kGiven };

  /// How far all may go until a slack, a multiplier or a coefficient ends.
  struct Steps {
    double primal = 1., dual = 1.;
  };
  /// Of all slacks times their multipliers; and by how much a limit is missed at most, as a share.
  struct Gap {
    double sum = 0., missed = 0.;
  };
  /// A row in an interval.
  struct RowPlace {
    Rows& rows;
    int lane;
    void add(double r0, double r1, double r2) { rows.r[0][lane] += r0, rows.r[1][lane] += r1, rows.r[2][lane] += r2; }
  };

  int rowsPerBlock() const { return int(kinds_.size()); }
  int beginRoots() const { return int(kinds_.size()) - 2 * jerks_; }
  /// Row r in interval k; at the end of the last interval for k = count().
  RowPlace row(int r, int k);
  void addBlocks();
  void addMotionRows(const ScalingGrid& grid, const MotionLimits& limits);
  void addGivenRows(const ScalingGrid& grid, const ConstraintSource& rows);
  void addCaps(const ScalingGrid& grid, const MotionLimits& limits);
  double restCap(const ScalingGrid& grid, const MotionLimits& limits, bool at_begin) const;
  void placeKnots();
  double duration() const;
  void slowDown();
  void takeRootsNow();
  void parallelFor(const std::function<void(const JerkLimitedKernel::Block*, int)>& visit) const;
  void addCost();
  void assemble();
  void spread(int k);
  void solveBand();
  Steps findSteps();
  Gap take(const Steps& steps);

  int first_, count_;
  SectionEnd ends_[2];
  double given_[2] = {0., 0.};  ///< middle coefficients of the first and last interval, where it is not at rest
  const ScalingBudget& effort_;
  double rest_width_[2] = {0., 0.};
  Array width_, left_, right_;  ///< knot k = left_[k] c_(k-1) + right_[k] c_k
  Array middle_, knots_, middle_step_, knot_step_;
  Array roots_;              ///< 1 / sqrt(b) at the knots
  std::vector<Kind> kinds_;  ///< of the rows of a block: velocity, acceleration, given; jerk where intervals begin, end
  int jerks_ = 0;            ///< dofs whose jerk is limited
  std::vector<Rows> rows_;
  std::vector<JerkLimitedKernel::Block> blocks_;  ///< the last one has what holds at the end
  Array slope_[3], by_barrier_[3], matrix_[6];    ///< on the coefficients of each interval, see JerkLimitedKernel::Sums
  std::vector<std::array<double, 3>> band_;       ///< diagonal, and one and two below it
  std::vector<double> gradient_;
  double barrier_ = 0.;
  Gap gap_;
};

}  // namespace kinegraph
