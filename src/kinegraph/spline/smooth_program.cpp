#include "kinegraph/spline/smooth_program.h"

#include <algorithm>
#include <cmath>

namespace kinegraph {

namespace {

constexpr double kGivenSpan = 1e6;  // stands for an open side of a row, in units of the other

}  // namespace

SmoothProgram::SmoothProgram(const LawGrid& grid, const MotionLimits& limits, const RowSource& rows, SectionEnd begin,
                             SectionEnd end)
    : first_(begin.at_rest ? 1 : 0),
      count_(grid.intervals() - int(begin.at_rest) - int(end.at_rest)),
      ends_{begin, end} {
  if (begin.at_rest) rest_width_[0] = grid.width(0);
  if (end.at_rest) rest_width_[1] = grid.width(grid.intervals() - 1);
  width_.resize(count_);
  for (int k = 0; k < count_; ++k) width_[k] = grid.width(first_ + k);
  left_.setZero(count_ + 1), right_.setZero(count_ + 1);
  for (int k = 1; k < count_; ++k) {
    left_[k] = width_[k] / (width_[k - 1] + width_[k]);
    right_[k] = 1. - left_[k];
  }
  // at rest: b = y (x / w)^(4/3) has the slope 4 y / 3 w at its end, so that c = y + h/2 of it
  right_[0] = begin.at_rest ? 1. / (1. + 2. * width_[0] / (3. * rest_width_[0])) : 1.;
  left_[count_] = end.at_rest ? 1. / (1. + 2. * width_[count_ - 1] / (3. * rest_width_[1])) : 1.;
  addRows(grid, limits);
  if (rows) addGivenRows(grid, rows);
  addCaps(grid, limits);
  for (Array* of_knots : {&knots_, &knot_step_, &roots_}) of_knots->setZero(count_ + 1);
  for (Array* of_middles : {&middle_, &middle_step_}) of_middles->setZero(count_);
  for (Array& array : slope_) array.resize(count_);
  for (Array& array : matrix_) array.resize(count_);
  band_.resize(std::size_t(count_)), gradient_.resize(std::size_t(count_));
}

SmoothProgram::Strip& SmoothProgram::addStrip(Kind kind, int root, int first, int count) {
  Strip& strip = strips_.emplace_back(Strip{kind, root, first, {}, {}, {}, {}, {}, {}, {}});
  strip.offset.setZero(count), strip.size.setOnes(count);
  for (Array& r : strip.r) r.setZero(count);
  for (int side = 0; side < 2; ++side)
    for (Array* array : {&strip.slack[side], &strip.dual[side], &strip.slack_step[side], &strip.dual_step[side]})
      array->setZero(count);
  return strip;
}

/// Accelerations at the beginning of each interval (and at the end of the last), jerks at both ends.
void SmoothProgram::addRows(const LawGrid& grid, const MotionLimits& limits) {
  const int n = grid.curve().dofs(), last = count_ - 1;
  Eigen::ArrayXXd q[2][3];  // derivatives at both ends of each interval, a column each
  VectorXd derivative(n);
  for (int end = 0; end < 2; ++end) {
    for (int order = 0; order < 3; ++order) {
      q[end][order].resize(count_, n);
      for (int k = 0; k < count_; ++k) {
        grid.curve().eval(grid.piece(first_ + k), grid.place(first_ + k + end), order + 1, derivative.data());
        q[end][order].row(k) = derivative.transpose().array();
      }
    }
  }
  for (int j = 0; j < n; ++j) {
    if (const double a = limits.acceleration[j]; a < kOpen) {  // q' b'/2 + q'' b
      Strip& strip = addStrip(kAcceleration, -1, 0, count_);
      strip.r[1] = q[0][0].col(j) / width_ / a;
      strip.r[0] = q[0][1].col(j) / a - strip.r[1];
      Strip& at_end = addStrip(kAcceleration, -1, last, 1);
      at_end.r[1][0] = -q[1][0](last, j) / width_[last] / a;
      at_end.r[2][0] = q[1][1](last, j) / a - at_end.r[1][0];
    }
    const double jerk = limits.jerk[j];
    for (int end = 0; end < 2 && jerk < kOpen; ++end) {  // q''' b + 3/2 q'' b' + 1/2 q' b''
      Strip& strip = addStrip(kJerk, 2 * end, 0, count_);
      const Array turn = 3. / jerk * q[end][1].col(j) / width_;
      strip.r[0] = strip.r[2] = q[end][0].col(j) / (jerk * width_.square());
      strip.r[1] = -2. * strip.r[0];
      strip.r[2 * end] += q[end][2].col(j) / jerk + (end == 0 ? -1. : 1.) * turn;
      strip.r[1] += (end == 0 ? 1. : -1.) * turn;
    }
  }
}

void SmoothProgram::addGivenRows(const LawGrid& grid, const RowSource& source) {
  for (int r = 0; r < source.high.size(); ++r) {
    if (source.low[r] == -kOpen && source.high[r] == kOpen) continue;
    addStrip(kGiven, -1, 0, count_), addStrip(kGiven, -1, count_ - 1, 1);
  }
  const std::size_t first = strips_.size();
  for (int k = 0; k <= count_; ++k) {
    const bool at_end = k == count_;
    const int interval = first_ + k - int(at_end);
    const double h = width_[k - int(at_end)];
    const LawRows at = source.at(grid.place(first_ + k), grid.piece(interval));
    std::size_t strip = first;
    for (auto r = source.high.size() - 1; r >= 0; --r) {
      double low = source.low[r], high = source.high[r];
      if (low == -kOpen && high == kOpen) continue;
      strip -= 2;
      if (low == -kOpen) low = high - kGivenSpan * (1. + std::abs(high));
      if (high == kOpen) high = low + kGivenSpan * (1. + std::abs(low));
      const double size = (high - low) / 2., slope = at.a[r] / h / size, turn = at.b[r] / size;
      Strip& row = strips_[strip + std::size_t(at_end)];
      const int i = at_end ? 0 : k;
      row.r[1][i] = at_end ? -slope : slope;
      row.r[at_end ? 2 : 0][i] = at_end ? turn + slope : turn - slope;
      row.offset[i] = (at.c[r] - (low + high) / 2.) / size;
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

}  // namespace kinegraph
