#include "kinegraph/trajectories/time_optimal.h"

#include <algorithm>
#include <cmath>

#include "kinegraph/trajectories/binomial.h"
#include "kinegraph/trajectories/two_variable_program.h"

namespace kinegraph::inline trajectories_internal {

namespace {

constexpr double kUnlimited = 1e18;  // represents an infinite s'^2
constexpr double kMiddleShare =
    1e-3;  // weight of the middle coefficient in the objective, for speed within the interval
constexpr double kMiddleShareBefore = 1e-6;
constexpr double kNarrowing = 1e-10;  // relative narrowing of ranges against rounding
constexpr double kMinStep = 1e-13;    // of the largest s'^2: smaller steps vanish by rounding
constexpr int kMaxCuts = 40;

/// Largest |s''| and s'^2 on a line.
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

/// The constraint rows of all intervals in x, y, z, the three Bernstein coefficients of s'^2.
class IntervalRows {
 public:
  IntervalRows(const ScalingGrid& grid, const MotionLimits& limits, const ConstraintSource& source,
               const std::vector<double>& caps, const ScalingBudget& budget);

  /// Returns the range of x from which some z in `next` is reachable.
  Range before(int interval, const Range& next);

  /// Finds the largest z in `next` for this x, and the middle coefficient; false if rounding leaves none.
  bool after(int interval, double x, const Range& next, double& middle, double& z);

  /// Returns the caller's constraint with the largest violation at rest; -1 if none is violated.
  int worstAtRest(int interval) const;

 private:
  struct General {
    double x, y, z, low, high;
  };
  struct Extreme {
    bool is_feasible;
    double value;  ///< x; if no x is feasible, minus the violation of the contradicting rows
    double slope;  ///< derivative of (sign x), or of the violation, by z
  };
  void addInterval(int interval, const MotionLimits& limits);
  void addGeneral(int interval);
  void setProgram(int interval, bool is_before, double fixed);
  Extreme extremeBefore(int interval, double z, double sign);
  double searchBefore(int interval, const Range& next, double sign, bool& is_found);

  const ScalingGrid& grid_;
  const ConstraintSource& source_;
  const std::vector<double>& caps_;
  std::vector<int> limited_;  ///< dofs with an acceleration limit
  Eigen::ArrayXXd x_, y_, z_;
  std::vector<General> general_;  ///< of all intervals, 2 per constraint of the caller
  TwoVariableProgram model_;
  TwoVariableProgram::Answer last_before_, last_after_;
  std::vector<double> fixed_general_;
};

IntervalRows::IntervalRows(const ScalingGrid& grid, const MotionLimits& limits, const ConstraintSource& source,
                           const std::vector<double>& caps, const ScalingBudget& budget)
    : grid_(grid), source_(source), caps_(caps) {
  for (int j = 0; j < grid.curve().dofs(); ++j)
    if (limits.acceleration[j] < kUnlimited) limited_.push_back(j);
  const int rows = int(limited_.size()) * (grid.degree() + 2);
  x_.resize(rows, grid.intervals()), y_.resize(rows, grid.intervals()), z_.resize(rows, grid.intervals());
  for (int i = 0; i < grid.intervals(); ++i) {
    budget.poll(i);
    if (!grid.isLine(i)) addInterval(i, limits);
    if (source) addGeneral(i);
  }
}

/// Let p_k be the coefficients of dq/ds, of degree m. Then h (dq/ds s'' + d2q/ds2 s'^2) is of degree m + 1 with the
/// coefficients
///
///     ((m + 1 - k) p_k (y - x) + k p_k-1 (z - y)) / (m + 1) + m sum_l C(2, l) C(m - 1, k - l) / C(m + 1, k) d_k-l b_l
///
/// with b = (x, y, z), d_k = p_k+1 - p_k. Each row is divided by h times its limit.
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
      double curvature[3];
      for (int l = 0; l < 3; ++l) curvature[l] = weight[l] != 0. ? weight[l] * (p(j, k - l + 1) - p(j, k - l)) : 0.;
      x_(k * count + r, interval) = (curvature[0] - rise) * unit;
      y_(k * count + r, interval) = (curvature[1] + rise - fall) * unit;
      z_(k * count + r, interval) = (curvature[2] + fall) * unit;
    }
  }
}

/// a s'' + b s'^2 + c at both ends, with s'' = (y - x) / h and (z - y) / h.
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

/// Sets up the linear program in one end and the middle coefficient; `fixed` is the other end.
void IntervalRows::setProgram(int interval, bool is_before, double fixed) {
  model_.u = is_before ? x_.col(interval) : z_.col(interval);
  model_.w = y_.col(interval);
  model_.t = (is_before ? z_.col(interval) : x_.col(interval)) * fixed;
  const double cap0 = std::min(caps_[interval], kUnlimited), cap1 = std::min(caps_[interval + 1], kUnlimited);
  model_.x_low = 0., model_.x_high = is_before ? cap0 : cap1;
  model_.y_low = 0., model_.y_high = (cap0 + cap1) / 2.;
  if (!source_) return;
  model_.others.clear(), fixed_general_.clear();
  const std::size_t rows = 2 * std::size_t(source_.high.size());
  for (std::size_t r = std::size_t(interval) * rows; r < std::size_t(interval + 1) * rows; ++r) {
    const General& row = general_[r];
    const double other = is_before ? row.z : row.x;
    model_.others.push_back({is_before ? row.x : row.z, row.y, other * fixed, row.low, row.high});
    fixed_general_.push_back(other);
  }
}

IntervalRows::Extreme IntervalRows::extremeBefore(int interval, double z, double sign) {
  setProgram(interval, true, z);
  const TwoVariableProgram::Answer answer =
      model_.farthest(sign, sign * kMiddleShareBefore, sign > 0. ? &last_before_ : nullptr);
  if (sign > 0.) last_before_ = answer;
  const Eigen::ArrayXd& by_z = z_.col(interval);
  const auto growth = [&](int inequality) { return model_.signedValue(inequality, by_z, fixed_general_); };
  double slope = 0.;
  for (int k = 0; k < 2; ++k) slope -= answer.multipliers[k] * growth(answer.rows[k]);
  if (answer.third >= 0) slope -= growth(answer.third);
  return {answer.is_feasible, answer.is_feasible ? answer.x : -answer.contradiction, slope};
}

/// Finds the extreme x over all z in `next`. sign x is a concave, piecewise linear function of z. Each step evaluates
/// it at the intersection of the lines at both ends of the remaining interval: the maximum, or a point on a new line.
double IntervalRows::searchBefore(int interval, const Range& next, double sign, bool& is_found) {
  double low = next.low, high = next.high, best = 0.;
  Extreme at_low{false, 0., 0.}, at_high{false, 0., 0.};  // known lines; slope 0: none
  is_found = false;
  double z = sign > 0. ? high : low;
  for (int i = 0; i < kMaxCuts; ++i) {
    const Extreme at = extremeBefore(interval, z, sign);
    if (at.is_feasible && (!is_found || sign * at.value > sign * best)) best = at.value, is_found = true;
    if (at.slope == 0. || z == (at.slope > 0. ? next.high : next.low)) break;
    (at.slope > 0. ? low : high) = z;
    (at.slope > 0. ? at_low : at_high) = at;
    if (high - low <= 1e-13 * next.high) break;
    double meet = (low + high) / 2.;
    if (!at.is_feasible) {
      const double step = std::abs(at.value / at.slope) * (1. + 1e-9) + kMinStep * next.high;
      meet = at.slope > 0. ? z + step : z - step;  // the contradicting rows agree there
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
  const double narrowing = std::min(kNarrowing * range.high, (range.high - range.low) / 4.);
  range.high -= std::max(0., narrowing);
  range.low = std::min(range.low > 0. ? range.low + std::max(0., narrowing) : 0., range.high);
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
  double violation = 0.;
  for (int r = 0; r < rows; ++r) {
    const General& row = general_[std::size_t(interval * rows + r)];
    const double by = std::max(-row.high, row.low);
    if (by > violation) violation = by, worst = r / 2;
  }
  return worst;
}

/// The backward and the forward pass.
class TwoPasses {
 public:
  TwoPasses(const ScalingGrid& grid, const MotionLimits& limits, const ConstraintSource& source,
            const ScalingBudget& budget)
      : grid_(grid),
        limits_(limits),
        budget_(budget),
        caps_(grid.caps(limits.velocity, budget)),
        rows_(grid, limits, source, caps_, budget) {}

  SquaredSpeeds run(double start, double end) {
    if (end > caps_.back()) return fail(ScalingFailure::end_too_fast);
    if (!backwardPass(end)) return speeds_;
    const double slack = kSlack * std::max(1., start);
    if (start > reachable_[0].high + slack) return fail(ScalingFailure::start_too_fast);
    if (start < reachable_[0].low - slack) return fail(ScalingFailure::end_too_fast);
    forwardPass(std::clamp(start, reachable_[0].low, reachable_[0].high));
    return speeds_;
  }

 private:
  static constexpr double kSlack = 1e-12;

  double reach(int i) const { return 2. * grid_.width(i) * lineLimits(grid_, limits_, i).acceleration; }

  /// Reports a constraint of the caller that forbids rest as the cause, if there is one.
  SquaredSpeeds& fail(ScalingFailure failure) {
    speeds_.failure = failure;
    for (int i = 0; i < grid_.intervals() && speeds_.row < 0; ++i) {
      speeds_.row = rows_.worstAtRest(i);
      if (speeds_.row >= 0) speeds_.failure = ScalingFailure::cannot_move, speeds_.place = grid_.place(i);
    }
    return speeds_;
  }

  bool backwardPass(double end) {
    reachable_.resize(caps_.size());
    reachable_.back() = {end, end};
    for (int i = grid_.intervals() - 1; i >= 0; --i) {
      budget_.poll(i);
      const Range& next = reachable_[i + 1];
      const double cap = std::min(caps_[i], kUnlimited);
      reachable_[i] = grid_.isLine(i) ? Range{std::max(0., next.low - reach(i)), std::min(cap, next.high + reach(i))}
                                      : rows_.before(i, next);
      if (reachable_[i].is_empty || reachable_[i].low > reachable_[i].high) {
        fail(ScalingFailure::end_too_fast);
        return false;
      }
    }
    return true;
  }

  void forwardPass(double start) {
    speeds_.at.assign(caps_.size(), start);
    speeds_.middle.assign(std::size_t(grid_.intervals()), 0.);
    for (int i = 0; i < grid_.intervals(); ++i) {
      budget_.poll(i);
      const double now = speeds_.at[i];
      const Range& next = reachable_[i + 1];
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
  const ScalingBudget& budget_;
  std::vector<double> caps_;
  IntervalRows rows_;
  std::vector<Range> reachable_;
  SquaredSpeeds speeds_;
};

}  // namespace

SquaredSpeeds fastestSpeeds(const ScalingGrid& grid, const MotionLimits& limits, const ConstraintSource& source,
                            double start_speed, double end_speed, const ScalingBudget& budget) {
  return TwoPasses(grid, limits, source, budget).run(start_speed * start_speed, end_speed * end_speed);
}

TimeScaling scalingOf(const ScalingGrid& grid, const MotionLimits& limits, const SquaredSpeeds& speeds,
                      const ScalingBudget& budget) {
  TimeScaling scaling;
  for (int i = 0; i < grid.intervals(); ++i) {
    budget.poll(i);
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

}  // namespace kinegraph::inline trajectories_internal
