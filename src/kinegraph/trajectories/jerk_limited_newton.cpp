#include <algorithm>
#include <cmath>

#include "kinegraph/trajectories/jerk_limited_program.h"

// The interior-point steps of a JerkLimitedProgram.

namespace kinegraph::inline trajectories_internal {

namespace {

constexpr double kFirstSlack = 1e-3;  // relative to a limit, at least
constexpr double kStartMargin = .7;   // share of each limit for the start
constexpr double kToBoundary = .95;   // of the step at which a slack vanishes
constexpr int kBlocksAtOnce = 64;     // between two checks for cancellation
constexpr double kFixed = 1e30;       // diagonal entry of fixed coefficients

}  // namespace

void JerkLimitedProgram::placeKnots() {
  knots_.head(count_) = right_.head(count_) * middle_.head(count_);
  knots_[count_] = 0.;
  knots_.segment(1, count_) += left_.tail(count_) * middle_.head(count_);
  roots_.head(count_ + 1) = knots_.head(count_ + 1).sqrt().inverse();
}

double JerkLimitedProgram::duration() const {
  const auto b0 = knots_.head(count_), b2 = knots_.segment(1, count_);
  const auto mean_root = (.25 * (b0 + 2. * middle_.head(count_) + b2)).sqrt().inverse();
  const double time = (width_ / 6. * (roots_.head(count_) + 4. * mean_root + roots_.segment(1, count_))).sum();
  return time + 3. * rest_width_[0] * roots_[0] + 3. * rest_width_[1] * roots_[count_];
}

/// Calls visit(blocks, count) for all blocks, in parts, with checks for cancellation.
void JerkLimitedProgram::forBlocks(const std::function<void(const JerkLimitedKernel::Block*, int)>& visit) const {
  const int count = int(blocks_.size());
  for (int n = 0; n < count; n += kBlocksAtOnce) {
    budget_.cancellation.check();
    visit(blocks_.data() + n, std::min(kBlocksAtOnce, count - n));
  }
}

/// Scales b down until all limits have slack: accelerations are linear in b, jerks grow with b^(3/2).
void JerkLimitedProgram::slowDown() {
  placeKnots();
  using Lanes = Eigen::Map<const Eigen::Array<double, kLanes, 1>>;
  Eigen::Array<double, kLanes, 1> factor = Eigen::Array<double, kLanes, 1>::Ones(), of_jerk = factor;
  for (const JerkLimitedKernel::Block& block : blocks_) {
    budget_.poll(block.first);
    const auto b0 = knots_.segment<kLanes>(block.first), b1 = middle_.segment<kLanes>(block.first),
               b2 = knots_.segment<kLanes>(block.first + 1);
    const auto root0 = roots_.segment<kLanes>(block.first), root2 = roots_.segment<kLanes>(block.first + 1);
    const int all = block.plain + block.at_begin + block.at_end;
    for (int r = 0; r < all; ++r) {
      const Rows& row = block.rows[r];
      const auto value = (Lanes(row.r[0]) * b0 + Lanes(row.r[1]) * b1 + Lanes(row.r[2]) * b2).abs().max(1e-300);
      const auto available = kStartMargin * (Lanes(row.size) - Lanes(row.offset).abs());
      if (r < block.plain) {
        factor = factor.min(available / value);
      } else if (r < block.plain + block.at_begin) {
        of_jerk = of_jerk.min(available * root0 / value);
      } else {
        of_jerk = of_jerk.min(available * root2 / value);
      }
    }
  }
  const double jerk = of_jerk.minCoeff();
  middle_.head(count_) *= std::min(factor.minCoeff(), std::cbrt(jerk * jerk));
  placeKnots();
}

/// Multiplies the rows of the jerk by the present root of b.
void JerkLimitedProgram::scaleJerkRows() {
  for (int k = 0; k < count_; ++k) {
    budget_.poll(k);
    for (int end = 0; end < 2; ++end) {
      const double unit = 1. / roots_[k + end];
      for (int j = 0; j < jerks_; ++j) {
        const RowPlace place = row(beginRoots() + end * jerks_ + j, k);
        const double factor = unit / place.rows.size[place.lane];
        for (auto& r : place.rows.r) r[place.lane] *= factor;
        place.rows.size[place.lane] = unit;
      }
    }
  }
}

void JerkLimitedProgram::begin(const std::vector<double>& start, double gap) {
  for (int k = 0; k < count_; ++k) middle_[k] = start[std::size_t(first_ + k)];
  slowDown();
  scaleJerkRows();
  barrier_ = gap * duration() / (2. * kLanes * double(rows_.size()));
  forBlocks([&](const JerkLimitedKernel::Block* blocks, int count) {
    jerkLimitedKernel().begin({knots_.data(), middle_.data()}, roots_.data(), blocks, count, barrier_, kFirstSlack);
  });
}

/// Adds the gradient and the symmetric matrix on the coefficients of interval k.
void JerkLimitedProgram::spread(int k) {
  const double l0 = left_[k], r0 = right_[k], l1 = left_[k + 1], r1 = right_[k + 1];
  const double g[3] = {slope_[0][k], slope_[1][k], slope_[2][k]};
  double m[6];
  for (int i = 0; i < 6; ++i) m[i] = matrix_[i][k];
  // coefficients = (l0 c_(k-1) + r0 c_k, c_k, l1 c_k + r1 c_(k+1))
  gradient_[k] += r0 * g[0] + g[1] + l1 * g[2];
  const double v0 = m[0] * r0 + m[1] + m[3] * l1, v1 = m[1] * r0 + m[2] + m[4] * l1, v2 = m[3] * r0 + m[4] + m[5] * l1;
  band_[k][0] += r0 * v0 + v1 + l1 * v2;
  if (k > 0) {
    gradient_[k - 1] += l0 * g[0];
    band_[k - 1][0] += l0 * l0 * m[0];
    band_[k][1] += l0 * v0;
  }
  if (k + 1 < count_) {
    gradient_[k + 1] += r1 * g[2];
    band_[k + 1][0] += r1 * r1 * m[5];
    band_[k + 1][1] += r1 * v2;
    if (k > 0) band_[k + 1][2] += l0 * r1 * m[3];
  }
}

/// Adds the duration, w b^(-1/2) at both ends and at the mean of b by Simpson's rule, and the barrier of c > 0.
void JerkLimitedProgram::addCost() {
  const auto at_begin = roots_.head(count_), at_end = roots_.segment(1, count_), middle = middle_.head(count_);
  const Array mean_root = (.25 * (knots_.head(count_) + 2. * middle + knots_.segment(1, count_))).sqrt().inverse();
  Array w0 = width_ / 6., w1 = w0;
  w0[0] += 3. * rest_width_[0], w1[count_ - 1] += 3. * rest_width_[1];
  const Array mean_cube = mean_root.cube(), begin_cube = at_begin.cube(), end_cube = at_end.cube();
  const Array mean_slope = -width_ / 12. * mean_cube, mean_curvature = width_ / 32. * mean_cube * mean_root.square();
  const Array inverse = middle.inverse();
  const auto part = [&](Array& array) { return array.head(count_); };
  part(slope_[0]) += barrier_ * part(by_barrier_[0]) + mean_slope - .5 * w0 * begin_cube;
  part(slope_[1]) += barrier_ * part(by_barrier_[1]) + 2. * mean_slope - barrier_ * inverse;
  part(slope_[2]) += barrier_ * part(by_barrier_[2]) + mean_slope - .5 * w1 * end_cube;
  part(matrix_[0]) += mean_curvature + .75 * w0 * begin_cube * at_begin.square();
  part(matrix_[1]) += 2. * mean_curvature;
  part(matrix_[2]) += 4. * mean_curvature + barrier_ * inverse.square();
  part(matrix_[3]) += mean_curvature;
  part(matrix_[4]) += 2. * mean_curvature;
  part(matrix_[5]) += mean_curvature + .75 * w1 * end_cube * at_end.square();
}

void JerkLimitedProgram::assemble() {
  addCost();
  std::fill(band_.begin(), band_.end(), std::array<double, 3>{0., 0., 0.});
  std::fill(gradient_.begin(), gradient_.end(), 0.);
  for (int k = 0; k < count_; ++k) {
    budget_.poll(k);
    spread(k);
  }
  for (int end = 0; end < 2; ++end) {
    const int k = end == 0 ? 0 : count_ - 1;
    if (!ends_[end].at_rest) band_[k][0] = kFixed, gradient_[k] = -kFixed * (fixed_middle_[end] - middle_[k]);
  }
}

/// middle_step_ = -band^-1 gradient, by L D L^T in place.
void JerkLimitedProgram::solveBand() {
  for (int k = 0; k < count_; ++k) {
    budget_.poll(k);
    auto& [d, one, two] = band_[k];
    middle_step_[k] = -gradient_[k];
    if (k > 1) {
      const double factor = two / band_[k - 2][0];
      d -= factor * two;
      one -= factor * band_[k - 1][1];  // (k, k-2) (k-1, k-2) / d; (k-1, k-2) is stored times d
      middle_step_[k] -= factor * middle_step_[k - 2];
      two = factor;
    }
    if (k > 0) {
      const double factor = one / band_[k - 1][0];
      d -= factor * one;
      middle_step_[k] -= factor * middle_step_[k - 1];
    }
  }
  for (int k = count_ - 1; k >= 0; --k) {
    double value = middle_step_[k];
    if (k + 1 < count_) value -= band_[k + 1][1] * middle_step_[k + 1];
    middle_step_[k] = value / band_[k][0];
    if (k + 2 < count_) middle_step_[k] -= band_[k + 2][2] * middle_step_[k + 2];
  }
  for (int k = 0; k <= count_; ++k)
    knot_step_[k] = (k > 0 ? left_[k] * middle_step_[k - 1] : 0.) + (k < count_ ? right_[k] * middle_step_[k] : 0.);
}

JerkLimitedProgram::Steps JerkLimitedProgram::findSteps() {
  JerkLimitedKernel::Falls falls{};
  forBlocks([&](const JerkLimitedKernel::Block* blocks, int count) {
    jerkLimitedKernel().findSteps({knots_.data(), middle_.data()}, roots_.data(),
                                  {knot_step_.data(), middle_step_.data()}, blocks, count, barrier_, falls);
  });
  double primal = (-middle_step_.head(count_) / middle_.head(count_)).maxCoeff(), dual = 0.;
  for (int i = 0; i < kLanes; ++i) primal = std::max(primal, falls.slack[i]), dual = std::max(dual, falls.dual[i]);
  return {primal > kToBoundary ? kToBoundary / primal : 1., dual > kToBoundary ? kToBoundary / dual : 1.};
}

/// Takes a step, and sums up the terms of the next Newton system.
JerkLimitedProgram::Gap JerkLimitedProgram::take(const Steps& steps) {
  middle_ += steps.primal * middle_step_;
  placeKnots();
  JerkLimitedKernel::Sums sums{};
  for (int x = 0; x < 3; ++x) {
    slope_[x].setZero(), by_barrier_[x].setZero();
    sums.slope[x] = slope_[x].data(), sums.slope_by_barrier[x] = by_barrier_[x].data();
  }
  for (int m = 0; m < 6; ++m) matrix_[m].setZero(), sums.matrix[m] = matrix_[m].data();
  forBlocks([&](const JerkLimitedKernel::Block* blocks, int count) {
    jerkLimitedKernel().take({knots_.data(), middle_.data()}, roots_.data(), blocks, count, steps.primal, steps.dual,
                             sums);
  });
  Gap gap;
  for (int i = 0; i < kLanes; ++i) gap.sum += sums.gap[i], gap.violation = std::max(gap.violation, sums.violation[i]);
  for (int end = 0; end < 2; ++end)
    if (!ends_[end].at_rest)
      gap.violation = std::max(gap.violation, std::abs(middle_[end ? count_ - 1 : 0] / fixed_middle_[end] - 1.));
  return gap;
}

bool JerkLimitedProgram::improve(double gap, double violation, int max_steps) {
  gap_ = take({0., 0.});
  for (int i = 0; i < max_steps; ++i) {
    assemble();
    solveBand();
    const Steps steps = findSteps();
    gap_ = take(steps);
    const double step = std::min(steps.primal, steps.dual);
    barrier_ = (step > .8 ? .1 : step > .4 ? .3 : 1.) * gap_.sum / (2. * kLanes * double(rows_.size()));
    if (!std::isfinite(gap_.sum) || (gap_.sum <= gap * duration() && gap_.violation <= violation)) break;
  }
  if (!(gap_.violation <= violation) || !middle_.allFinite()) return false;
  for (int end = 0; end < 2; ++end)
    if (!ends_[end].at_rest) middle_[end ? count_ - 1 : 0] = fixed_middle_[end];
  placeKnots();
  return true;
}

void JerkLimitedProgram::tighten(int k, const std::array<double, 3>& ratios) {
  const auto divide = [&](int r, int interval, double ratio) {
    const RowPlace place = row(r, interval);
    place.rows.size[place.lane] /= ratio;
  };
  for (int r = 0; r < rowsPerBlock(); ++r) {
    const double ratio = kinds_[std::size_t(r)] == kVelocity     ? ratios[kVelocity] * ratios[kVelocity]
                         : kinds_[std::size_t(r)] == kConstraint ? 1.
                                                                 : ratios[kinds_[std::size_t(r)]];
    if (ratio == 1.) continue;
    divide(r, k, ratio);
    if (r < beginRoots() && (r == 0 || k == count_ - 1)) divide(r, k + 1, ratio);
  }
}

}  // namespace kinegraph::inline trajectories_internal
