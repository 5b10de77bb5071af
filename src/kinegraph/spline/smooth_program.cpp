#include "kinegraph/spline/smooth_program.h"

#include <algorithm>
#include <cmath>

namespace kinegraph {

namespace {

constexpr double kOpen = std::numeric_limits<double>::infinity();
constexpr double kFirstSlack = 1e-3;  // of a limit, at least
constexpr double kStartShare = .7;    // of each limit, that the start may use
constexpr double kToBoundary = .95;   // of the way to where a slack ends
constexpr double kFixed = 1e30;       // on the diagonal of what is given
constexpr double kFeasible = 1e-7;    // by which limits may be missed, as a share
constexpr double kGivenSpan = 1e6;    // stands for an open side of a row, in units of the other

double power(double x, int halves) {  // x^(-halves / 2), halves 1, 3, 5
  const double root = 1. / std::sqrt(x);
  return halves == 1 ? root : halves == 3 ? root * root * root : root * root * root * root * root;
}

}  // namespace

SmoothProgram::SmoothProgram(const LawGrid& grid, const MotionLimits& limits, const RowSource& rows, SectionEnd begin,
                             SectionEnd end)
    : first_(begin.at_rest ? 1 : 0),
      count_(grid.intervals() - int(begin.at_rest) - int(end.at_rest)),
      ends_{begin, end} {
  if (begin.at_rest) rest_width_[0] = grid.width(0);
  if (end.at_rest) rest_width_[1] = grid.width(grid.intervals() - 1);
  const std::size_t count = std::size_t(count_);
  for (int k = 0; k < count_; ++k) width_.push_back(grid.width(first_ + k));
  left_.assign(count + 1, 0.), right_.assign(count + 1, 0.);
  for (std::size_t k = 1; k < count; ++k) {
    left_[k] = width_[k] / (width_[k - 1] + width_[k]);
    right_[k] = 1. - left_[k];
  }
  // at rest: b = y (x / w)^(4/3) has the slope 4 y / 3 w at its end, so that c = y + h/2 of it
  right_[0] = begin.at_rest ? 1. / (1. + 2. * width_[0] / (3. * rest_width_[0])) : 1.;
  left_[count] = end.at_rest ? 1. / (1. + 2. * width_[count - 1] / (3. * rest_width_[1])) : 1.;
  for (int k = 0; k < count_; ++k) {
    row_begin_.push_back(int(rows_.size()));
    addRows(k, grid, limits);
    if (rows) addGivenRows(k, grid, rows);
  }
  row_begin_.push_back(int(rows_.size()));
  addCaps(grid, limits);
  knots_.resize(count + 1), knot_step_.resize(count + 1), middle_.resize(count), middle_step_.resize(count);
  band_.resize(count), gradient_.resize(count);
}

/// Accelerations at the beginning of each interval (and at the end of the last), jerks at both ends.
void SmoothProgram::addRows(int k, const LawGrid& grid, const MotionLimits& limits) {
  const int interval = first_ + k, piece = grid.piece(interval), n = grid.curve().dofs();
  const double h = width_[k];
  VectorXd q1(n), q2(n), q3(n);
  for (int end = 0; end < 2; ++end) {
    const double s = grid.place(interval + end);
    grid.curve().eval(piece, s, 1, q1.data()), grid.curve().eval(piece, s, 2, q2.data());
    grid.curve().eval(piece, s, 3, q3.data());
    for (int j = 0; j < n; ++j) {
      const double a = limits.acceleration[j], jerk = limits.jerk[j];
      if (a < kOpen && (end == 0 || k + 1 == count_)) {  // q' b'/2 + q'' b
        Quadratic r =
            end == 0 ? Quadratic{q2[j] - q1[j] / h, q1[j] / h, 0.} : Quadratic{0., -q1[j] / h, q2[j] + q1[j] / h};
        for (double& x : r) x /= a;
        rows_.push_back({r, 0., 1., -1, kAcceleration, {}, {}});
      }
      if (jerk < kOpen) {  // q''' b + 3/2 q'' b' + 1/2 q' b''
        const double bend = q1[j] / (h * h), turn = 3. * q2[j] / h;
        Quadratic r = {bend, -2. * bend, bend};
        if (end == 0) r[0] += q3[j] - turn, r[1] += turn;
        if (end == 1) r[2] += q3[j] + turn, r[1] -= turn;
        for (double& x : r) x /= jerk;
        rows_.push_back({r, 0., 1., end == 0 ? 0 : 2, kJerk, {}, {}});
      }
    }
  }
}

void SmoothProgram::addGivenRows(int k, const LawGrid& grid, const RowSource& source) {
  const int interval = first_ + k;
  const double h = width_[k];
  for (int end = 0; end < (k + 1 == count_ ? 2 : 1); ++end) {
    const LawRows at = source.at(grid.place(interval + end), grid.piece(interval));
    for (int r = 0; r < source.high.size(); ++r) {
      double low = source.low[r], high = source.high[r];
      if (low == -kOpen && high == kOpen) continue;
      if (low == -kOpen) low = high - kGivenSpan * (1. + std::abs(high));
      if (high == kOpen) high = low + kGivenSpan * (1. + std::abs(low));
      const double size = (high - low) / 2., slope = at.a[r] / h / size, turn = at.b[r] / size;
      const Quadratic row = end == 0 ? Quadratic{turn - slope, slope, 0.} : Quadratic{0., -slope, turn + slope};
      rows_.push_back({row, (at.c[r] - (low + high) / 2.) / size, 1., -1, kGiven, {}, {}});
    }
  }
}

/// Where the motion begins at rest with a constant jerk j of s, s = j t^3 / 6: the path's jerk is j (q' + 9 s q'' + 9/2 s^2
/// q'''), its acceleration (6 j^2 s)^(1/3) (q' + 3/2 s q''). Both are j, and a power of it, times a polynomial. The answer
/// is the largest b at the end of the interval.
double SmoothProgram::restCap(const LawGrid& grid, const MotionLimits& limits, bool at_begin) const {
  const int interval = at_begin ? 0 : grid.intervals() - 1, n = grid.curve().dofs(), piece = grid.piece(interval);
  const double w = grid.width(interval), sign = at_begin ? 1. : -1.;
  double most_jerk = kOpen, cap = kOpen;
  VectorXd q1(n), q2(n), q3(n);
  for (double x :
       {0., .25, .5, .75, 1.}) {  // the polynomials are near q', and w is small: a margin covers what is between
    const double s = x * w;
    const double place = at_begin ? grid.place(0) + s : grid.place(interval + 1) - s;
    grid.curve().eval(piece, place, 1, q1.data()), grid.curve().eval(piece, place, 2, q2.data());
    grid.curve().eval(piece, place, 3, q3.data());
    for (int j = 0; j < n; ++j) {
      const double jerk = std::abs(q1[j] + sign * 9. * s * q2[j] + 4.5 * s * s * q3[j]);
      const double turn = std::abs(q1[j] + sign * 1.5 * s * q2[j]);
      if (jerk > 0.) most_jerk = std::min(most_jerk, limits.jerk[j] / jerk);
      if (turn > 0. && x > 0.)
        most_jerk = std::min(most_jerk, std::pow(limits.acceleration[j] / turn, 1.5) / std::sqrt(6. * s));
      if (q1[j] != 0.) cap = std::min(cap, std::pow(limits.velocity[j] / q1[j], 2));
    }
  }
  constexpr double kMargin = .995;
  const double time = std::cbrt(6. * w / (kMargin * most_jerk));
  return std::min(kMargin * cap, time > 0. ? 9. * w * w / (time * time) : kOpen);
}

void SmoothProgram::addCaps(const LawGrid& grid, const MotionLimits& limits) {
  const std::vector<double> caps = grid.caps(limits.velocity);
  for (int k = 0; k <= count_; ++k) knot_caps_.push_back({caps[first_ + k], 0., 0.});
  for (int k = 0; k < count_; ++k) middle_caps_.push_back({(caps[first_ + k] + caps[first_ + k + 1]) / 2., 0., 0.});
  if (ends_[0].at_rest) knot_caps_.front().limit = std::min(knot_caps_.front().limit, restCap(grid, limits, true));
  if (ends_[1].at_rest) knot_caps_.back().limit = std::min(knot_caps_.back().limit, restCap(grid, limits, false));
}

void SmoothProgram::placeKnots() {
  for (int k = 0; k <= count_; ++k)
    knots_[k] = (k > 0 ? left_[k] * middle_[k - 1] : 0.) + (k < count_ ? right_[k] * middle_[k] : 0.);
}

/// h = +-(r b + offset) - size(b), and its slope along the coefficient whose root divides the size.
SmoothProgram::Side SmoothProgram::sideOf(const Row& row, const Quadratic& b, int side) const {
  const double value = row.r[0] * b[0] + row.r[1] * b[1] + row.r[2] * b[2] + row.offset;
  const double g = side == 0 ? value : -value;
  if (row.root < 0) return {g - row.size, 0.};
  const double root = 1. / std::sqrt(b[row.root]);
  return {g - row.size * root, .5 * row.size * root * root * root};
}

template <class Visit>
void SmoothProgram::forCaps(const Visit& visit) {
  for (int k = 0; k < count_; ++k)
    if (middle_caps_[k].limit < kOpen) visit(middle_caps_[k], middle_[k], middle_step_[k]);
  for (int k = 0; k <= count_; ++k)
    if (knot_caps_[k].limit < kOpen) visit(knot_caps_[k], knots_[k], knot_step_[k]);
}

double SmoothProgram::duration() const {
  double time = 0.;
  for (int k = 0; k < count_; ++k) {
    const Quadratic b = at(k);
    time += width_[k] / 6. * (power(b[0], 1) + 4. * power((b[0] + 2. * b[1] + b[2]) / 4., 1) + power(b[2], 1));
  }
  return time + 3. * rest_width_[0] * power(knots_[0], 1) + 3. * rest_width_[1] * power(knots_[count_], 1);
}

void SmoothProgram::begin(double barrier) {
  for (int k = 0; k < count_; ++k) {
    const Quadratic b = at(k);
    for (int r = row_begin_[k]; r < row_begin_[k + 1]; ++r) {
      Row& row = rows_[r];
      if (row.root >= 0) {  // rows of the jerk are taken times the root of b as it is now
        const double unit = std::sqrt(b[row.root]);
        for (double& x : row.r) x *= unit / row.size;
        row.size = unit;
      }
      for (int side = 0; side < 2; ++side) {
        row.slack[side] = std::max(-sideOf(row, b, side).h, kFirstSlack);
        row.dual[side] = barrier / row.slack[side];
      }
    }
  }
  forCaps([&](Cap& cap, double value, double) {
    cap.slack = std::max(1. - value / cap.limit, kFirstSlack);
    cap.dual = barrier / cap.slack;
  });
}

double SmoothProgram::gapSum(int* count, double* infeasible) const {
  double sum = 0., worst = 0.;
  int number = 0;
  for (int k = 0; k < count_; ++k) {
    const Quadratic b = at(k);
    for (int r = row_begin_[k]; r < row_begin_[k + 1]; ++r) {
      const Row& row = rows_[r];
      sum += row.slack[0] * row.dual[0] + row.slack[1] * row.dual[1];
      number += 2;
      if (infeasible) worst = std::max({worst, sideOf(row, b, 0).h, sideOf(row, b, 1).h});
    }
  }
  const_cast<SmoothProgram*>(this)->forCaps([&](Cap& cap, double value, double) {
    sum += cap.slack * cap.dual;
    ++number;
    worst = std::max(worst, value / cap.limit - 1.);
  });
  if (count) *count = number;
  if (infeasible) *infeasible = worst;
  return sum;
}

/// Adds a gradient and a symmetric matrix (00, 10, 11, 20, 21, 22) on the coefficients of interval k.
void SmoothProgram::spread(int k, const double g[3], const double m[6]) {
  const double l0 = left_[k], r0 = right_[k], l1 = left_[k + 1], r1 = right_[k + 1];
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

void SmoothProgram::assemble(double barrier) {
  std::fill(band_.begin(), band_.end(), std::array<double, 3>{0., 0., 0.});
  std::fill(gradient_.begin(), gradient_.end(), 0.);
  for (int k = 0; k < count_; ++k) {
    const Quadratic b = at(k);
    double g[3] = {0., 0., 0.}, m[6] = {0., 0., 0., 0., 0., 0.};
    const auto add = [&](const double a[3], double slope, double weight) {
      for (int i = 0; i < 3; ++i) g[i] += slope * a[i];
      m[0] += weight * a[0] * a[0], m[1] += weight * a[1] * a[0], m[2] += weight * a[1] * a[1];
      m[3] += weight * a[2] * a[0], m[4] += weight * a[2] * a[1], m[5] += weight * a[2] * a[2];
    };
    const double x = (b[0] + 2. * b[1] + b[2]) / 4., h = width_[k];
    const double w0 = h / 6. + (k == 0 ? 3. * rest_width_[0] : 0.),
                 w1 = h / 6. + (k + 1 == count_ ? 3. * rest_width_[1] : 0.);
    const double e0[3] = {1., 0., 0.}, e1[3] = {0., 1., 0.}, e2[3] = {0., 0., 1.}, mean[3] = {.25, .5, .25};
    add(e0, -.5 * w0 * power(b[0], 3), .75 * w0 * power(b[0], 5));
    add(e2, -.5 * w1 * power(b[2], 3), .75 * w1 * power(b[2], 5));
    add(mean, -.5 * h * 4. / 6. * power(x, 3), .75 * h * 4. / 6. * power(x, 5));
    for (int r = row_begin_[k]; r < row_begin_[k + 1]; ++r) {
      const Row& row = rows_[r];
      for (int side = 0; side < 2; ++side) {
        const Side at = sideOf(row, b, side);
        const double sign = side == 0 ? 1. : -1., inverse = 1. / row.slack[side];
        double a[3] = {sign * row.r[0], sign * row.r[1], sign * row.r[2]};
        if (row.root >= 0) a[row.root] += at.along_root;
        const double residual = at.h + row.slack[side];
        add(a, (barrier + row.dual[side] * residual) * inverse, row.dual[side] * inverse);
      }
    }
    const auto addCap = [&](const Cap& cap, double value, const double e[3]) {
      if (!(cap.limit < kOpen)) return;
      const double inverse = 1. / cap.slack, unit = 1. / cap.limit, residual = value * unit - 1. + cap.slack;
      const double a[3] = {e[0] * unit, e[1] * unit, e[2] * unit};
      add(a, (barrier + cap.dual * residual) * inverse, cap.dual * inverse);
    };
    add(e1, -barrier / b[1], barrier / (b[1] * b[1]));  // the cost does not keep c from zero
    addCap(middle_caps_[k], b[1], e1);
    addCap(knot_caps_[k], b[0], e0);
    if (k + 1 == count_) addCap(knot_caps_[count_], b[2], e2);
    spread(k, g, m);
  }
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

namespace {

struct SlackStep {
  double slack, dual;
};

SlackStep slackStep(double h, double along, double slack, double dual, double barrier) {
  const double by = -(h + slack) - along;
  return {by, barrier / slack - dual - dual / slack * by};
}

void shorten(double value, double by, double& step) {
  if (by < 0.) step = std::min(step, -kToBoundary * value / by);
}

}  // namespace

SmoothProgram::Steps SmoothProgram::findSteps(double barrier) const {
  Steps steps;
  for (int k = 0; k < count_; ++k) {
    const Quadratic b = at(k), by = {knot_step_[k], middle_step_[k], knot_step_[k + 1]};
    shorten(b[1], by[1], steps.primal);
    for (int r = row_begin_[k]; r < row_begin_[k + 1]; ++r) {
      const Row& row = rows_[r];
      const double change = row.r[0] * by[0] + row.r[1] * by[1] + row.r[2] * by[2];
      for (int side = 0; side < 2; ++side) {
        const Side at = sideOf(row, b, side);
        const double along = (side == 0 ? change : -change) + (row.root >= 0 ? at.along_root * by[row.root] : 0.);
        const SlackStep step = slackStep(at.h, along, row.slack[side], row.dual[side], barrier);
        shorten(row.slack[side], step.slack, steps.primal);
        shorten(row.dual[side], step.dual, steps.dual);
      }
    }
  }
  const_cast<SmoothProgram*>(this)->forCaps([&](Cap& cap, double value, double by) {
    const SlackStep step = slackStep(value / cap.limit - 1., by / cap.limit, cap.slack, cap.dual, barrier);
    shorten(cap.slack, step.slack, steps.primal);
    shorten(cap.dual, step.dual, steps.dual);
  });
  return steps;
}

void SmoothProgram::take(const Steps& steps, double barrier) {
  const std::vector<double> knots = knots_, middle = middle_;
  for (int k = 0; k < count_; ++k) middle_[k] += steps.primal * middle_step_[k];
  placeKnots();
  for (int k = 0; k < count_; ++k) {
    const Quadratic before = {knots[k], middle[k], knots[k + 1]}, b = at(k);
    const Quadratic by = {knot_step_[k], middle_step_[k], knot_step_[k + 1]};
    for (int r = row_begin_[k]; r < row_begin_[k + 1]; ++r) {
      Row& row = rows_[r];
      const double change = row.r[0] * by[0] + row.r[1] * by[1] + row.r[2] * by[2];
      for (int side = 0; side < 2; ++side) {
        const Side at = sideOf(row, before, side);
        const double along = (side == 0 ? change : -change) + (row.root >= 0 ? at.along_root * by[row.root] : 0.);
        const SlackStep step = slackStep(at.h, along, row.slack[side], row.dual[side], barrier);
        // what a tangent has promised, the limit itself keeps: its slack is at least as large
        row.slack[side] = std::max(row.slack[side] + steps.primal * step.slack, -sideOf(row, b, side).h);
        row.dual[side] += steps.dual * step.dual;
      }
    }
  }
  const auto takeCap = [&](Cap& cap, double before, double by, double now) {
    if (!(cap.limit < kOpen)) return;
    const SlackStep step = slackStep(before / cap.limit - 1., by / cap.limit, cap.slack, cap.dual, barrier);
    cap.slack = std::max(cap.slack + steps.primal * step.slack, 1. - now / cap.limit);
    cap.dual += steps.dual * step.dual;
  };
  for (int k = 0; k < count_; ++k) takeCap(middle_caps_[k], middle[k], middle_step_[k], middle_[k]);
  for (int k = 0; k <= count_; ++k) takeCap(knot_caps_[k], knots[k], knot_step_[k], knots_[k]);
}

/// Takes all of b down until every limit leaves room: accelerations fall as b does, jerks as b^(3/2).
void SmoothProgram::slowDown() {
  placeKnots();
  double factor = 1.;
  for (int k = 0; k < count_; ++k) {
    const Quadratic b = at(k);
    for (int r = row_begin_[k]; r < row_begin_[k + 1]; ++r) {
      const Row& row = rows_[r];
      const double value = std::abs(row.r[0] * b[0] + row.r[1] * b[1] + row.r[2] * b[2]);
      const double room = kStartShare * (row.size - std::abs(row.offset));
      if (row.root < 0 && value > room) factor = std::min(factor, room / value);
      if (row.root >= 0) factor = std::min(factor, std::pow(room / (value * std::sqrt(b[row.root])), 2. / 3.));
    }
  }
  forCaps([&](Cap& cap, double value, double) { factor = std::min(factor, kStartShare * cap.limit / value); });
  for (double& c : middle_) c *= factor;
  placeKnots();
}

bool SmoothProgram::solve(const std::vector<double>& start, double first_gap, double gap, int most_steps) {
  for (int k = 0; k < count_; ++k) middle_[k] = start[std::size_t(first_ + k)];
  slowDown();
  begin(1.);
  int rows = 0;
  gapSum(&rows);
  double barrier = first_gap * duration() / rows, infeasible = 0.;
  begin(barrier);
  for (int i = 0; i < most_steps; ++i) {
    assemble(barrier);
    solveBand();
    const Steps steps = findSteps(barrier);
    take(steps, barrier);
    const double sum = gapSum(nullptr, &infeasible);
    for (int end = 0; end < 2; ++end)
      if (!ends_[end].at_rest)
        infeasible = std::max(infeasible, std::abs(middle_[end ? count_ - 1 : 0] / ends_[end].squared_speed - 1.));
    if (sum <= gap * duration() && infeasible <= kFeasible) break;
    const double least = std::min(steps.primal, steps.dual);
    barrier = (least > .8 ? .1 : least > .4 ? .3 : .8) * sum / rows;
  }
  if (infeasible > kFeasible) return false;
  if (!ends_[0].at_rest) middle_.front() = ends_[0].squared_speed;
  if (!ends_[1].at_rest) middle_.back() = ends_[1].squared_speed;
  placeKnots();
  return true;
}

void SmoothProgram::tighten(int k, const std::array<double, 3>& ratios) {
  for (int r = row_begin_[k]; r < row_begin_[k + 1]; ++r)
    if (rows_[r].kind != kGiven) rows_[r].size /= ratios[rows_[r].kind];
  const double squared = ratios[kVelocity] * ratios[kVelocity];
  middle_caps_[k].limit /= squared;
  knot_caps_[k].limit /= squared, knot_caps_[k + 1].limit /= squared;
}

}  // namespace kinegraph
