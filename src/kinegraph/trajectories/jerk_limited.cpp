#include "kinegraph/trajectories/jerk_limited.h"

#include <algorithm>
#include <cmath>

#include "kinegraph/trajectories/jerk_limited_program.h"
#include "kinegraph/trajectories/s_curve_profile.h"
#include "kinegraph/trajectories/scaling_proof.h"

namespace kinegraph {

namespace {

constexpr double kNoLimit = 1e15;  // stands for an infinite limit
constexpr double kGap = 1e-3;      // by which the duration may exceed the least one of its intervals, as a share
constexpr double kMissed = 2e-4, kMissedNowhere = 1e-7;  // by which limits may be exceeded before speeds are taken back
constexpr double kRoughGap = .01;                        // where limits between the places are looked at first
constexpr double kFirstGap = .3, kNextGap = .01;
constexpr int kMostNewtonSteps = 80;
constexpr double kStartShare = .9;     // of the speeds without limits of the jerk
constexpr int kSmoothings = 10;        // of these
constexpr double kTightenMore = 2e-6;  // than what is exceeded
constexpr int kTightenMost = 12;       // rounds, where speeds at the ends are given
constexpr int kFewestIntervals = 12;
constexpr int kMostPlaces = 20000, kSafePlaces = 500;  // of a motion: rounding spoils more, and does not spoil fewer
constexpr int kBlendParts = 6;                         // of a blend, at least
constexpr double kRestShare = .5;     // of the time until the largest acceleration, in which s is a cubic of time
constexpr double kRestWay = .02;      // of the section's length, likewise
constexpr double kLeastRest = 1e-6;   // of the first interval otherwise, where hardly a jerk is limited
constexpr double kNear = .4;          // of the places' distance: nearer to a knot there is none
constexpr double kBrakingShare = .1;  // of s'^2 / s'' where it begins: the longest first interval

/// A part of the grid between stops, and the speeds at its ends.
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

/// The largest |s'|, |s''|, |s'''| along the tangent at a place, by limits per dof.
LineMotionLimits limitsAlong(const double* tangent, const MotionLimits& limits) {
  LineMotionLimits along{kNoLimit, kNoLimit, kNoLimit};
  for (int j = 0; j < limits.velocity.size(); ++j) {
    const double d = std::abs(tangent[j]);
    if (d == 0.) continue;
    along.speed = std::min(along.speed, limits.velocity[j] / d);
    along.acceleration = std::min(along.acceleration, limits.acceleration[j] / d);
    along.jerk = std::min(along.jerk, limits.jerk[j] / d);
  }
  return along;
}

/// Where b is to be quadratic between: about equally many places per second of the law without limits of the jerk, more
/// of them near the ends where the section is at rest.
class SectionPlaces {
 public:
  SectionPlaces(const ScalingGrid& grid, const Section& section, const TimeScaling& scaling, const MotionLimits& limits,
                const ScalingBudget& effort)
      : grid_(grid), effort_(effort), begin_(grid.place(section.begin)), end_(grid.place(section.end)) {
    const double t0 = scaling.timeOf(begin_), t1 = scaling.timeOf(end_);
    const int count = std::max(kFewestIntervals, int(std::lround(effort.intervals * (t1 - t0) / scaling.duration())));
    const double step = (t1 - t0) / count;
    for (int k = 1; k < count; ++k) {
      effort.pause(k);
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
  /// Knots of the curve are places, and so are some within its blends, whose second derivative is zero at both ends;
  /// others near them are not.
  void addKnots(const Section& section) {
    std::vector<double> knots;
    for (int i = section.begin; i < section.end; ++i) {
      if (i > section.begin && grid_.piece(i) == grid_.piece(i - 1)) continue;
      const PathCurve& curve = grid_.curve();
      const int piece = grid_.piece(i), parts = curve.degree() > 3 && !curve.isLine(piece) ? kBlendParts : 1;
      const double from = curve.begin(piece), length = curve.end(piece) - from;
      for (int part = i > section.begin ? 0 : 1; part < parts; ++part) knots.push_back(from + length * part / parts);
    }
    std::vector<double> kept;
    for (std::size_t k = 0; k < inner_.size(); ++k) {
      const double before = k ? inner_[k - 1] : begin_, after = k + 1 < inner_.size() ? inner_[k + 1] : end_;
      const double room = kNear * (after - before) / 2.;
      const auto next = std::lower_bound(knots.begin(), knots.end(), inner_[k]);
      const bool is_near = (next != knots.end() && *next - inner_[k] < room) ||
                           (next != knots.begin() && inner_[k] - *(next - 1) < room);
      if (!is_near && after > before) kept.push_back(inner_[k]);
    }
    inner_.resize(kept.size() + knots.size());
    std::merge(kept.begin(), kept.end(), knots.begin(), knots.end(), inner_.begin());
  }

  /// Where it begins to brake: the first interval ends long before it would come to rest at that.
  void addBraking(const SectionEnd& from) {
    const double first = (inner_.empty() ? end_ : inner_.front()) - begin_,
                 most = kBrakingShare * from.squared_speed / -from.acceleration;
    if (most < first) inner_.insert(inner_.begin(), begin_ + most);
  }

  /// The interval in which s is a cubic of time, and places after equal times of it.
  void addRest(bool at_begin, double step, const MotionLimits& limits) {
    const double edge = at_begin ? begin_ : end_, first = std::abs((at_begin ? inner_.front() : inner_.back()) - edge);
    const int piece = at_begin ? grid_.curve().pieceAt(edge) : grid_.curve().pieceAt(inner_.back());
    VectorXd tangent(grid_.curve().dofs());
    grid_.curve().eval(piece, edge, 1, tangent.data());
    const LineMotionLimits along = limitsAlong(tangent.data(), limits);
    const double way = std::min(kRestWay * (end_ - begin_), first);
    const double time =
        std::min({step, kRestShare * along.acceleration / along.jerk, std::cbrt(6. * way / along.jerk)});
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
  const ScalingBudget& effort_;
  double begin_, end_;
  std::vector<double> inner_;
};

/// s'^2 of a law in the middle of the intervals of a grid, lowered where the section is at rest.
std::vector<double> startOf(const ScalingGrid& places, const TimeScaling& scaling, const Section& section,
                            const MotionLimits& limits, const ScalingBudget& effort) {
  std::vector<double> start;
  const double edges[2] = {places.place(0), places.place(places.intervals())};
  double jerk[2];
  for (int end = 0; end < 2; ++end) {
    const int i = end ? places.intervals() - 1 : 0;
    jerk[end] = limitsAlong(places.tangent(i).col(end ? places.degree() : 0).data(), limits).jerk;
  }
  for (int i = 0; i < places.intervals(); ++i) {
    effort.pause(i);
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

/// The largest shares of limits over the intervals of a program, and per interval.
struct Shares {
  std::vector<std::array<double, 3>> each;
  std::array<double, 3> most{};
  bool hold() const { return std::max({most[0], most[1], most[2]}) <= 1.; }
};

Shares sharesOf(const JerkLimitedProgram& model, const ScalingProof& proof, const ScalingBudget& effort) {
  Shares shares;
  for (int k = 0; k < model.count(); ++k) {
    effort.pause(k);
    shares.each.push_back(proof.shares(model.first() + k, model.at(k)));
    for (int i = 0; i < 3; ++i) shares.most[i] = std::max(shares.most[i], shares.each.back()[i]);
  }
  return shares;
}

void addProgram(TimeScaling& scaling, const JerkLimitedProgram& model, const ScalingGrid& places,
                const ScalingBudget& effort) {
  const auto restTime = [](double width, double b) { return 3. * width / std::sqrt(b); };
  const int last = places.intervals() - 1, end = model.first() + model.count();
  if (model.first() == 1) {
    const double w = places.width(0), time = restTime(w, model.at(0)[0]);
    scaling.add({0., {places.place(0), 0., 0., 6. * w / (time * time * time)}, 0., places.place(1), places.piece(0)},
                time);
  }
  for (int k = 0; k < model.count(); ++k) {
    effort.pause(k);
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

/// Where a program exceeds limits between its places, they are narrowed by as much.
void tighten(JerkLimitedProgram& model, const Shares& shares, const ScalingBudget& effort) {
  for (int k = 0; k < model.count(); ++k) {
    effort.pause(k);
    std::array<double, 3> ratios = shares.each[std::size_t(k)];
    for (double& ratio : ratios) ratio = ratio > 1. ? ratio + kTightenMore : 1.;
    for (const int near : {k, std::min(k + 1, model.count() - 1)}) model.tighten(near, ratios);
  }
}

/// The law of a section that is curved; empty if there is none.
TimeScaling curvedLawOnce(const ScalingGrid& grid, const Section& section, const TimeScaling& first,
                          const MotionLimits& limits, const ConstraintSource& rows, const ScalingBudget& effort) {
  const ScalingGrid places(grid.curve(), SectionPlaces(grid, section, first, limits, effort).all(), effort);
  const ScalingProof proof(places, limits);
  JerkLimitedProgram model(places, limits, rows, section.from, section.to, effort);
  std::vector<double> start = startOf(places, first, section, limits, effort);
  const bool may_slow_down = section.from.at_rest && section.to.at_rest;
  const double missed = may_slow_down && !rows ? kMissed : kMissedNowhere;
  TimeScaling scaling;
  model.begin(start, kFirstGap);
  model.improve(kRoughGap, 1., kMostNewtonSteps);
  Shares shares = sharesOf(model, proof, effort);
  if (!shares.hold()) tighten(model, shares, effort);
  if (!model.improve(kGap, missed, kMostNewtonSteps)) return scaling;
  shares = sharesOf(model, proof, effort);
  for (int round = 0; !may_slow_down && round < kTightenMost && !shares.hold(); ++round) {
    tighten(model, shares, effort);
    for (int k = 0; k < model.count(); ++k) start[std::size_t(model.first() + k)] = model.at(k)[1];
    model.begin(start, kNextGap);
    if (!model.improve(kGap, missed, kMostNewtonSteps)) return scaling;
    shares = sharesOf(model, proof, effort);
  }
  if (!may_slow_down && !shares.hold()) return scaling;
  addProgram(scaling, model, places, effort);
  const double factor = std::max({1., shares.most[0], std::sqrt(shares.most[1]), std::cbrt(shares.most[2])});
  if (factor > 1.) scaling.slowDown(factor);
  return scaling;
}

/// The same, with half as many places as long as rounding spoils it: the condition of the matrices grows with the fourth
/// power of their number. A law that is spoiled is slower than one of few places.
TimeScaling curvedLaw(const ScalingGrid& grid, const Section& section, const TimeScaling& first,
                      const MotionLimits& limits, const ConstraintSource& rows, const ScalingBudget& effort) {
  if (effort.intervals <= kSafePlaces) return curvedLawOnce(grid, section, first, limits, rows, effort);
  ScalingBudget fewer{kSafePlaces, effort.cancellation};
  TimeScaling safe = curvedLawOnce(grid, section, first, limits, rows, fewer);
  for (fewer.intervals = std::min(effort.intervals, kMostPlaces); fewer.intervals > kSafePlaces; fewer.intervals /= 2) {
    TimeScaling scaling = curvedLawOnce(grid, section, first, limits, rows, fewer);
    if (!scaling.phases().empty() && (safe.phases().empty() || scaling.duration() <= safe.duration())) return scaling;
  }
  return safe;
}

}  // namespace

JerkLimitedScaling jerkLimitedScaling(const ScalingGrid& grid, const SquaredSpeeds& first, double start_acceleration,
                                      const MotionLimits& limits, const ConstraintSource& rows,
                                      const ScalingBudget& effort) {
  JerkLimitedScaling smooth;
  const TimeScaling fast = scalingOf(grid, limits, first, effort);
  for (const Section& section : sectionsOf(grid, first, start_acceleration)) {
    bool is_found = true;
    if (section.end == section.begin + 1 && grid.isLine(section.begin) && section.from.acceleration == 0.) {
      const LineMotionLimits along = limitsAlong(grid.tangent(section.begin).data(), limits);
      is_found = addDoubleS(smooth.scaling, grid.place(section.begin), grid.place(section.end),
                            std::sqrt(section.from.squared_speed), std::sqrt(section.to.squared_speed), along,
                            grid.piece(section.begin));
    } else {
      TimeScaling scaling = curvedLaw(grid, section, fast, limits, rows, effort);
      is_found = !scaling.phases().empty();
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

}  // namespace kinegraph
