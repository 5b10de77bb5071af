#include "kinegraph/trajectories/scaling_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"

namespace kinegraph {

namespace {

void checkLimit(const char* name, const VectorXd& limit, int dofs) {
  if (limit.size() != dofs)
    throw ValueError(cat("retime: ", name, " has ", limit.size(), " entries; the path has ", dofs, " dofs"));
  for (int j = 0; j < dofs; ++j)
    if (!(limit[j] > 0.))
      throw ValueError(cat("retime: ", name, "[", j, "] is ", limit[j], "; expected a number > 0 (infinity for none)"));
}

}  // namespace

void MotionLimits::validate(int dofs) const {
  checkLimit("velocity", velocity, dofs);
  checkLimit("acceleration", acceleration, dofs);
  if (limitsJerk()) checkLimit("jerk", jerk, dofs);
}

namespace {

/// Estimates the duration of a piece: 1/s' is |q'| / velocity if velocities limit the motion, and the root of |q''| /
/// acceleration in curves.
double weightOf(const PathCurve& curve, const MotionLimits& limits, int piece, VectorXd& derivative) {
  const double begin = curve.begin(piece), length = curve.end(piece) - begin;
  double pace = 0.;
  for (const double x : {.1, .5, .9}) {
    curve.eval(piece, begin + x * length, 1, derivative.data());
    const double moves = (derivative.array().abs() / limits.velocity.array()).maxCoeff();
    curve.eval(piece, begin + x * length, 2, derivative.data());
    pace += std::max(moves, std::sqrt((derivative.array().abs() / limits.acceleration.array()).maxCoeff()));
  }
  return length * pace / 3.;
}

}  // namespace

ScalingGrid::ScalingGrid(const PathCurve& curve, const MotionLimits& limits, const ScalingBudget& budget,
                         bool divide_lines)
    : curve_(&curve), whole_lines_(!divide_lines) {
  std::vector<double> weight(std::size_t(curve.pieces()), 0.);
  VectorXd derivative(curve.dofs());
  double curved = 0., total = 0.;
  const auto isDivided = [&](int piece) { return divide_lines || !curve.isLine(piece); };
  for (int piece = 0; piece < curve.pieces(); ++piece) {
    if (!isDivided(piece)) continue;
    total += weight[piece] = weightOf(curve, limits, piece, derivative);
    curved += curve.end(piece) - curve.begin(piece);
  }
  for (int piece = 0; piece < curve.pieces(); ++piece) {
    const double begin = curve.begin(piece), length = curve.end(piece) - begin;
    const double share =
        isDivided(piece) ? length / curved + (total > 0. ? weight[piece] / total : length / curved) : 0.;
    const int parts = isDivided(piece) ? std::max(2, int(std::lround(budget.intervals * share / 2.))) : 1;
    for (int i = 0; i < parts; ++i) {
      places_.push_back(begin + length * i / parts);
      piece_.push_back(piece);
      stops_.push_back(i == 0 && curve.stopsAt(piece));
    }
  }
  places_.push_back(curve.length());
  expand(budget);
}

ScalingGrid::ScalingGrid(const PathCurve& curve, std::vector<double> places, const ScalingBudget& budget)
    : curve_(&curve), whole_lines_(false), places_(std::move(places)) {
  for (std::size_t i = 0; i + 1 < places_.size(); ++i) {
    budget.poll(int(i));
    piece_.push_back(curve.pieceAt(places_[i]));
    stops_.push_back(places_[i] == curve.begin(piece_.back()) && curve.stopsAt(piece_.back()));
  }
  expand(budget);
}

void ScalingGrid::expand(const ScalingBudget& budget) {
  const int dofs = curve_->dofs(), m = degree();
  tangents_.resize(dofs, Eigen::Index(intervals()) * (m + 1));
  for (int i = 0; i < intervals(); ++i) {
    budget.poll(i);
    double* p = tangents_.col(Eigen::Index(i) * (m + 1)).data();
    const double x = place(i) - curve_->begin(piece_[i]), h = width(i);
    const double *c1 = curve_->coefficient(piece_[i], 1), *c2 = m > 0 ? curve_->coefficient(piece_[i], 2) : nullptr;
    const double* c3 = m > 1 ? curve_->coefficient(piece_[i], 3) : nullptr;
    const double* c4 = m > 2 ? curve_->coefficient(piece_[i], 4) : nullptr;
    for (int j = 0; j < dofs; ++j) {
      // dq/ds = k0 + k1 y + k2 y^2 + k3 y^3 with y = (s - place) / h in [0, 1]
      if (m == 0) {
        p[j] = c1[j];
      } else if (m == 1) {
        p[j] = c1[j] + 2. * c2[j] * x;
        p[dofs + j] = p[j] + 2. * c2[j] * h;
      } else if (m == 2) {
        const double k1 = h * (2. * c2[j] + 6. * c3[j] * x), k2 = 3. * c3[j] * h * h;
        p[j] = c1[j] + x * (2. * c2[j] + 3. * c3[j] * x);
        p[dofs + j] = p[j] + k1 / 2.;
        p[2 * dofs + j] = p[j] + k1 + k2;
      } else {
        const double k1 = h * (2. * c2[j] + x * (6. * c3[j] + 12. * c4[j] * x));
        const double k2 = h * h * (3. * c3[j] + 12. * c4[j] * x), k3 = 4. * c4[j] * h * h * h;
        p[j] = c1[j] + x * (2. * c2[j] + x * (3. * c3[j] + 4. * c4[j] * x));
        p[dofs + j] = p[j] + k1 / 3.;
        p[2 * dofs + j] = p[j] + (2. * k1 + k2) / 3.;
        p[3 * dofs + j] = p[j] + k1 + k2 + k3;
      }
    }
  }
}

namespace {

/// Returns the offset of the line from |first| to |last| coefficient that makes it a bound of |dq/ds| over an interval.
double bulge(const double* p, int dofs, int degree) {
  double offset = 0.;
  const double first = std::abs(p[0]), last = std::abs(p[degree * dofs]);
  for (int k = 1; k < degree; ++k)
    offset = std::max(offset, std::abs(p[k * dofs]) - (first + (last - first) * k / degree));
  return offset;
}

}  // namespace

std::vector<double> ScalingGrid::caps(const VectorXd& velocity, const ScalingBudget& budget) const {
  const int dofs = curve_->dofs(), m = degree(), count = intervals();
  constexpr double kNone = std::numeric_limits<double>::infinity();
  std::vector<double> caps(std::size_t(count) + 1, kNone);
  Eigen::ArrayXd least(dofs), inverse = velocity.array().inverse();
  for (int i = 0; i < count; ++i) {
    budget.poll(i);
    const double* p = tangents_.col(Eigen::Index(i) * (m + 1)).data();
    double peak0 = 0., peak1 = 0.;
    for (int j = 0; j < dofs; ++j) {
      peak0 = std::max(peak0, std::abs(p[j]) * inverse[j]);
      peak1 = std::max(peak1, std::abs(p[m * dofs + j]) * inverse[j]);
    }
    if (peak0 == 0. && peak1 == 0.) {
      for (int k = 1; k < m; ++k)
        for (int j = 0; j < dofs; ++j) peak0 = std::max(peak0, std::abs(p[k * dofs + j]) * inverse[j]);
      if (peak0 == 0.) continue;
    }
    peak0 = std::max(peak0, 1e-3 * peak1), peak1 = std::max(peak1, 1e-3 * peak0);
    const double cap0 = 1. / (peak0 * peak0), cap1 = 1. / (peak1 * peak1);
    double excess = 1.;  // largest (bound of |dq/ds|)^2 (interpolated cap) / velocity^2, a cubic in Bernstein form
    if (m > 0) {
      for (int j = 0; j < dofs; ++j) {
        const double raised = bulge(p + j, dofs, m);
        const double u0 = (std::abs(p[j]) + raised) * inverse[j],
                     u1 = (std::abs(p[m * dofs + j]) + raised) * inverse[j];
        excess = std::max({excess, u0 * u0 * cap0, u1 * u1 * cap1, u0 * (2. * u1 * cap0 + u0 * cap1) / 3.,
                           u1 * (u1 * cap0 + 2. * u0 * cap1) / 3.});
      }
    }
    caps[i] = std::min(caps[i], cap0 / excess);
    caps[i + 1] = std::min(caps[i + 1], cap1 / excess);
  }
  for (int i = 0; i < count; ++i)
    if (stops_[i]) caps[i] = 0.;
  return caps;
}

}  // namespace kinegraph
