#include "kinegraph/trajectories/time_optimal.h"

#include <algorithm>
#include <cmath>

#include "kinegraph/trajectories/binomial.h"
#include "kinegraph/trajectories/two_variable_program.h"

namespace kinegraph {

namespace {

constexpr double kUnlimited = 1e18;    // stands for an infinite s'^2
constexpr double kMiddleShare = 1e-3;  // of the middle coefficient in what is maximized: fast within the interval, too
constexpr double kMiddleShareBefore = 1e-6;
constexpr double kRoom = 1e-10;       // by which ranges are narrowed, so that rounding leaves no interval without a law
constexpr double kLeastStep = 1e-13;  // of the largest s'^2, where rounding leaves nothing of a smaller one
constexpr int kMostCuts = 40;

/// What a line allows: the largest |s''| and s'^2.
struct LineLimits {
  double acceleration, cap;
};

LineLimits lineLimits(const ScalingGrid& grid, const MotionLimits& limits, int interval) {
  const double* direction = grid.tangent(interval).data();
  LineLimits line{kUnlimited, kUnlimited};
  for (int j = 0; j < limits.velocity.size(); ++j) {
    const double d = std::abs(direction[j]);
    if (d == 0.) continue;
    line.acceleration = std::min(line.acceleration, limits.acceleration[j] / d);
    line.cap = std::min(line.cap, limits.velocity[j] * limits.velocity[j] / (d * d));
  }
  return line;
}

/// A range of s'^2.
struct Range {
  double low, high;
  bool is_empty = false;
};

/// The rows of all intervals in x, y, z: the Bernstein coefficients of s'^2 at the beginning, in the middle, at the end.
class IntervalRows {
 public:
  IntervalRows(const ScalingGrid& grid, const MotionLimits& limits, const ConstraintSource& source,
               const std::vector<double>& caps, const ScalingBudget& effort);

  /// What x may be so that some z in `next` can be reached.
  Range before(int interval, const Range& next);

  /// The best z in `next` for this x, and the middle; false if rounding leaves none.
  bool after(int interval, double x, const Range& next, double& middle, double& z);

  /// Of the caller's rows, the one that is missed by most by standing still; -1 if none is.
  int worstAtRest(int interval) const;

 private:
  struct General {
    double x, y, z, low, high;
  };
  struct Extreme {
    bool is_feasible;
    double value;  ///< x; where no x is feasible: by how much rows contradict each other, negative
    double slope;  ///< how (sign x), or that, grows with z
  };
  void addInterval(int interval, const MotionLimits& limits);
  void addGeneral(int interval);
  void setProgram(int interval, bool is_before, double given);
  Extreme extremeBefore(int interval, double z, double sign);
  double searchBefore(int interval, const Range& next, double sign, bool& is_found);

  const ScalingGrid& grid_;
  const ConstraintSource& source_;
  const std::vector<double>& caps_;
  std::vector<int> limited_;  ///< dofs whose acceleration is limited
  Eigen::ArrayXXd x_, y_, z_;
  std::vector<General> general_;  ///< of all intervals, 2 per row of the caller
  TwoVariableProgram model_;
  TwoVariableProgram::Answer last_before_, last_after_;
  std::vector<double> given_general_;
};

IntervalRows::IntervalRows(const ScalingGrid& grid, const MotionLimits& limits, const ConstraintSource& source,
                           const std::vector<double>& caps, const ScalingBudget& effort)
    : grid_(grid), source_(source), caps_(caps) {
  for (int j = 0; j < grid.curve().dofs(); ++j)
    if (limits.acceleration[j] < kUnlimited) limited_.push_back(j);
  const int rows = int(limited_.size()) * (grid.degree() + 2);
  x_.resize(rows, grid.intervals()), y_.resize(rows, grid.intervals()), z_.resize(rows, grid.intervals());
  for (int i = 0; i < grid.intervals(); ++i) {
    effort.pause(i);
    if (!grid.isLine(i)) addInterval(i, limits);
    if (source) addGeneral(i);
  }
}

/// dq/ds has the coefficients p_k, of degree m. Then dq/ds s'' + d2q/ds2 s'^2 is of degree m + 1, and h times it has the
/// coefficients
///
///     ((m + 1 - k) p_k (y - x) + k p_k-1 (z - y)) / (m + 1) + m sum_l C(2, l) C(m - 1, k - l) / C(m + 1, k) d_k-l b_l
///
/// with b = (x, y, z), d_k = p_k+1 - p_k. Rows are divided by h times their limit.
void IntervalRows::addInterval(int interval, const MotionLimits& limits) {
  const int m = grid_.degree(), top = m + 1, count = int(limited_.size());
  const auto p = grid_.tangent(interval);
  for (int k = 0; k <= top; ++k) {
    const double first = double(top - k) / top, second = double(k) / top;
    double weight[3];
    for (int l = 0; l < 3; ++l) weight[l] = m * binomial(2, l) * binomial(m - 1, k - l) / binomial(top, k);
    for (int r = 0; r < count; ++r) {
      const int j = limited_[r];
      const double unit = 1. / (limits.acceleration[j] * grid_.width(interval));
      const double rise = k <= m ? first * p(j, k) : 0., fall = k > 0 ? second * p(j, k - 1) : 0.;
      double turn[3];
      for (int l = 0; l < 3; ++l) turn[l] = weight[l] != 0. ? weight[l] * (p(j, k - l + 1) - p(j, k - l)) : 0.;
      x_(k * count + r, interval) = (turn[0] - rise) * unit;
      y_(k * count + r, interval) = (turn[1] + rise - fall) * unit;
      z_(k * count + r, interval) = (turn[2] + fall) * unit;
    }
  }
}

/// a s'' + b s'^2 + c at both ends, where s'' is (y - x) / h and (z - y) / h.
void IntervalRows::addGeneral(int interval) {
  const double h = grid_.width(interval);
  const ScalingConstraints here = source_.at(grid_.place(interval), grid_.piece(interval));
  const ScalingConstraints there = source_.at(grid_.place(interval + 1), grid_.piece(interval));
  for (int r = 0; r < source_.high.size(); ++r) {
    const double low = source_.low[r], high = source_.high[r];
    general_.push_back({here.b[r] - here.a[r] / h, here.a[r] / h, 0., low - here.c[r], high - here.c[r]});
    general_.push_back({0., -there.a[r] / h, there.b[r] + there.a[r] / h, low - there.c[r], high - there.c[r]});
  }
}

/// Unknown are the middle and, first, one end; the other end is given.
void IntervalRows::setProgram(int interval, bool is_before, double given) {
  model_.u = is_before ? x_.col(interval) : z_.col(interval);
  model_.w = y_.col(interval);
  model_.t = (is_before ? z_.col(interval) : x_.col(interval)) * given;
  const double cap0 = std::min(caps_[interval], kUnlimited), cap1 = std::min(caps_[interval + 1], kUnlimited);
  model_.x_low = 0., model_.x_high = is_before ? cap0 : cap1;
  model_.y_low = 0., model_.y_high = (cap0 + cap1) / 2.;
  if (!source_) return;
  model_.others.clear(), given_general_.clear();
  const std::size_t rows = 2 * std::size_t(source_.high.size());
  for (std::size_t r = std::size_t(interval) * rows; r < std::size_t(interval + 1) * rows; ++r) {
    const General& row = general_[r];
    const double other = is_before ? row.z : row.x;
    model_.others.push_back({is_before ? row.x : row.z, row.y, other * given, row.low, row.high});
    given_general_.push_back(other);
  }
}

IntervalRows::Extreme IntervalRows::extremeBefore(int interval, double z, double sign) {
  setProgram(interval, true, z);
  const TwoVariableProgram::Answer answer =
      model_.farthest(sign, sign * kMiddleShareBefore, sign > 0. ? &last_before_ : nullptr);
  if (sign > 0.) last_before_ = answer;
  const Eigen::ArrayXd& by_z = z_.col(interval);
  const auto growth = [&](int inequality) { return model_.signedValue(inequality, by_z, given_general_); };
  double slope = 0.;
  for (int k = 0; k < 2; ++k) slope -= answer.multipliers[k] * growth(answer.rows[k]);
  if (answer.third >= 0) slope -= growth(answer.third);
  return {answer.is_feasible, answer.is_feasible ? answer.x : -answer.contradiction, slope};
}

/// The extreme x over all z in `next`. sign x is a concave function of z, made of few lines: where the lines that it has
/// at both ends of what is left meet, it is largest, or has another line.
double IntervalRows::searchBefore(int interval, const Range& next, double sign, bool& is_found) {
  double low = next.low, high = next.high, best = 0.;
  Extreme at_low{false, 0., 0.}, at_high{false, 0., 0.};  // lines known so far; slope 0: none
  is_found = false;
  double z = sign > 0. ? high : low;
  for (int i = 0; i < kMostCuts; ++i) {
    const Extreme at = extremeBefore(interval, z, sign);
    if (at.is_feasible && (!is_found || sign * at.value > sign * best)) best = at.value, is_found = true;
    if (at.slope == 0. || z == (at.slope > 0. ? next.high : next.low)) break;
    (at.slope > 0. ? low : high) = z;
    (at.slope > 0. ? at_low : at_high) = at;
    if (high - low <= 1e-13 * next.high) break;
    double meet = (low + high) / 2.;
    if (!at.is_feasible) {
      const double step = std::abs(at.value / at.slope) * (1. + 1e-9) + kLeastStep * next.high;
      meet = at.slope > 0. ? z + step : z - step;  // where these rows agree
    } else if (at_low.slope > 0. && at_high.slope < 0. && at_low.is_feasible && at_high.is_feasible) {
      meet =
          low + (sign * (at_high.value - at_low.value) + at_high.slope * (low - high)) / (at_low.slope - at_high.slope);
      if (std::min(meet - low, high - meet) <= 1e-11 * next.high) break;
    } else if (at_low.slope == 0. || at_high.slope == 0.) {
      meet = at.slope > 0. ? high : low;
    }
    z = std::clamp(meet, low, high);
  }
  return best;
}

Range IntervalRows::before(int interval, const Range& next) {
  const Extreme at_most = extremeBefore(interval, next.high, 1.);
  Range range{0., at_most.value};
  bool is_found = true;
  if (!at_most.is_feasible || at_most.slope < 0.) range.high = searchBefore(interval, next, 1., is_found);
  range.is_empty = !is_found;
  if (is_found && (next.low > 0. || source_)) range.low = searchBefore(interval, next, -1., is_found);
  const double room = std::min(kRoom * range.high, (range.high - range.low) / 4.);
  range.high -= std::max(0., room);
  range.low = std::min(range.low > 0. ? range.low + std::max(0., room) : 0., range.high);
  return range;
}

bool IntervalRows::after(int interval, double x, const Range& next, double& middle, double& z) {
  setProgram(interval, false, x);
  model_.x_low = next.low, model_.x_high = std::min(model_.x_high, next.high);
  const TwoVariableProgram::Answer answer = model_.farthest(1., x > 0. ? kMiddleShare : 1., &last_after_);
  last_after_ = answer;
  z = answer.x, middle = answer.y;
  return answer.is_feasible;
}

int IntervalRows::worstAtRest(int interval) const {
  const int rows = source_ ? 2 * int(source_.high.size()) : 0;
  int worst = -1;
  double miss = 0.;
  for (int r = 0; r < rows; ++r) {
    const General& row = general_[std::size_t(interval * rows + r)];
    const double by = std::max(-row.high, row.low);
    if (by > miss) miss = by, worst = r / 2;
  }
  return worst;
}

/// Both passes, and where they fail.
class TwoPasses {
 public:
  TwoPasses(const ScalingGrid& grid, const MotionLimits& limits, const ConstraintSource& source,
            const ScalingBudget& effort)
      : grid_(grid),
        limits_(limits),
        effort_(effort),
        caps_(grid.caps(limits.velocity, effort)),
        rows_(grid, limits, source, caps_, effort) {}

  SquaredSpeeds run(double start, double end) {
    if (end > caps_.back()) return fail(ScalingFailure::end_too_fast);
    if (!backwards(end)) return speeds_;
    const double slack = kSlack * std::max(1., start);
    if (start > open_[0].high + slack) return fail(ScalingFailure::start_too_fast);
    if (start < open_[0].low - slack) return fail(ScalingFailure::end_too_fast);
    forwards(std::clamp(start, open_[0].low, open_[0].high));
    return speeds_;
  }

 private:
  static constexpr double kSlack = 1e-12;

  double reach(int i) const { return 2. * grid_.width(i) * lineLimits(grid_, limits_, i).acceleration; }

  /// A row of the caller that forbids to stand still somewhere is the reason, where there is one.
  SquaredSpeeds& fail(ScalingFailure failure) {
    speeds_.failure = failure;
    for (int i = 0; i < grid_.intervals() && speeds_.row < 0; ++i) {
      speeds_.row = rows_.worstAtRest(i);
      if (speeds_.row >= 0) speeds_.failure = ScalingFailure::cannot_move, speeds_.place = grid_.place(i);
    }
    return speeds_;
  }

  bool backwards(double end) {
    open_.resize(caps_.size());
    open_.back() = {end, end};
    for (int i = grid_.intervals() - 1; i >= 0; --i) {
      effort_.pause(i);
      const Range& next = open_[i + 1];
      const double cap = std::min(caps_[i], kUnlimited);
      open_[i] = grid_.isLine(i) ? Range{std::max(0., next.low - reach(i)), std::min(cap, next.high + reach(i))}
                                 : rows_.before(i, next);
      if (open_[i].is_empty || open_[i].low > open_[i].high) {
        fail(ScalingFailure::end_too_fast);
        return false;
      }
    }
    return true;
  }

  void forwards(double start) {
    speeds_.at.assign(caps_.size(), start);
    speeds_.middle.assign(std::size_t(grid_.intervals()), 0.);
    for (int i = 0; i < grid_.intervals(); ++i) {
      effort_.pause(i);
      const double now = speeds_.at[i];
      const Range& next = open_[i + 1];
      if (grid_.isLine(i)) {
        speeds_.at[i + 1] = std::min(now + reach(i), next.high);
        if (speeds_.at[i + 1] < next.low * (1. - kSlack)) {
          fail(ScalingFailure::end_too_fast);
          return;
        }
      } else if (!rows_.after(i, now, next, speeds_.middle[i], speeds_.at[i + 1]) || speeds_.middle[i] <= 0.) {
        speeds_.place = grid_.place(i);
        fail(ScalingFailure::cannot_move);
        return;
      }
    }
  }

  const ScalingGrid& grid_;
  const MotionLimits& limits_;
  const ScalingBudget& effort_;
  std::vector<double> caps_;
  IntervalRows rows_;
  std::vector<Range> open_;
  SquaredSpeeds speeds_;
};

}  // namespace

SquaredSpeeds fastestSpeeds(const ScalingGrid& grid, const MotionLimits& limits, const ConstraintSource& source,
                            double start_speed, double end_speed, const ScalingBudget& effort) {
  return TwoPasses(grid, limits, source, effort).run(start_speed * start_speed, end_speed * end_speed);
}

TimeScaling scalingOf(const ScalingGrid& grid, const MotionLimits& limits, const SquaredSpeeds& speeds,
                      const ScalingBudget& effort) {
  TimeScaling scaling;
  for (int i = 0; i < grid.intervals(); ++i) {
    effort.pause(i);
    const double s0 = grid.place(i), s1 = grid.place(i + 1), b0 = speeds.at[i], b1 = speeds.at[i + 1];
    if (!grid.isLine(i)) {
      scaling.addQuadratic(s0, s1, b0, speeds.middle[i], b1, grid.piece(i));
      continue;
    }
    const double v0 = std::sqrt(b0), v1 = std::sqrt(b1);
    const LineLimits line = lineLimits(grid, limits, i);
    const double peak = std::max({b0, b1, std::min(line.cap, (b0 + b1) / 2. + grid.width(i) * line.acceleration)});
    const double top = std::sqrt(peak);
    const double risen = std::min(s1, s0 + (peak - b0) / (2. * line.acceleration));
    const double falls = std::max(risen, s1 - (peak - b1) / (2. * line.acceleration));
    if (risen > s0) scaling.addConstantAcceleration(s0, risen, v0, top, line.acceleration, grid.piece(i));
    if (falls > risen) scaling.addConstantAcceleration(risen, falls, top, top, 0., grid.piece(i));
    if (s1 > falls) scaling.addConstantAcceleration(falls, s1, top, v1, line.acceleration, grid.piece(i));
  }
  return scaling;
}

}  // namespace kinegraph
