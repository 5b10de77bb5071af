#include <algorithm>
#include <cmath>

#include "kinegraph/spline/smooth_program.h"

// The interior-point steps of a SmoothProgram.

namespace kinegraph {

namespace {

constexpr double kFirstSlack = 1e-3;  // of a limit, at least
constexpr double kStartShare = .7;    // of each limit, that the start may use
constexpr double kToBoundary = .95;   // of the way to where a slack ends
constexpr double kFixed = 1e30;       // on the diagonal of what is given
constexpr double kFeasible = 1e-7;    // by which limits may be missed, as a share

template <int N>
using Pack = Eigen::Array<double, N, 1>;

/// Calls visit.operator()<N>(i) for four numbers i .. i + 3 at a time, and for those that are left.
template <class Visit>
void forPacks(Eigen::Index count, const Visit& visit) {
  Eigen::Index i = 0;
  for (; i + 4 <= count; i += 4) visit.template operator()<4>(i);
  for (; i < count; ++i) visit.template operator()<1>(i);
}

}  // namespace

void SmoothProgram::placeKnots() {
  knots_.head(count_) = right_.head(count_) * middle_;
  knots_[count_] = 0.;
  knots_.tail(count_) += left_.tail(count_) * middle_;
  roots_ = knots_.sqrt().inverse();
}

/// h = +-(r b + offset) - size(b).
template <int N>
[[gnu::always_inline]] inline SmoothProgram::Sides<N> SmoothProgram::sidesOf(const Strip& strip, Eigen::Index i) const {
  const Eigen::Index k = strip.first + i;
  const Pack<N> value = strip.r[0].segment<N>(i) * knots_.segment<N>(k) +
                        strip.r[1].segment<N>(i) * middle_.segment<N>(k) +
                        strip.r[2].segment<N>(i) * knots_.segment<N>(k + 1) + strip.offset.segment<N>(i);
  Pack<N> size = strip.size.segment<N>(i), along = Pack<N>::Zero();
  if (strip.root >= 0) {
    const Pack<N> root = roots_.segment<N>(k + strip.root / 2);
    size *= root;
    along = .5 * size * root * root;
  }
  return {{value - size, -value - size}, along};
}

template <class Visit>
void SmoothProgram::forCaps(const Visit& visit) {
  for (int k = 0; k < count_; ++k)
    if (middle_caps_[k].limit < kOpen) visit(middle_caps_[k], middle_[k], middle_step_[k]);
  for (int k = 0; k <= count_; ++k)
    if (knot_caps_[k].limit < kOpen) visit(knot_caps_[k], knots_[k], knot_step_[k]);
}

int SmoothProgram::inequalities() {
  int count = 0;
  for (const Strip& strip : strips_) count += 2 * strip.count();
  forCaps([&](Cap&, double, double) { ++count; });
  return count;
}

double SmoothProgram::duration() const {
  const auto b0 = knots_.head(count_), b2 = knots_.tail(count_);
  const auto mean_root = (.25 * (b0 + 2. * middle_ + b2)).sqrt().inverse();
  const double time = (width_ / 6. * (roots_.head(count_) + 4. * mean_root + roots_.tail(count_))).sum();
  return time + 3. * rest_width_[0] * roots_[0] + 3. * rest_width_[1] * roots_[count_];
}

void SmoothProgram::begin(double barrier) {
  for (Strip& strip : strips_) {
    if (strip.root >= 0) {  // rows of the jerk are taken times the root of b as it is now
      const Array unit = roots_.segment(strip.first + strip.root / 2, strip.count()).inverse();
      for (Array& r : strip.r) r *= unit / strip.size;
      strip.size = unit;
    }
    forPacks(strip.count(), [&]<int N>(Eigen::Index i) {
      const Sides<N> at = sidesOf<N>(strip, i);
      for (int side = 0; side < 2; ++side) {
        strip.slack[side].segment<N>(i) = (-at.h[side]).max(kFirstSlack);
        strip.dual[side].segment<N>(i) = barrier / strip.slack[side].segment<N>(i);
      }
    });
  }
  forCaps([&](Cap& cap, double value, double) {
    cap.slack = std::max(1. - value / cap.limit, kFirstSlack);
    cap.dual = barrier / cap.slack;
  });
}

/// Adds the gradient and the symmetric matrix on the coefficients of interval k.
void SmoothProgram::spread(int k) {
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

/// The rows' share of the Newton step's gradient and matrix. With the sides (a, weight, slope) of a row, a = +-r + along e,
/// those are the sums of slope a and of weight a a^T.
void SmoothProgram::addStrips(double barrier) {
  for (const Strip& strip : strips_) {
    forPacks(strip.count(), [&]<int N>(Eigen::Index i) {
      const Eigen::Index k = strip.first + i;
      const Sides<N> at = sidesOf<N>(strip, i);
      Pack<N> weight[2], slope[2];
      for (int side = 0; side < 2; ++side) {
        const Pack<N> slack = strip.slack[side].segment<N>(i), dual = strip.dual[side].segment<N>(i);
        const Pack<N> inverse = slack.inverse();
        weight[side] = dual * inverse;
        slope[side] = (barrier + dual * (at.h[side] + slack)) * inverse;
      }
      const Pack<N> r[3] = {strip.r[0].segment<N>(i), strip.r[1].segment<N>(i), strip.r[2].segment<N>(i)};
      const Pack<N> both = weight[0] + weight[1], pull = slope[0] - slope[1];
      int place = 0;
      for (int x = 0; x < 3; ++x) {
        slope_[x].segment<N>(k) += pull * r[x];
        const Pack<N> weighted = both * r[x];
        for (int y = 0; y <= x; ++y) matrix_[place++].segment<N>(k) += weighted * r[y];
      }
      if (strip.root < 0) return;
      const Pack<N> mixed = (weight[0] - weight[1]) * at.along_root;
      slope_[strip.root].segment<N>(k) += (slope[0] + slope[1]) * at.along_root;
      matrix_[strip.root == 0 ? 0 : 5].segment<N>(k) +=
          2. * mixed * r[strip.root] + both * at.along_root * at.along_root;
      matrix_[strip.root == 0 ? 1 : 4].segment<N>(k) += mixed * r[1];
      matrix_[3].segment<N>(k) += mixed * r[2 - strip.root];
    });
  }
}

/// The same of the caps on coefficients.
void SmoothProgram::addCaps(double barrier) {
  const auto add = [&](const Cap& cap, double value, double& slope, double& curvature) {
    if (!(cap.limit < kOpen)) return;
    const double inverse = 1. / cap.slack, unit = 1. / cap.limit, residual = value * unit - 1. + cap.slack;
    slope += (barrier + cap.dual * residual) * inverse * unit;
    curvature += cap.dual * inverse * unit * unit;
  };
  for (int k = 0; k < count_; ++k) {
    add(middle_caps_[k], middle_[k], slope_[1][k], matrix_[2][k]);
    add(knot_caps_[k], knots_[k], slope_[0][k], matrix_[0][k]);
  }
  add(knot_caps_[count_], knots_[count_], slope_[2][count_ - 1], matrix_[5][count_ - 1]);
}

void SmoothProgram::assemble(double barrier) {
  // the duration: w b^(-1/2) at both ends, and of the mean of b
  const auto at_begin = roots_.head(count_), at_end = roots_.tail(count_);
  const Array mean_root = (.25 * (knots_.head(count_) + 2. * middle_ + knots_.tail(count_))).sqrt().inverse();
  Array w0 = width_ / 6., w1 = w0;
  w0[0] += 3. * rest_width_[0], w1[count_ - 1] += 3. * rest_width_[1];
  const Array mean_slope = -width_ / 12. * mean_root.cube(),
              mean_curvature = width_ / 32. * mean_root.cube() * mean_root.square();
  slope_[0] = mean_slope - .5 * w0 * at_begin.cube();
  slope_[1] = 2. * mean_slope - barrier / middle_;  // the cost does not keep c from zero
  slope_[2] = mean_slope - .5 * w1 * at_end.cube();
  matrix_[0] = mean_curvature + .75 * w0 * at_begin.cube() * at_begin.square();
  matrix_[1] = matrix_[4] = 2. * mean_curvature;
  matrix_[2] = 4. * mean_curvature + barrier / middle_.square();
  matrix_[3] = mean_curvature;
  matrix_[5] = mean_curvature + .75 * w1 * at_end.cube() * at_end.square();
  addStrips(barrier);
  addCaps(barrier);
  std::fill(band_.begin(), band_.end(), std::array<double, 3>{0., 0., 0.});
  std::fill(gradient_.begin(), gradient_.end(), 0.);
  for (int k = 0; k < count_; ++k) spread(k);
  for (int end = 0; end < 2; ++end) {
    const int k = end == 0 ? 0 : count_ - 1;
    if (!ends_[end].at_rest) band_[k][0] = kFixed, gradient_[k] = -kFixed * (ends_[end].squared_speed - middle_[k]);
  }
}

/// middle_step_ = -band^-1 gradient, by L D L^T in place.
void SmoothProgram::solveBand() {
  for (int k = 0; k < count_; ++k) {
    auto& [d, one, two] = band_[k];
    middle_step_[k] = -gradient_[k];
    if (k > 1) {
      const double factor = two / band_[k - 2][0];
      d -= factor * two;
      one -= factor * band_[k - 1][1];  // (k, k-2) (k-1, k-2) / d, and (k-1, k-2) is kept times d below
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

/// How far all may go until a slack, a multiplier or a coefficient ends.
SmoothProgram::Steps SmoothProgram::findSteps(double barrier) {
  double primal = (-middle_step_ / middle_).maxCoeff(), dual = 0.;  // the largest relative decreases
  for (Strip& strip : strips_) {
    forPacks(strip.count(), [&]<int N>(Eigen::Index i) {
      const Eigen::Index k = strip.first + i;
      const Sides<N> at = sidesOf<N>(strip, i);
      const Pack<N> change = strip.r[0].segment<N>(i) * knot_step_.segment<N>(k) +
                             strip.r[1].segment<N>(i) * middle_step_.segment<N>(k) +
                             strip.r[2].segment<N>(i) * knot_step_.segment<N>(k + 1);
      Pack<N> of_size = Pack<N>::Zero();
      if (strip.root >= 0) of_size = at.along_root * knot_step_.segment<N>(k + strip.root / 2);
      for (int side = 0; side < 2; ++side) {
        const Pack<N> slack = strip.slack[side].segment<N>(i), inverse = slack.inverse(),
                      multiplier = strip.dual[side].segment<N>(i);
        const Pack<N> by = -(at.h[side] + slack) - (side == 0 ? Pack<N>(change) : Pack<N>(-change)) - of_size,
                      dual_by = barrier * inverse - multiplier - multiplier * inverse * by;
        strip.slack_step[side].segment<N>(i) = by;
        strip.dual_step[side].segment<N>(i) = dual_by;
        primal = std::max(primal, (-by * inverse).maxCoeff());
        dual = std::max(dual, (-dual_by / multiplier).maxCoeff());
      }
    });
  }
  forCaps([&](Cap& cap, double value, double by) {
    cap.slack_step = -(value / cap.limit - 1. + cap.slack) - by / cap.limit;
    cap.dual_step = barrier / cap.slack - cap.dual - cap.dual / cap.slack * cap.slack_step;
    primal = std::max(primal, -cap.slack_step / cap.slack);
    dual = std::max(dual, -cap.dual_step / cap.dual);
  });
  return {primal > kToBoundary ? kToBoundary / primal : 1., dual > kToBoundary ? kToBoundary / dual : 1.};
}

SmoothProgram::Gap SmoothProgram::take(const Steps& steps) {
  middle_ += steps.primal * middle_step_;
  placeKnots();
  Gap gap;
  for (Strip& strip : strips_) {
    forPacks(strip.count(), [&]<int N>(Eigen::Index i) {
      const Sides<N> at = sidesOf<N>(strip, i);
      for (int side = 0; side < 2; ++side) {
        // what a tangent has promised, the limit itself keeps: its slack is at least as large
        const Pack<N> slack =
            (strip.slack[side].segment<N>(i) + steps.primal * strip.slack_step[side].segment<N>(i)).max(-at.h[side]);
        const Pack<N> dual = strip.dual[side].segment<N>(i) + steps.dual * strip.dual_step[side].segment<N>(i);
        strip.slack[side].segment<N>(i) = slack;
        strip.dual[side].segment<N>(i) = dual;
        gap.sum += (slack * dual).sum();
        gap.infeasible = std::max(gap.infeasible, at.h[side].maxCoeff());
      }
    });
  }
  forCaps([&](Cap& cap, double value, double) {
    cap.slack = std::max(cap.slack + steps.primal * cap.slack_step, 1. - value / cap.limit);
    cap.dual += steps.dual * cap.dual_step;
    gap.sum += cap.slack * cap.dual;
    gap.infeasible = std::max(gap.infeasible, value / cap.limit - 1.);
  });
  return gap;
}

/// Takes all of b down until every limit leaves room: accelerations fall as b does, jerks as b^(3/2).
void SmoothProgram::slowDown() {
  placeKnots();
  double factor = 1., of_jerk = 1.;
  for (const Strip& strip : strips_) {
    const int n = strip.count(), k = strip.first;
    const Array value = (strip.r[0] * knots_.segment(k, n) + strip.r[1] * middle_.segment(k, n) +
                         strip.r[2] * knots_.segment(k + 1, n))
                            .abs(),
                room = kStartShare * (strip.size - strip.offset.abs());
    if (strip.root < 0) factor = std::min(factor, (value > room).select(room / value, 1.).minCoeff());
    if (strip.root >= 0) {
      const auto root = roots_.segment(k + strip.root / 2, n);
      of_jerk = std::min(of_jerk, (value > room * root).select(room * root / value, 1.).minCoeff());
    }
  }
  forCaps([&](Cap& cap, double value, double) { factor = std::min(factor, kStartShare * cap.limit / value); });
  middle_ *= std::min(factor, std::cbrt(of_jerk * of_jerk));
  placeKnots();
}

bool SmoothProgram::solve(const std::vector<double>& start, double first_gap, double gap, int most_steps) {
  for (int k = 0; k < count_; ++k) middle_[k] = start[std::size_t(first_ + k)];
  slowDown();
  const int rows = inequalities();
  double barrier = first_gap * duration() / rows, infeasible = 0.;
  begin(barrier);
  for (int i = 0; i < most_steps; ++i) {
    assemble(barrier);
    solveBand();
    const Steps steps = findSteps(barrier);
    const Gap now = take(steps);
    infeasible = now.infeasible;
    for (int end = 0; end < 2; ++end)
      if (!ends_[end].at_rest)
        infeasible = std::max(infeasible, std::abs(middle_[end ? count_ - 1 : 0] / ends_[end].squared_speed - 1.));
    if (now.sum <= gap * duration() && infeasible <= kFeasible) break;
    const double least = std::min(steps.primal, steps.dual);
    barrier = (least > .8 ? .1 : least > .4 ? .3 : .8) * now.sum / rows;
  }
  if (!(infeasible <= kFeasible) || !middle_.allFinite()) return false;
  if (!ends_[0].at_rest) middle_[0] = ends_[0].squared_speed;
  if (!ends_[1].at_rest) middle_[count_ - 1] = ends_[1].squared_speed;
  placeKnots();
  return true;
}

void SmoothProgram::tighten(int k, const std::array<double, 3>& ratios) {
  for (Strip& strip : strips_)
    if (strip.kind != kGiven && k >= strip.first && k < strip.first + strip.count())
      strip.size[k - strip.first] /= ratios[strip.kind];
  const double squared = ratios[kVelocity] * ratios[kVelocity];
  middle_caps_[k].limit /= squared;
  knot_caps_[k].limit /= squared, knot_caps_[k + 1].limit /= squared;
}

}  // namespace kinegraph
