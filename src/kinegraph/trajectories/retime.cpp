#include "kinegraph/trajectories/retime.h"

#include <algorithm>
#include <cmath>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/trajectories/corner_stops.h"
#include "kinegraph/trajectories/jerk_limited.h"
#include "kinegraph/trajectories/path_curve.h"
#include "kinegraph/trajectories/scaling_grid.h"
#include "kinegraph/trajectories/time_optimal.h"
#include "kinegraph/trajectories/time_scaling.h"

namespace kinegraph {

struct TimedPath::Motion {
  PathCurve curve;
  TimeScaling scaling;
};

void RetimeOptions::validate() const {
  if (intervals < 2 || intervals > 1000000)
    throw ValueError(cat("retime: intervals is ", intervals, "; expected 2 to 1000000"));
  if (!(tolerance >= 0.)) throw ValueError(cat("retime: tolerance is ", tolerance, "; expected a number >= 0"));
}

std::string retimeStatusName(RetimeStatus status) {
  switch (status) {
    case RetimeStatus::timed:
      return "timed";
    case RetimeStatus::start_too_fast:
      return "start_too_fast";
    case RetimeStatus::end_too_fast:
      return "end_too_fast";
    case RetimeStatus::cannot_move:
      return "cannot_move";
  }
  return "?";
}

Corners cornersOfName(const std::string& name) {
  static const std::vector<std::string> names = {"blend", "stop", "spline"};
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end())
    throw ValueError(cat("retime: corners is '", name, "'; expected one of ", join(names), similarHint(name, names)));
  return Corners(found - names.begin());
}

namespace {

constexpr double kAlong = 1e-6;  // largest relative deviation of a velocity from the direction of the path
constexpr int kNarrowings = 10;
constexpr int kStopRounds = 2;  // of the choice between blends and stops
constexpr int kMaxTrials = 5;   // each with twice as many intervals
constexpr int kMaxIntervals = 1000000;
constexpr int kLargestDegreeOfCurves = 4;                     // of which bounds are known
constexpr int kTrialHalvings = 24, kIntervalsOfTrials = 100;  // of the search for a velocity that would do
constexpr double kBelowBound[] = {1e-6, 1e-4};                // the message gives a value smaller by this share
constexpr double kExcess = 1e-12;                             // of a constraint's range: rounding
constexpr double kNarrowMore = 1.5;                           // times the violation

/// Returns ds/dt for a velocity at s.
double speedOf(const char* name, const VectorXd& velocity, const PathCurve& curve, double s) {
  if (velocity.size() == 0) return 0.;
  if (velocity.size() != curve.dofs())
    throw ValueError(cat("retime: ", name, " has ", velocity.size(), " entries; the path has ", curve.dofs(), " dofs"));
  if (!velocity.allFinite()) throw ValueError(cat("retime: ", name, " has entries that are not finite"));
  if (velocity.isZero(0.)) return 0.;
  const VectorXd direction = curve.eval(s, 1);
  const double norm2 = direction.squaredNorm();
  const double speed = norm2 > 0. ? velocity.dot(direction) / norm2 : 0.;
  const double miss = (velocity - speed * direction).norm() / velocity.norm();
  if (speed <= 0. || miss > kAlong)
    throw ValueError(cat("retime: ", name, " does not point along the path; the direction of the path there is (",
                         direction.normalized().transpose().format(Eigen::IOFormat(4, 0, ", ", ", ")), ")"));
  return speed;
}

/// Returns d^2s/dt^2 for the acceleration at the start.
double startAcceleration(const RetimeOptions& options, const PathCurve& curve, const MotionLimits& limits,
                         double speed) {
  const VectorXd& acceleration = options.start_acceleration;
  if (acceleration.size() == 0) return 0.;
  if (acceleration.size() != curve.dofs())
    throw ValueError(
        cat("retime: start_acceleration has ", acceleration.size(), " entries; the path has ", curve.dofs(), " dofs"));
  if (!acceleration.allFinite()) throw ValueError("retime: start_acceleration has entries that are not finite");
  if (!limits.limitsJerk())
    throw ValueError("retime: start_acceleration requires jerk limits; without them, accelerations jump");
  if (speed == 0. && !acceleration.isZero(0.))
    throw ValueError(
        "retime: start_acceleration requires a start_velocity; motions from rest start without acceleration");
  if (speed == 0.) return 0.;
  const VectorXd direction = curve.eval(0., 1), normal = speed * speed * curve.eval(0., 2);
  const double along = direction.dot(acceleration - normal) / direction.squaredNorm();
  const double miss = (acceleration - normal - along * direction).norm();
  if (miss > kAlong * (acceleration.norm() + normal.norm()))
    throw ValueError(cat("retime: start_acceleration leaves the path by ", miss, "; expected (",
                         normal.transpose().format(Eigen::IOFormat(4, 0, ", ", ", ")),
                         "), the acceleration at constant speed, plus a multiple of the velocity"));
  return along;
}

std::string along(const PathCurve& curve, double s) {
  return cat("at ", 100. * s / std::max(curve.length(), 1e-300), " % of the path");
}

std::string failureText(const SquaredSpeeds& speeds, const PathCurve& curve, const ConstraintSource& rows) {
  switch (speeds.failure) {
    case ScalingFailure::start_too_fast:
      return "the start velocity is above the limits, or cannot be braked within them";
    case ScalingFailure::end_too_fast:
      return "the end velocity is above the limits, or cannot be reached within them";
    case ScalingFailure::cannot_move: {
      const std::string name = speeds.row >= 0 && speeds.row < int(rows.names.size()) ? rows.names[speeds.row] : "";
      if (speeds.row < 0) return cat("no speed keeps the limits ", along(curve, speeds.place));
      const ScalingConstraints at = rows.at(speeds.place, curve.pieceAt(speeds.place));
      return cat(name.empty() ? cat("constraint ", speeds.row) : cat("'", name, "'"), " cannot rest ",
                 along(curve, speeds.place), ": rest requires ", at.c[speeds.row], rows.unit, ", and the limits are ",
                 rows.low[speeds.row], " to ", rows.high[speeds.row], rows.unit);
    }
    case ScalingFailure::none:
      break;
  }
  return "";
}

RetimeStatus statusOf(ScalingFailure failure) {
  switch (failure) {
    case ScalingFailure::start_too_fast:
      return RetimeStatus::start_too_fast;
    case ScalingFailure::end_too_fast:
      return RetimeStatus::end_too_fast;
    case ScalingFailure::cannot_move:
      return RetimeStatus::cannot_move;
    case ScalingFailure::none:
      break;
  }
  return RetimeStatus::timed;
}

/// A limit must bound the speed on every part of the path.
void checkLimited(const ScalingGrid& grid, const MotionLimits& limits, const ScalingBudget& budget) {
  for (int i = 0; i < grid.intervals(); ++i) {
    budget.poll(i);
    std::vector<std::string> moving;
    const auto tangent = grid.tangent(i);
    bool is_limited = false;
    for (int j = 0; j < tangent.rows(); ++j) {
      if (tangent.row(j).abs().maxCoeff() == 0.) continue;
      moving.push_back(std::to_string(j));
      is_limited |= std::isfinite(limits.velocity[j]) || std::isfinite(limits.acceleration[j]);
    }
    if (is_limited || moving.empty()) continue;
    throw ValueError(cat("retime: the speed is unlimited ", along(grid.curve(), grid.place(i)), ": dofs ", join(moving),
                         " move, and their velocity and acceleration limits are infinite"));
  }
}

}  // namespace

namespace {

/// Describes the largest feasible end velocity by bisection, after one that is too fast; "" if it is unknown.
std::string feasibleVelocity(const MatrixXd& path, const TimedPath& failed, const MotionLimits& limits,
                             const RetimeOptions& options) {
  const bool is_start = failed.status == RetimeStatus::start_too_fast;
  if ((!is_start && failed.status != RetimeStatus::end_too_fast) || options.start_acceleration.size() > 0) return "";
  RetimeOptions slower = options;
  VectorXd& velocity = is_start ? slower.start_velocity : slower.end_velocity;
  const VectorXd requested = velocity;
  const auto isFeasible = [&](double share) {
    velocity = share * requested;
    return retime(path, limits, slower, {}).feasible();
  };
  slower.intervals = std::min(options.intervals, kIntervalsOfTrials);
  double low = 0., high = 1.;
  for (int i = 0; i < kTrialHalvings; ++i) {
    const double middle = .5 * (low + high);
    (isFeasible(middle) ? low : high) = middle;
  }
  slower.intervals = options.intervals;
  for (const double below : kBelowBound) {
    const std::string length = cat((1. - below) * low * requested.norm());  // rounded, so it is checked again
    if (low > 0. && isFeasible(readNumber(length.c_str()) / requested.norm()))
      return cat("; a length of at most ", length, " would do");
  }
  return "";
}

}  // namespace

namespace {

/// Times a path with blends. With jerk limits, a small blend may take longer than a stop, because the motion would
/// almost stop in it: corners are blended only if that is faster.
TimedPath retimeWithBlends(const MatrixXd& path, const MotionLimits& limits, const RetimeOptions& options,
                           const std::function<TimedPath(const PathCurve&)>& timed) {
  const bool smooth = limits.limitsJerk();
  std::vector<double> halves = blendHalves(path, {options.tolerance, smooth, options.is_free});
  TimedPath best = timed(blendedPolyline(path, halves, smooth));
  const auto take = [&](const std::vector<double>& tried) {
    TimedPath trial = timed(blendedPolyline(path, tried, smooth));
    const bool is_better = trial.feasible() && (!best.feasible() || trial.duration() < best.duration());
    if (is_better) best = std::move(trial), halves = tried;
    return is_better;
  };
  if (!smooth) return best;
  for (int round = 0; round < kStopRounds && best.feasible(); ++round) {
    std::vector<double> fewer = halves;
    for (const int corner : cornersWithFasterStops(best, halves, limits)) fewer[std::size_t(corner)] = 0.;
    if (fewer == halves || !take(fewer)) break;
  }
  if (std::ranges::any_of(halves, [](double half) { return half > 0.; })) take(std::vector<double>(halves.size(), 0.));
  return best;
}

}  // namespace

TimedPath retime(const MatrixXd& path, const MotionLimits& limits, const RetimeOptions& options,
                 const std::function<ConstraintSource(const PathCurve&)>& constraints_of) {
  options.validate();
  if (path.cols() > 0) limits.validate(int(path.cols()));
  const auto timed = [&](const PathCurve& curve) {
    if (!constraints_of) return retime(path, curve, limits, options);
    RetimeOptions constrained = options;
    constrained.constraints = constraints_of(curve);
    return retime(path, curve, limits, constrained);
  };
  if (options.corners == Corners::blend) return retimeWithBlends(path, limits, options, timed);
  return timed(options.corners == Corners::spline ? cubicSpline(path) : polyline(path));
}

TimedPath retime(const MatrixXd& path, const MotionLimits& limits, const RetimeOptions& options) {
  TimedPath timed = retime(path, limits, options, {});
  timed.message += feasibleVelocity(path, timed, limits, options);
  return timed;
}

namespace {

/// Returns the largest violation of each constraint by a time scaling, also between gridpoints.
VectorXd excessOf(const TimeScaling& scaling, const ConstraintSource& rows, const ScalingBudget& budget) {
  VectorXd excess = VectorXd::Zero(rows.high.size());
  constexpr int kParts = 6;
  for (std::size_t i = 0; i < scaling.phases().size(); ++i) {
    budget.poll(int(i));
    const ScalingPhase& phase = scaling.phases()[i];
    const double time =
        (i + 1 < scaling.phases().size() ? scaling.phases()[i + 1].time : scaling.duration()) - phase.time;
    for (int k = 0; k <= kParts; ++k) {
      const ScalingState state = phase.at(time * k / kParts);
      const ScalingConstraints at = rows.at(state.s, phase.piece);
      const VectorXd value = at.a * state.acceleration + at.b * state.speed * state.speed + at.c;
      excess = excess.cwiseMax(value - rows.high).cwiseMax(rows.low - value);
    }
  }
  return excess;
}

struct Timing {
  TimeScaling scaling;
  SquaredSpeeds speeds;
};

/// ds/dt at both ends, and d^2s/dt^2 at the start.
struct EndSpeeds {
  double start, end, start_acceleration;
};

Timing timingOf(const ScalingGrid& grid, const MotionLimits& limits, const ConstraintSource& rows,
                const EndSpeeds& ends, const ScalingBudget& budget) {
  Timing timing;
  SquaredSpeeds& speeds = timing.speeds = fastestSpeeds(grid, limits, rows, ends.start, ends.end, budget);
  if (speeds.failure != ScalingFailure::none) return timing;
  if (!limits.limitsJerk()) {
    timing.scaling = scalingOf(grid, limits, speeds, budget);
    return timing;
  }
  JerkLimitedScaling smooth = jerkLimitedScaling(grid, speeds, ends.start_acceleration, limits, rows, budget);
  speeds.failure = smooth.failure, speeds.place = smooth.place;
  timing.scaling = std::move(smooth.scaling);
  return timing;
}

/// The same with constraints, whose limits are narrowed by their violation between gridpoints.
Timing timingWithConstraints(const ScalingGrid& grid, const MotionLimits& limits, const ConstraintSource& original,
                             const EndSpeeds& ends, const ScalingBudget& budget) {
  ConstraintSource rows = original;
  Timing timing = timingOf(grid, limits, rows, ends, budget);
  for (int round = 0; round < kNarrowings && timing.speeds.failure == ScalingFailure::none; ++round) {
    const VectorXd excess = excessOf(timing.scaling, original, budget);
    if ((excess.array() <= kExcess * (original.high - original.low).array().min(1e9)).all()) break;
    rows.high -= kNarrowMore * excess, rows.low += kNarrowMore * excess;
    timing = timingOf(grid, limits, rows, ends, budget);
  }
  return timing;
}

/// Tells whether a finer grid may have a time scaling: no further limit fails, or one that holds at rest.
bool needsFinerGrid(const Timing& timing, const PathCurve& curve, const ConstraintSource& rows) {
  const SquaredSpeeds& speeds = timing.speeds;
  if (speeds.failure != ScalingFailure::cannot_move || speeds.row < 0)
    return speeds.failure == ScalingFailure::cannot_move;
  const double at_rest = rows.at(speeds.place, curve.pieceAt(speeds.place)).c[speeds.row];
  return at_rest >= rows.low[speeds.row] && at_rest <= rows.high[speeds.row];
}

TimedPath timedAlong(const MatrixXd& path, const PathCurve& curve, const MotionLimits& limits,
                     const RetimeOptions& options, bool tight) {
  options.validate();
  limits.validate(curve.dofs());
  if (curve.degree() > kLargestDegreeOfCurves)
    throw ValueError(
        cat("retime: the curve has the degree ", curve.degree(), "; expected at most ", kLargestDegreeOfCurves));
  TimeScaling scaling;
  EndSpeeds ends{};
  ends.start = speedOf("start_velocity", options.start_velocity, curve, 0.);
  ends.end = speedOf("end_velocity", options.end_velocity, curve, curve.length());
  ends.start_acceleration = startAcceleration(options, curve, limits, ends.start);
  if (curve.length() == 0.) {
    scaling.add({}, 0.);
    return TimedPath::fromParts(RetimeStatus::timed, "", path, VectorXd::Zero(path.rows()), curve, std::move(scaling));
  }
  ScalingBudget budget{options.intervals, options.cancellation, tight};
  Timing timing;
  for (int trial = 0; trial == 0 || (needsFinerGrid(timing, curve, options.constraints) && trial < kMaxTrials);
       ++trial) {
    if (trial > 0) budget.intervals = std::max(budget.intervals, std::min(2 * budget.intervals, kMaxIntervals));
    const ScalingGrid grid(curve, limits, budget, bool(options.constraints));
    checkLimited(grid, limits, budget);
    timing = options.constraints ? timingWithConstraints(grid, limits, options.constraints, ends, budget)
                                 : timingOf(grid, limits, {}, ends, budget);
  }
  const RetimeStatus status = statusOf(timing.speeds.failure);
  std::string message = failureText(timing.speeds, curve, options.constraints);
  VectorXd times;
  if (status == RetimeStatus::timed) {
    scaling = std::move(timing.scaling);
    times.resize(Eigen::Index(curve.marks().size()));
    for (Eigen::Index i = 0; i < times.size(); ++i) {
      budget.poll(int(i));
      times[i] = scaling.timeOf(curve.marks()[std::size_t(i)]);
    }
  }
  return TimedPath::fromParts(status, std::move(message), path, std::move(times), curve, std::move(scaling));
}

}  // namespace

TimedPath retime(const MatrixXd& path, const PathCurve& curve, const MotionLimits& limits,
                 const RetimeOptions& options) {
  return timedAlong(path, curve, limits, options, false);
}

TimedPath retimeTightly(const MatrixXd& path, const PathCurve& curve, const MotionLimits& limits,
                        const RetimeOptions& options) {
  return timedAlong(path, curve, limits, options, true);
}

void motionAt(const PathCurve& curve, const TimeScaling& scaling, double t, double* q, double* velocity,
              double* acceleration) {
  const double time = std::clamp(t, 0., scaling.duration());
  const ScalingPhase& phase = scaling.phaseAt(time);
  const ScalingState state = phase.at(time - phase.time);
  const double s = std::clamp(state.s, phase.begin.s, phase.end);
  curve.eval(phase.piece, s, 0, q);
  curve.eval(phase.piece, s, 2, acceleration);
  curve.eval(phase.piece, s, 1, velocity);
  for (int j = 0; j < curve.dofs(); ++j) {
    acceleration[j] = velocity[j] * state.acceleration + acceleration[j] * state.speed * state.speed;
    velocity[j] *= state.speed;
  }
}

MotionState motionAt(const PathCurve& curve, const TimeScaling& scaling, double t) {
  const int n = curve.dofs();
  MotionState state{VectorXd(n), VectorXd(n), VectorXd(n)};
  motionAt(curve, scaling, t, state.q.data(), state.velocity.data(), state.acceleration.data());
  return state;
}

void TimedPath::evalTo(double t, double* q, double* velocity, double* acceleration) const {
  if (scaling().phases().empty()) throw ValueError(cat("TimedPath::eval: there is no motion: ", message));
  if (std::isnan(t)) throw ValueError("TimedPath::eval: t is NaN; expected a time in s");
  motionAt(curve(), scaling(), t, q, velocity, acceleration);
}

const TimedPath::Motion& TimedPath::motion() const {
  static const Motion kEmpty{};
  return motion_ ? *motion_ : kEmpty;
}

const PathCurve& TimedPath::curve() const { return motion().curve; }
const TimeScaling& TimedPath::scaling() const { return motion().scaling; }
int TimedPath::dimension() const { return curve().dofs(); }
double TimedPath::duration() const { return scaling().duration(); }

std::string TimedPath::str() const {
  if (!feasible()) return cat(retimeStatusName(status), ": ", message);
  return cat(path.rows(), path.rows() == 1 ? " point in " : " points in ", duration(), " s");
}

TimedPath TimedPath::fromParts(RetimeStatus status, std::string message, MatrixXd path, VectorXd times, PathCurve curve,
                               TimeScaling scaling) {
  TimedPath timed;
  timed.status = status, timed.message = std::move(message);
  timed.path = std::move(path), timed.times = std::move(times);
  timed.motion_ = std::make_shared<const Motion>(Motion{std::move(curve), std::move(scaling)});
  return timed;
}

}  // namespace kinegraph
