#include "kinegraph/trajectories/jerk_limited.h"

#include <algorithm>
#include <cmath>

#include "kinegraph/trajectories/jerk_limited_program.h"
#include "kinegraph/trajectories/s_curve_profile.h"
#include "kinegraph/trajectories/scaling_proof.h"

namespace kinegraph::inline trajectories_internal {

namespace {

constexpr double kCrawl = 100., kLeastCrawl = 10.;  // of the time without jerk limits; s
constexpr double kGap = 1e-3;  // largest relative excess of the duration over the optimum on the grid
constexpr double kViolation = 2e-4, kNoViolation = 1e-7;  // relative violation of limits before the slow-down
constexpr double kRoughGap = .01;                         // at which limits between gridpoints are checked first
constexpr double kFirstGap = .3, kNextGap = .01;
constexpr int kMaxNewtonSteps = 80;
constexpr double kStartShare = .9;         // of the speeds without jerk limits
constexpr int kSmoothings = 10;            // of the initial speeds
constexpr double kTightenMore = 2e-6;      // in addition to the violation
constexpr int kTightenMost = 12;           // rounds, if speeds at the ends are fixed
constexpr int kTightenSome = 3;            // rounds, if they are not
constexpr double kSmallSlowDown = 1.0005;  // factor, half of the gap
constexpr int kFewestIntervals = 12;
constexpr int kMaxPlaces = 20000, kSafePlaces = 500;  // of a motion: rounding affects more, and never fewer
constexpr int kBlendParts = 6;                        // of a blend, at least
constexpr double kRestShare = .5;  // duration of the cubic of time, relative to the time until the largest acceleration
constexpr double kRestLength = .02;   // its length, relative to the section
constexpr double kLeastRest = 1e-6;   // its least length, relative to the first interval, for large jerk limits
constexpr double kNear = .4;          // relative distance of other gridpoints from a knot, at least
constexpr double kBrakingShare = .1;  // longest first interval, relative to s'^2 / s''

/// A part of the grid between stops, with the speeds at its ends.
struct Section {
  int begin, end;  ///< intervals
  SectionEnd from, to;
};

std::vector<Section> sectionsOf(const ScalingGrid& grid, const SquaredSpeeds& first, double start_acceleration) {
  const auto endAt = [&](int place) { return SectionEnd{first.at[place] == 0., first.at[place], 0.}; };
  std::vector<Section> sections;
  int begin = 0;
  for (int i = 1; i <= grid.intervals(); ++i) {
    if (i < grid.intervals() && !grid.stopsAt(i)) continue;
    sections.push_back({begin, i, endAt(begin), endAt(i)});
    begin = i;
  }
  if (!sections.front().from.at_rest) sections.front().from.acceleration = start_acceleration;
  return sections;
}

/// The gridpoints of a section, at about equal time steps of the time scaling without jerk limits, and more of them
/// near ends at rest.
class SectionGridpoints {
 public:
  SectionGridpoints(const ScalingGrid& grid, const Section& section, const TimeScaling& scaling,
                    const MotionLimits& limits, const ScalingBudget& budget)
      : grid_(grid), budget_(budget), begin_(grid.place(section.begin)), end_(grid.place(section.end)) {
    const double t0 = scaling.timeOf(begin_), t1 = scaling.timeOf(end_);
    const int count = std::max(kFewestIntervals, int(std::lround(budget.intervals * (t1 - t0) / scaling.duration())));
    const double step = (t1 - t0) / count;
    for (int k = 1; k < count; ++k) {
      budget.poll(k);
      const double t = t0 + step * k;
      const ScalingPhase& phase = scaling.phaseAt(t);
      inner_.push_back(std::clamp(phase.at(t - phase.time).s, begin_, end_));
    }
    addKnots(section);
    if (section.from.acceleration < 0.) addBraking(section.from);
    if (section.from.at_rest) addRest(true, step, limits);
    if (section.to.at_rest) addRest(false, step, limits);
    inner_.insert(inner_.begin(), begin_);
    inner_.push_back(end_);
  }

  const std::vector<double>& all() const { return inner_; }

 private:
  /// Adds the knots of the curve, and points within its blends, whose second derivative is zero at both ends. Removes
  /// other gridpoints near them.
  void addKnots(const Section& section) {
    std::vector<double> knots;
    for (int i = section.begin; i < section.end; ++i) {
      if (i > section.begin && grid_.piece(i) == grid_.piece(i - 1)) continue;
      const PathCurve& curve = grid_.curve();
      const int piece = grid_.piece(i), parts = curve.degree() > 3 && !curve.isLine(piece) ? kBlendParts : 1;
      const double from = curve.begin(piece), length = curve.end(piece) - from;
      for (int part = i > section.begin ? 0 : 1; part < parts; ++part) knots.push_back(from + length * part / parts);
    }
    std::vector<double> others;
    for (std::size_t k = 0; k < inner_.size(); ++k) {
      const double before = k ? inner_[k - 1] : begin_, after = k + 1 < inner_.size() ? inner_[k + 1] : end_;
      const double distance = kNear * (after - before) / 2.;
      const auto next = std::lower_bound(knots.begin(), knots.end(), inner_[k]);
      const bool is_near = (next != knots.end() && *next - inner_[k] < distance) ||
                           (next != knots.begin() && inner_[k] - *(next - 1) < distance);
      if (!is_near && after > before) others.push_back(inner_[k]);
    }
    inner_.resize(others.size() + knots.size());
    std::merge(others.begin(), others.end(), knots.begin(), knots.end(), inner_.begin());
  }

  /// Shortens the first interval of a section that starts braking, so that it ends long before the motion would stop.
  void addBraking(const SectionEnd& from) {
    const double first = (inner_.empty() ? end_ : inner_.front()) - begin_,
                 longest = kBrakingShare * from.squared_speed / -from.acceleration;
    if (longest < first) inner_.insert(inner_.begin(), begin_ + longest);
  }

  /// Adds the interval in which s is a cubic of time, and gridpoints after equal times of that cubic.
  void addRest(bool at_begin, double step, const MotionLimits& limits) {
    const double edge = at_begin ? begin_ : end_, first = std::abs((at_begin ? inner_.front() : inner_.back()) - edge);
    const int piece = at_begin ? grid_.curve().pieceAt(edge) : grid_.curve().pieceAt(inner_.back());
    VectorXd tangent(grid_.curve().dofs());
    grid_.curve().eval(piece, edge, 1, tangent.data());
    const LineMotionLimits along = limitsAlong(tangent.data(), limits);
    const double length = std::min(kRestLength * (end_ - begin_), first);
    const double time =
        std::min({step, kRestShare * along.acceleration / along.jerk, std::cbrt(6. * length / along.jerk)});
    const double rest = std::max(along.jerk * time * time * time / 6., kLeastRest * first);
    std::vector<double> near;
    for (int k = 1; k * k * k * rest < .7 * first; ++k) near.push_back(k * k * k * rest);
    if (near.empty()) near.push_back(first / 2.);
    if (at_begin) {
      for (std::size_t k = 0; k < near.size(); ++k) inner_.insert(inner_.begin() + std::ptrdiff_t(k), begin_ + near[k]);
    } else {
      for (auto it = near.rbegin(); it != near.rend(); ++it) inner_.push_back(end_ - *it);
    }
  }

  const ScalingGrid& grid_;
  const ScalingBudget& budget_;
  double begin_, end_;
  std::vector<double> inner_;
};

/// Returns s'^2 of a time scaling in the middle of each interval, lowered near ends at rest.
std::vector<double> startOf(const ScalingGrid& places, const TimeScaling& scaling, const Section& section,
                            const MotionLimits& limits, const ScalingBudget& budget) {
  std::vector<double> start;
  const double edges[2] = {places.place(0), places.place(places.intervals())};
  double jerk[2];
  for (int end = 0; end < 2; ++end) {
    const int i = end ? places.intervals() - 1 : 0;
    jerk[end] = limitsAlong(places.tangent(i).col(end ? places.degree() : 0).data(), limits).jerk;
  }
  for (int i = 0; i < places.intervals(); ++i) {
    budget.poll(i);
    const double s = places.place(i) + places.width(i) / 2.;
    double inverse = 1. / std::max(1e-12, scaling.squaredSpeedAt(s));
    for (int end = 0; end < 2; ++end) {
      if (!(end ? section.to : section.from).at_rest) continue;
      const double j = jerk[end];
      inverse += 4. / (j * j * std::pow(6. * std::abs(s - edges[end]) / j, 4. / 3.));
    }
    start.push_back(kStartShare / inverse);
  }
  for (int round = 0; round < kSmoothings; ++round) {
    double before = start[0];
    for (std::size_t i = 1; i + 1 < start.size(); ++i) {
      const double now = start[i];
      start[i] = std::min(now, .25 * before + .5 * now + .25 * start[i + 1]);
      before = now;
    }
  }
  return start;
}

/// The largest ratios to the limits, over all intervals of a program and per interval.
struct Shares {
  std::vector<std::array<double, 3>> each;
  std::array<double, 3> most{};
  bool hold() const { return std::max({most[0], most[1], most[2]}) <= 1.; }
};

Shares sharesOf(const JerkLimitedProgram& model, const ScalingProof& proof, const ScalingBudget& budget) {
  Shares shares;
  for (int k = 0; k < model.count(); ++k) {
    budget.poll(k);
    shares.each.push_back(proof.shares(model.first() + k, model.at(k)));
    for (int i = 0; i < 3; ++i) shares.most[i] = std::max(shares.most[i], shares.each.back()[i]);
  }
  return shares;
}

/// The factor by which a time scaling has to be slower to keep the limits.
double slowDownOf(const Shares& shares) {
  return std::max({1., shares.most[0], std::sqrt(shares.most[1]), std::cbrt(shares.most[2])});
}

void addProgram(TimeScaling& scaling, const JerkLimitedProgram& model, const ScalingGrid& places,
                const ScalingBudget& budget) {
  const auto restTime = [](double width, double b) { return 3. * width / std::sqrt(b); };
  const int last = places.intervals() - 1, end = model.first() + model.count();
  if (model.first() == 1) {
    const double w = places.width(0), time = restTime(w, model.at(0)[0]);
    scaling.add({0., {places.place(0), 0., 0., 6. * w / (time * time * time)}, 0., places.place(1), places.piece(0)},
                time);
  }
  for (int k = 0; k < model.count(); ++k) {
    budget.poll(k);
    const int i = model.first() + k;
    const Quadratic b = model.at(k);
    scaling.addQuadratic(places.place(i), places.place(i + 1), b[0], b[1], b[2], places.piece(i));
  }
  if (end == last) {
    const double w = places.width(last), b = model.at(model.count() - 1)[2], time = restTime(w, b);
    scaling.add({0.,
                 {places.place(last), std::sqrt(b), -2. * b / (3. * w), 6. * w / (time * time * time)},
                 0.,
                 places.place(last + 1),
                 places.piece(last)},
                time);
  }
}

/// Tightens the limits that a program violates between its gridpoints.
void tighten(JerkLimitedProgram& model, const Shares& shares, const ScalingBudget& budget) {
  for (int k = 0; k < model.count(); ++k) {
    budget.poll(k);
    std::array<double, 3> ratios = shares.each[std::size_t(k)];
    for (double& ratio : ratios) ratio = ratio > 1. ? ratio + kTightenMore : 1.;
    for (const int near : {k, std::min(k + 1, model.count() - 1)}) model.tighten(near, ratios);
  }
}

/// Computes the time scaling of a curved section; empty if there is none.
TimeScaling curvedScalingOnce(const ScalingGrid& grid, const Section& section, const TimeScaling& first,
                              const MotionLimits& limits, const ConstraintSource& rows, const ScalingBudget& budget) {
  const ScalingGrid places(grid.curve(), SectionGridpoints(grid, section, first, limits, budget).all(), budget);
  const ScalingProof proof(places, limits);
  JerkLimitedProgram model(places, limits, rows, section.from, section.to, budget);
  std::vector<double> start = startOf(places, first, section, limits, budget);
  const bool may_slow_down = section.from.at_rest && section.to.at_rest;
  const double violation = may_slow_down && !rows ? kViolation : kNoViolation;
  TimeScaling scaling;
  model.begin(start, kFirstGap);
  model.improve(kRoughGap, 1., kMaxNewtonSteps);
  Shares shares = sharesOf(model, proof, budget);
  if (!shares.hold()) {
    tighten(model, shares, budget);
    for (int k = 0; k < model.count(); ++k) start[std::size_t(model.first() + k)] = model.at(k)[1];
  }
  bool is_solved = model.improve(kGap, violation, kMaxNewtonSteps);
  if (!is_solved && may_slow_down) {  // tightened limits may hold up the iteration; a slower start has slack everywhere
    model.begin(start, kFirstGap);
    is_solved = model.improve(kGap, violation, kMaxNewtonSteps) || (!rows && model.isFinite());
  }
  if (!is_solved) return scaling;
  shares = sharesOf(model, proof, budget);
  for (int round = 0; !may_slow_down && round < kTightenMost && !shares.hold(); ++round) {
    tighten(model, shares, budget);
    for (int k = 0; k < model.count(); ++k) start[std::size_t(model.first() + k)] = model.at(k)[1];
    model.begin(start, kNextGap);
    if (!model.improve(kGap, violation, kMaxNewtonSteps)) return scaling;
    shares = sharesOf(model, proof, budget);
  }
  if (!may_slow_down && !shares.hold()) return scaling;
  addProgram(scaling, model, places, budget);
  scaling.slowDown(slowDownOf(shares));
  // A slow-down is one of the whole section. Where a few intervals demand much of it, their limits are tightened.
  for (int round = 0; budget.tight && round < kTightenSome && slowDownOf(shares) > kSmallSlowDown; ++round) {
    tighten(model, shares, budget);
    if (!model.improve(kGap, violation, kMaxNewtonSteps)) break;
    shares = sharesOf(model, proof, budget);
    TimeScaling next;
    addProgram(next, model, places, budget);
    next.slowDown(slowDownOf(shares));
    if (!(next.duration() < scaling.duration())) break;
    scaling = std::move(next);
  }
  return scaling;
}

/// The same with half as many gridpoints as long as rounding affects the result: the condition of the matrices grows
/// with the fourth power of their number. Rounding makes a time scaling slower than one with few gridpoints.
TimeScaling curvedScaling(const ScalingGrid& grid, const Section& section, const TimeScaling& first,
                          const MotionLimits& limits, const ConstraintSource& rows, const ScalingBudget& budget) {
  if (budget.intervals <= kSafePlaces) return curvedScalingOnce(grid, section, first, limits, rows, budget);
  ScalingBudget fewer{kSafePlaces, budget.cancellation, budget.tight};
  TimeScaling safe = curvedScalingOnce(grid, section, first, limits, rows, fewer);
  for (fewer.intervals = std::min(budget.intervals, kMaxPlaces); fewer.intervals > kSafePlaces; fewer.intervals /= 2) {
    TimeScaling scaling = curvedScalingOnce(grid, section, first, limits, rows, fewer);
    if (!scaling.phases().empty() && (safe.phases().empty() || scaling.duration() <= safe.duration())) return scaling;
  }
  return safe;
}

/// Whether a section that may not slow down as a whole takes so long that it is no timing at all. The first feasible
/// iterate may be such a one.
bool crawls(const Section& section, const TimeScaling& scaling, const TimeScaling& fast, const ScalingGrid& grid) {
  if (section.from.at_rest && section.to.at_rest) return false;
  const double quick = fast.timeOf(grid.place(section.end)) - fast.timeOf(grid.place(section.begin));
  return scaling.duration() > kCrawl * quick + kLeastCrawl;
}

}  // namespace

JerkLimitedScaling jerkLimitedScaling(const ScalingGrid& grid, const SquaredSpeeds& first, double start_acceleration,
                                      const MotionLimits& limits, const ConstraintSource& rows,
                                      const ScalingBudget& budget) {
  JerkLimitedScaling smooth;
  const TimeScaling fast = scalingOf(grid, limits, first, budget);
  for (const Section& section : sectionsOf(grid, first, start_acceleration)) {
    bool is_found = true;
    if (section.end == section.begin + 1 && grid.isLine(section.begin) && section.from.acceleration == 0.) {
      const LineMotionLimits along = limitsAlong(grid.tangent(section.begin).data(), limits);
      is_found = addSCurve(smooth.scaling, grid.place(section.begin), grid.place(section.end),
                           std::sqrt(section.from.squared_speed), std::sqrt(section.to.squared_speed), along,
                           grid.piece(section.begin));
    } else {
      TimeScaling scaling = curvedScaling(grid, section, fast, limits, rows, budget);
      is_found = !scaling.phases().empty() && !crawls(section, scaling, fast, grid);
      smooth.scaling.append(scaling);
    }
    if (is_found) continue;
    const bool by_start = !section.from.at_rest;
    smooth.failure = by_start              ? ScalingFailure::start_too_fast
                     : !section.to.at_rest ? ScalingFailure::end_too_fast
                                           : ScalingFailure::cannot_move;
    smooth.place = grid.place(section.begin);
    return smooth;
  }
  return smooth;
}

}  // namespace kinegraph::inline trajectories_internal
