#pragma once

namespace kinegraph::inline trajectories_internal {

// The constraint rows of a JerkLimitedProgram, for eight intervals at once. Arrays over intervals have kLanes extra
// entries. Nothing in this file owns memory or has inline functions, because code for other instruction sets includes
// it.

struct JerkLimitedKernel {
  static constexpr int kLanes = 8;

  /// A row |r b + offset| <= size in each of eight intervals, with the slacks and multipliers of both sides and their
  /// Newton steps. b are the three Bernstein coefficients in an interval.
  struct Rows {
    double r[3][kLanes], offset[kLanes], size[kLanes];
    double slack[2][kLanes], dual[2][kLanes], slack_step[2][kLanes], dual_step[2][kLanes];
  };

  /// The rows of the intervals from `first` on: `plain` rows as above, then rows whose size is divided by the root of b
  /// at the start, then at the end of the interval.
  struct Block {
    int first, plain, at_begin, at_end;
    Rows* rows;
  };

  /// b, or a change of b: coefficients at the knots and in the middle of intervals.
  struct Coefficients {
    const double *knots, *middle;
  };

  /// The terms of the rows in a Newton system, per interval: gradient, gradient factor of the barrier parameter, and
  /// matrix (00, 10, 11, 20, 21, 22). Also, per lane, the sum of slacks times multipliers and the largest violation of
  /// a limit.
  struct Sums {
    double *slope[3], *slope_by_barrier[3], *matrix[6];
    double gap[kLanes], violation[kLanes];
  };

  /// The largest relative decreases of a slack and of a multiplier, per lane.
  struct Falls {
    double slack[kLanes], dual[kLanes];
  };

  /// Sets the slacks, at least to `least`, and the multipliers of this barrier parameter.
  void (*begin)(const Coefficients& b, const double* roots, const Block* blocks, int count, double barrier,
                double least);

  /// Advances slacks and multipliers by these shares of their steps. `roots` are 1 / sqrt(b) at the knots.
  void (*take)(const Coefficients& b, const double* roots, const Block* blocks, int count, double slack_share,
               double dual_share, Sums& sums);

  /// Computes the steps of slacks and multipliers for a `step` of b.
  void (*findSteps)(const Coefficients& b, const double* roots, const Coefficients& step, const Block* blocks,
                    int count, double barrier, Falls& falls);
};

/// Returns the kernel for a `width` of laneWidths(), 0 for the widest.
const JerkLimitedKernel& jerkLimitedKernel(int width = 0);

}  // namespace kinegraph::inline trajectories_internal

namespace kinegraph::lanes {
/// One kernel per instruction set.
extern const JerkLimitedKernel kJerkLimitedKernelBase, kJerkLimitedKernelAvx2, kJerkLimitedKernelAvx512;
}  // namespace kinegraph::lanes
