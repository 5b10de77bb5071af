#pragma once

// The step of inverse kinematics for numbers S that are double or packs of doubles (one problem per lane). Like
// lane_math.h it is local to each source file that includes it. DampedStep and the kernels in lanes use it.
//
// The rows themselves, errors and Jacobians of the targets, are computed separately: see IkIterate.

#include "kinegraph/math/lane_math.h"

namespace kinegraph::lanes {

namespace {

/// Returns a damping that is small near the targets, so that convergence is quadratic. `square`: sum of squares of all
/// rows.
template <class S>
S dampingOf(S square) {
  constexpr double kLeast = 1e-9, kPerSquare = 1e-2, kMostSquares = 10.;
  return kLeast + kPerSquare * smaller(square, all<S>(kMostSquares));
}

/// The bounded damped least squares problem of DampedStep, and memory to solve it in.
template <class S>
struct DampedRows {
  int rows, variables;
  const S* jacobian;                      ///< (variables, rows)
  const S* error;                         ///< (rows)
  const S* preferred;                     ///< (variables), or null
  const S* x;                             ///< (variables)
  const double *lower, *upper, *longest;  ///< (variables)
  S* keep;                                ///< (variables): 0 for variables that are held at a bound
  S* next;                                ///< (variables): the step, finally the x it leads to
  S *A, *y, *inverse_pivots;              ///< scratch (rows, rows), (rows), (rows)
};

/// Computes the lower triangle of A = J keep J^T + damping, and y = error - J keep preferred.
template <int Rows, class S>
[[gnu::always_inline]] inline void formRows(const DampedRows<S>& p, S damping) {
  const int m = Rows > 0 ? Rows : p.rows;
  for (int r = 0; r < m; ++r) {
    for (int s = 0; s < r; ++s) p.A[r * m + s] = S{};
    p.A[r * m + r] = damping;
    p.y[r] = p.error[r];
  }
  for (int v = 0; v < p.variables; ++v) {
    const S* J = p.jacobian + long(v) * m;
    for (int r = 0; r < m; ++r) {
      const S kept = p.keep[v] * J[r];
      for (int s = 0; s <= r; ++s) p.A[r * m + s] += kept * J[s];
    }
    if (!p.preferred) continue;
    for (int r = 0; r < m; ++r) p.y[r] -= J[r] * (p.keep[v] * p.preferred[v]);
  }
}

/// Replaces y by A^-1 y. A pivot that rounding made tiny or negative is replaced by a thousandth of the damping, its
/// smallest possible value.
template <int Rows, class S>
[[gnu::always_inline]] inline void solveRows(const DampedRows<S>& p, S damping) {
  const int m = Rows > 0 ? Rows : p.rows;
  const S least = 1e-3 * damping;
  for (int r = 0; r < m; ++r) {  // A = L D L^T in place, and y = L^-1 y in the same pass
    S* row = p.A + r * m;
    for (int s = 0; s < r; ++s) {
      S value = row[s];
      for (int t = 0; t < s; ++t) value -= p.A[s * m + t] * row[t];
      row[s] = value;  // L_rs D_s
    }
    S pivot = row[r], right = p.y[r];
    for (int s = 0; s < r; ++s) {
      const S value = row[s] * p.inverse_pivots[s];
      pivot -= row[s] * value;
      row[s] = value;
      right -= value * p.y[s];
    }
    p.y[r] = right;
    p.inverse_pivots[r] = 1. / larger(pivot, least);
  }
  for (int r = m - 1; r >= 0; --r) {
    S value = p.y[r] * p.inverse_pivots[r];
    for (int s = r + 1; s < m; ++s) value -= p.A[s * m + r] * p.y[s];
    p.y[r] = value;
  }
}

/// Computes the step of the variables that no bound holds: next = keep (preferred + J^T A^-1 (error - J keep
/// preferred)).
template <int Rows, class S>
[[gnu::always_inline]] inline void stepOfKept(const DampedRows<S>& p, S damping) {
  const int m = Rows > 0 ? Rows : p.rows;
  formRows<Rows>(p, damping);
  solveRows<Rows>(p, damping);
  for (int v = 0; v < p.variables; ++v) {
    const S* J = p.jacobian + long(v) * m;
    S value{};
    for (int r = 0; r < m; ++r) value += J[r] * p.y[r];
    if (p.preferred) value += p.preferred[v];
    p.next[v] = p.keep[v] * value;
  }
}

/// Holds the variables at a bound that `next` would cross. Returns true if there was one.
template <class S>
[[gnu::always_inline]] inline bool holdAtBounds(const DampedRows<S>& p) {
  auto changed = S{} < S{};
  for (int v = 0; v < p.variables; ++v) {
    const auto crosses = ((p.next[v] < S{}) & (p.x[v] <= p.lower[v])) | ((p.next[v] > S{}) & (p.x[v] >= p.upper[v]));
    p.keep[v] = crosses ? S{} : p.keep[v];
    changed |= crosses;
  }
  return any(changed);
}

/// Divides a step by its excess. For packs one division serves all variables, because divisions dominate the run time
/// of the kernels; for single numbers the quotient is exact to rounding. Both differ in the last bit, and the recorded
/// answers of solveIk depend on both.
struct Scaled {
  template <class S>
  static S of(S step, S excess) {
    return (1. / excess) * step;
  }
  static double of(double step, double excess) { return step / excess; }
};

/// Scales the step down to the largest allowed one without changing its direction; variables without a largest step are
/// not scaled. Then clips it at the bounds and replaces `next` by the resulting x.
template <class S>
[[gnu::always_inline]] inline void moveWithinBounds(const DampedRows<S>& p) {
  constexpr double kUnlimited = 1e300;
  S excess = all<S>(1.);
  for (int v = 0; v < p.variables; ++v) excess = larger(excess, magnitude(p.next[v]) / p.longest[v]);
  for (int v = 0; v < p.variables; ++v) {
    const S step = p.longest[v] < kUnlimited ? Scaled::of(p.next[v], excess) : p.next[v];
    p.next[v] = smaller(larger(p.x[v] + step, all<S>(p.lower[v])), all<S>(p.upper[v]));
  }
}

/// Computes the whole step from x to next. Each pass solves again without the held variables. Few passes suffice in
/// practice; variables that cross a bound after the last one are clipped.
template <class S>
[[gnu::always_inline]] inline void dampedStep(const DampedRows<S>& p, S damping) {
  constexpr int kPasses = 4;
  for (int v = 0; v < p.variables; ++v) p.keep[v] = all<S>(1.);
  for (int pass = 0; pass < kPasses; ++pass) {
    switch (p.rows) {  // compile-time sizes for the frequent cases: a position or rotation, and a pose
      case 3:
        stepOfKept<3>(p, damping);
        break;
      case 6:
        stepOfKept<6>(p, damping);
        break;
      default:
        stepOfKept<0>(p, damping);
        break;
    }
    if (!holdAtBounds(p)) break;
  }
  moveWithinBounds(p);
}

}  // namespace

}  // namespace kinegraph::lanes
