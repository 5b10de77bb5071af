#include "kinegraph/trajectories/jerk_limited_program.h"

#include <algorithm>
#include <cmath>

#include "kinegraph/trajectories/binomial.h"

namespace kinegraph::inline trajectories_internal {

namespace {

constexpr double kOpenSpan = 1e6;  // range of a constraint with one open side, relative to the other side

}  // namespace

JerkLimitedProgram::JerkLimitedProgram(const ScalingGrid& grid, const MotionLimits& limits,
                                       const ConstraintSource& rows, SectionEnd begin, SectionEnd end,
                                       const ScalingBudget& budget)
    : first_(begin.at_rest ? 1 : 0),
      count_(grid.intervals() - int(begin.at_rest) - int(end.at_rest)),
      ends_{begin, end},
      budget_(budget) {
  if (begin.at_rest) rest_width_[0] = grid.width(0);
  if (end.at_rest) rest_width_[1] = grid.width(grid.intervals() - 1);
  width_.resize(count_);
  for (int k = 0; k < count_; ++k) width_[k] = grid.width(first_ + k);
  left_.setZero(count_ + 1), right_.setZero(count_ + 1);
  for (int k = 1; k < count_; ++k) {
    left_[k] = width_[k] / (width_[k - 1] + width_[k]);
    right_[k] = 1. - left_[k];
  }
  // At rest, b = y (x / w)^(4/3) has the slope 4 y / 3 w at its end, so that c = y + h/2 times the slope. Otherwise b'
  // = 2 s'' fixes c, and the knot is a multiple of c.
  fixed_middle_[0] = begin.squared_speed + begin.acceleration * width_[0];
  fixed_middle_[1] = end.squared_speed - end.acceleration * width_[count_ - 1];
  right_[0] =
      begin.at_rest ? 1. / (1. + 2. * width_[0] / (3. * rest_width_[0])) : begin.squared_speed / fixed_middle_[0];
  left_[count_] =
      end.at_rest ? 1. / (1. + 2. * width_[count_ - 1] / (3. * rest_width_[1])) : end.squared_speed / fixed_middle_[1];
  const int padded = count_ + 2 * kLanes + 1;
  for (Array* array : {&middle_, &knots_, &roots_}) array->setOnes(padded);
  for (Array* array : {&middle_step_, &knot_step_}) array->setZero(padded);
  for (Array& array : slope_) array.resize(padded);
  for (Array& array : by_barrier_) array.resize(padded);
  for (Array& array : matrix_) array.resize(padded);
  band_.resize(std::size_t(count_)), gradient_.resize(std::size_t(count_));
  kinds_ = {kVelocity, kVelocity};
  for (int j = 0; j < limits.acceleration.size(); ++j) {
    if (limits.acceleration[j] < kOpen) kinds_.insert(kinds_.end(), std::size_t(grid.degree()) + 1, kAcceleration);
    if (limits.jerk[j] < kOpen) ++jerks_;
  }
  for (int r = 0; rows && r < rows.high.size(); ++r)
    if (rows.low[r] > -kOpen || rows.high[r] < kOpen) kinds_.push_back(kConstraint);
  kinds_.insert(kinds_.end(), 2 * std::size_t(jerks_), kJerk);
  addBlocks();
  addCaps(grid, limits);
  addMotionRows(grid, limits);
  if (rows) addConstraints(grid, rows);
}

void JerkLimitedProgram::addBlocks() {
  const int blocks = (count_ + kLanes - 1) / kLanes;
  Rows none{};
  std::fill_n(none.size, kLanes, 1.);
  rows_.reserve(std::size_t(blocks + 1) * kinds_.size());
  for (int n = 0; n <= blocks; ++n) {
    const bool is_end = n == blocks;
    budget_.poll(n * kLanes);
    rows_.insert(rows_.end(), kinds_.size(), none);
    Rows* rows = rows_.data() + std::size_t(n) * kinds_.size();
    blocks_.push_back({is_end ? count_ - 1 : n * kLanes, beginRoots(), is_end ? 0 : jerks_, is_end ? 0 : jerks_, rows});
  }
}

JerkLimitedProgram::RowPlace JerkLimitedProgram::row(int r, int k) {
  const JerkLimitedKernel::Block& block = k == count_ ? blocks_.back() : blocks_[std::size_t(k / kLanes)];
  return {block.rows[r], k == count_ ? 0 : k % kLanes};
}

/// Adds the rows of accelerations and, at both ends, of jerks. The last Bernstein coefficient of an acceleration is the
/// first one of the next interval. With dq/ds = sum_k p_k B_k of degree m, (q' b'/2 + q'' b) w has the coefficients
///
///     ((m + 1 - k) p_k (b1 - b0) + k p_k-1 (b2 - b1)) / (m + 1) + m sum_l C(2, l) C(m - 1, k - l) / C(m + 1, k) d_k-l
///     b_l
///
/// with d_k = p_k+1 - p_k.
void JerkLimitedProgram::addMotionRows(const ScalingGrid& grid, const MotionLimits& limits) {
  const int m = grid.degree(), top = m + 1;
  double weight[8][3];
  for (int c = 0; c <= top; ++c)
    for (int l = 0; l < 3; ++l) weight[c][l] = m * binomial(2, l) * binomial(m - 1, c - l) / binomial(top, c);
  for (int k = 0; k < count_; ++k) {
    budget_.poll(k);
    const auto p = grid.tangent(first_ + k);
    const double w = width_[k];
    int r = 2, jerk = beginRoots();
    for (int j = 0; j < limits.acceleration.size(); ++j) {
      const auto coefficient = [&](int c, RowPlace place) {
        const double unit = 1. / (limits.acceleration[j] * w);
        const double rise = c <= m ? unit * double(top - c) / top * p(j, c) : 0.;
        const double fall = c > 0 ? unit * double(c) / top * p(j, c - 1) : 0.;
        place.add(-rise, rise - fall, fall);
        for (int l = 0; l < 3; ++l)
          if (weight[c][l] != 0.) place.rows.r[l][place.lane] += unit * weight[c][l] * (p(j, c - l + 1) - p(j, c - l));
      };
      if (limits.acceleration[j] < kOpen) {
        for (int c = 0; c <= m; ++c) coefficient(c, row(r + c, k));
        if (k == count_ - 1) coefficient(top, row(r, count_));
        r += top;
      }
      if (!(limits.jerk[j] < kOpen)) continue;
      for (int end = 0; end < 2; ++end) {  // q''' b + 3/2 q'' b' + 1/2 q' b'', times w^2
        const int at = end * m;
        const double unit = 1. / (limits.jerk[j] * w * w), first = unit * p(j, at);
        const double second = m > 0 ? 3. * unit * m * (end ? p(j, m) - p(j, m - 1) : p(j, 1) - p(j, 0)) : 0.;
        const int middle = end ? m - 1 : 1;
        const double third =
            m > 1 ? unit * m * (m - 1) * (p(j, middle - 1) - 2. * p(j, middle) + p(j, middle + 1)) : 0.;
        RowPlace place = row(jerk + end * jerks_, k);
        if (end == 0) {
          place.add(first - second + third, second - 2. * first, first);
        } else {
          place.add(first, -second - 2. * first, first + second + third);
        }
      }
      ++jerk;
    }
  }
}

void JerkLimitedProgram::addConstraints(const ScalingGrid& grid, const ConstraintSource& source) {
  const int first = int(std::find(kinds_.begin(), kinds_.end(), kConstraint) - kinds_.begin());
  for (int k = 0; k <= count_; ++k) {
    budget_.poll(k);
    const bool at_end = k == count_;
    const int interval = first_ + k - int(at_end);
    const double h = width_[k - int(at_end)];
    const ScalingConstraints at = source.at(grid.place(first_ + k), grid.piece(interval));
    int of_block = first;
    for (int r = 0; r < source.high.size(); ++r) {
      double low = source.low[r], high = source.high[r];
      if (low == -kOpen && high == kOpen) continue;
      if (low == -kOpen) low = high - kOpenSpan * (1. + std::abs(high));
      if (high == kOpen) high = low + kOpenSpan * (1. + std::abs(low));
      const double size = (high - low) / 2., slope = at.a[r] / h / size, square = at.b[r] / size;
      RowPlace place = row(of_block++, k);
      place.add(at_end ? 0. : square - slope, at_end ? -slope : slope, at_end ? square + slope : 0.);
      place.rows.offset[place.lane] = (at.c[r] - (low + high) / 2.) / size;
    }
  }
}

/// Returns the largest b at the end of an interval that starts at rest with a constant jerk j of s, s = j t^3 / 6. The
/// jerk is j (q' + 9 s q'' + 9/2 s^2 q'''), the acceleration (6 j^2 s)^(1/3) (q' + 3/2 s q''): powers of j times
/// polynomials of s.
double JerkLimitedProgram::restCap(const ScalingGrid& grid, const MotionLimits& limits, bool at_begin) const {
  const int interval = at_begin ? 0 : grid.intervals() - 1, n = grid.curve().dofs(), piece = grid.piece(interval);
  const double w = grid.width(interval), sign = at_begin ? 1. : -1.;
  double max_jerk = kOpen, cap = kOpen;
  VectorXd q1(n), q2(n), q3(n);
  for (double x : {0., .25, .5, .75, 1.}) {  // the polynomials are near q', and w is small; a margin covers other x
    const double s = x * w;
    const double place = at_begin ? grid.place(0) + s : grid.place(interval + 1) - s;
    grid.curve().eval(piece, place, 1, q1.data()), grid.curve().eval(piece, place, 2, q2.data());
    grid.curve().eval(piece, place, 3, q3.data());
    for (int j = 0; j < n; ++j) {
      const double jerk = std::abs(q1[j] + sign * 9. * s * q2[j] + 4.5 * s * s * q3[j]);
      const double acceleration = std::abs(q1[j] + sign * 1.5 * s * q2[j]);
      if (jerk > 0.) max_jerk = std::min(max_jerk, limits.jerk[j] / jerk);
      if (acceleration > 0. && x > 0.)
        max_jerk = std::min(max_jerk, std::pow(limits.acceleration[j] / acceleration, 1.5) / std::sqrt(6. * s));
      if (q1[j] != 0.) cap = std::min(cap, std::pow(limits.velocity[j] / q1[j], 2));
    }
  }
  constexpr double kMargin = .995;
  const double time = std::cbrt(6. * w / (kMargin * max_jerk));
  return std::min(kMargin * cap, time > 0. ? 9. * w * w / (time * time) : kOpen);
}

void JerkLimitedProgram::addCaps(const ScalingGrid& grid, const MotionLimits& limits) {
  std::vector<double> caps = grid.caps(limits.velocity, budget_);
  double& begin = caps[std::size_t(first_)];
  double& end = caps[std::size_t(first_ + count_)];
  const double middle_of_first = (begin + caps[std::size_t(first_ + 1)]) / 2.,
               middle_of_last = (caps[std::size_t(first_ + count_ - 1)] + end) / 2.;
  if (ends_[0].at_rest) begin = std::min(begin, restCap(grid, limits, true));
  if (ends_[1].at_rest) end = std::min(end, restCap(grid, limits, false));
  for (int k = 0; k < count_; ++k) {
    const double at_begin = caps[std::size_t(first_ + k)], at_end = caps[std::size_t(first_ + k + 1)];
    row(0, k).add(1. / at_begin, 0., 0.);
    row(1, k).add(0.,
                  k == 0            ? 1. / middle_of_first
                  : k == count_ - 1 ? 1. / middle_of_last
                                    : 2. / (at_begin + at_end),
                  0.);
  }
  row(0, count_).add(0., 0., 1. / end);
}

}  // namespace kinegraph::inline trajectories_internal
