#pragma once

namespace kinegraph {

// The rows of a JerkLimitedProgram, for eight intervals side by side. Numbers of intervals are in arrays that go on for
// kLanes beyond the last one. Nothing in this file owns memory or has inline functions, because it is shared with code
// for other instruction sets.

struct JerkLimitedKernel {
  static constexpr int kLanes = 8;

  /// |r b + offset| <= size in each of eight intervals, with the slacks and multipliers of both sides, and how these
  /// are to change. In an interval, b are its three Bernstein coefficients.
  struct Rows {
    double r[3][kLanes], offset[kLanes], size[kLanes];
    double slack[2][kLanes], dual[2][kLanes], slack_step[2][kLanes], dual_step[2][kLanes];
  };

  /// Rows of the intervals from `first` on, a kind after the other: those as above, and those whose size is to be divided
  /// by the root of b where the interval begins, and where it ends.
  struct Block {
    int first, plain, at_begin, at_end;
    Rows* rows;
  };

  /// b, or a change of it: coefficients at the knots and in the middle of intervals.
  struct Coefficients {
    const double *knots, *middle;
  };

  /// What rows add to a Newton step, on the coefficients of each interval: to the gradient, of which one part is to be
  /// multiplied by the barrier, and to the matrix (00, 10, 11, 20, 21, 22). The sum of slacks times multipliers, and by
  /// how much a limit is missed at most, in parts.
  struct Sums {
    double *slope[3], *slope_by_barrier[3], *matrix[6];
    double gap[kLanes], missed[kLanes];
  };

  /// The largest relative decreases of a slack and of a multiplier, in parts.
  struct Falls {
    double slack[kLanes], dual[kLanes];
  };

  /// Slacks as they are, `least` at least, and multipliers that fit this barrier.
  void (*begin)(const Coefficients& b, const double* roots, const Block* blocks, int count, double barrier,
                double least);

  /// Slacks and multipliers go on by these shares of their steps. `roots` are 1 / sqrt(b) at the knots.
  void (*take)(const Coefficients& b, const double* roots, const Block* blocks, int count, double slack_share,
               double dual_share, Sums& sums);

  /// How slacks and multipliers are to change where b changes by `step`.
  void (*findSteps)(const Coefficients& b, const double* roots, const Coefficients& step, const Block* blocks,
                    int count, double barrier, Falls& falls);
};

/// That for `width` of laneWidths(), 0 for the widest.
const JerkLimitedKernel& smoothKernel(int width = 0);

namespace lanes {
/// One per instruction set.
extern const JerkLimitedKernel kSmoothKernelBase, kSmoothKernelAvx2, kSmoothKernelAvx512;
}  // namespace lanes

}  // namespace kinegraph
