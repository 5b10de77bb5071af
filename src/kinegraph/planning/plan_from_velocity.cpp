#include "kinegraph/planning/plan_from_velocity.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "kinegraph/planning/acceleration_ramp.h"
#include "kinegraph/planning/plan_timing.h"
#include "kinegraph/planning/planner.h"
#include "kinegraph/trajectories/curve_part.h"

namespace kinegraph::inline planning_internal {

namespace {

constexpr double kLineFactors[] = {1., 2., 4.};  // lengths of lines, as multiples of the stopping distance
constexpr double kShortestLine = 1e-5;           // rad or m: shorter ones have no direction beside rounding
constexpr double kRoundingFactor = 1. + 1e-6;    // on the stopping distance
constexpr double kAboveLimits = 1e-9;            // relative excess of a running motion over its limits, by rounding
constexpr int kParts = 16;                       // of a curved piece, in collision checks
constexpr double kBeyond = 1e-12;                // rad, m: excess over joint limits by rounding

/// Places of a curve between which it is nearly straight.
std::vector<double> placesAlong(const PathCurve& curve) {
  std::vector<double> places = {0.};
  for (int piece = 0; piece < curve.pieces(); ++piece) {
    const double begin = curve.begin(piece), end = curve.end(piece);
    const int parts = curve.isLine(piece) ? 1 : kParts;
    for (int k = 1; k < parts; ++k) places.push_back(begin + k * (end - begin) / parts);
    places.push_back(end);
  }
  return places;
}

MatrixXd pointsAt(const PathCurve& curve, const std::vector<double>& places) {
  MatrixXd points(Eigen::Index(places.size()), curve.dofs());
  for (std::size_t i = 0; i < places.size(); ++i) points.row(Eigen::Index(i)) = curve.eval(places[i]).transpose();
  return points;
}

/// Returns the curve with marks at these places.
PathCurve marked(const PathCurve& curve) {
  PathCurve::Parts parts = curve.parts();
  parts.marks = placesAlong(curve);
  return PathCurve::fromParts(parts);
}

class PlanFromVelocity {
 public:
  PlanFromVelocity(const Config& config, const MotionGoal& goal, const PlanOptions& options, const VectorXd& start,
                   const CancellationToken& cancellation)
      : config_(config),
        goal_(goal),
        options_(options),
        at_rest_(options),
        start_(start),
        velocity_(options.start_velocity),
        acceleration_(options.start_acceleration),
        cancellation_(cancellation),
        limits_(limitsFromStart(planLimits(config, options), options)),
        space_(*config.model()),
        scene_(config.state()) {
    at_rest_.start_velocity = at_rest_.start_acceleration = {};
    at_rest_.obstacle_trajectories.clear();
    best_.scene = std::make_shared<const State>(scene_);
    best_.space = std::make_shared<const JointSpace>(space_);
  }

  MotionPlan run(const KnownCurves& known) {
    if (!keepsLimits("velocity", velocity_, limits_.velocity) ||
        !keepsLimits("acceleration", acceleration_, limits_.acceleration) || !checkStart())
      return std::move(best_);
    for (const KnownCurves::Timed& rest : known.to_goal)
      if (takeWhole(rest)) return std::move(best_);
    if (velocity_.isZero(0.)) return planOnward(start_);
    tryAll(known);
    if (!best_.feasible() && best_.message.empty()) fail();
    return std::move(best_);
  }

 private:
  bool isCancelled() const { return cancellation_ && cancellation_(); }
  bool isStopped() const { return isCancelled() || seconds() > options_.time_limit; }
  double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - began_).count(); }

  /// Sets the status and message of a failure.
  void fail() {
    if (isCancelled()) {
      best_.status = PlanStatus::cancelled;
      best_.message = "cancelled before the motion came to rest";
    } else if (isStopped()) {
      best_.status = PlanStatus::timeout;
      best_.message = cat("time limit of ", options_.time_limit, " s; no motion that comes to rest was found");
    } else {
      best_.status = PlanStatus::no_path_found;
      best_.message = cat("the motion cannot come to rest: ", failure_);
    }
  }

  /// Plans from rest at the end of the first segment, in the time that is left.
  MotionPlan planOnward(const VectorXd& from) {
    at_rest_.time_limit = options_.timeLeft(seconds());
    return planFromRest(config_, goal_, at_rest_, from, cancellation_);
  }

  void tryAll(const KnownCurves& known) {
    const FirstSegment ramp = accelerationRamp();
    for (const double farther : kLineFactors)  // the shortest is tried even without time left
      if (farther == kLineFactors[0] || !isStopped()) tryLine(ramp, farther);
    for (const PathCurve& curve : known.to_rest)
      if (!best_.feasible() && !isStopped()) tryFirstSegment({marked(curve), {}, "along the present motion"});
    for (const KnownCurves::Timed& stop : known.to_stop)
      if (!best_.feasible() && !isStopped())
        tryFirstSegment({marked(stop.curve), stop.scaling, "along the present motion"});
  }

  /// Whether the initial velocity or acceleration keeps its limits; else sets the status.
  bool keepsLimits(const char* what, const VectorXd& initial, const VectorXd& limits) {
    for (Eigen::Index j = 0; j < initial.size(); ++j) {
      if (std::abs(initial[j]) <= limits[j]) continue;
      best_.status = PlanStatus::invalid_start;
      best_.message =
          cat("the start ", what, " of ", space_.nameOf(int(j)), " is ", initial[j], "; its limit is ", limits[j]);
      return false;
    }
    return true;
  }

  bool checkStart() {
    Steering steering(constraintsAround(scene_, space_, options_, {}));
    start_endpoint_ = checkEndpoint(steering, *config_.model(), start_, options_.margin, "start", kPlanMotion);
    if (start_endpoint_.isFree()) return true;
    best_.status = PlanStatus::invalid_start;
    best_.message = start_endpoint_.problem;
    return false;
  }

  /// Steering with the clearances around the start and other endpoints of the motion.
  Steering steeringTo(const std::vector<VectorXd>& others) {
    Steering loose(constraintsAround(scene_, space_, options_, {}));
    std::vector<Endpoint> ends;
    for (const VectorXd& q : others)
      ends.push_back(checkEndpoint(loose, *config_.model(), q, options_.margin, "goal", kPlanMotion));
    std::vector<const Endpoint*> list = {&start_endpoint_};
    for (const Endpoint& end : ends) list.push_back(&end);
    return Steering(constraintsAround(scene_, space_, options_, list));
  }

  /// The stopping distance as a factor on the velocity, for constant acceleration and jerk.
  double distanceToRest(const VectorXd& velocity) const {
    double acceleration = std::numeric_limits<double>::infinity(), jerk = acceleration;  // as multiples of the velocity
    for (Eigen::Index j = 0; j < velocity.size(); ++j) {
      const double speed = std::abs(velocity[j]);
      if (speed == 0.) continue;
      acceleration = std::min(acceleration, limits_.acceleration[j] / speed);
      if (limits_.limitsJerk()) jerk = std::min(jerk, limits_.jerk[j] / speed);
    }
    double time = 1. / acceleration;
    if (limits_.limitsJerk())
      time = jerk < acceleration * acceleration ? 2. / std::sqrt(jerk) : 1. / acceleration + acceleration / jerk;
    return .5 * kRoundingFactor * time;
  }

  RetimeOptions timing() const {
    RetimeOptions options;
    options.start_velocity = velocity_;
    options.start_acceleration = acceleration_;
    return options;
  }

  /// The first segment of a motion: an acceleration ramp, a line, or a part of the running motion.
  struct FirstSegment {
    PathCurve curve;                   ///< no pieces: the motion begins at `end`
    TimeScaling scaling;               ///< that ends at rest; no phases: it is timed together with the rest
    std::string how;                   ///< for messages
    VectorXd end = {}, velocity = {};  ///< at the end of an acceleration ramp
  };

  FirstSegment accelerationRamp() const {
    FirstSegment first{{}, {}, "straight", start_, velocity_};
    if (acceleration_.size() == 0 || acceleration_.isZero(0.)) return first;
    const AccelerationRamp ramp = rampDown(start_, velocity_, acceleration_, limits_);
    first.curve = ramp.curve.pieces() > 0 ? marked(ramp.curve) : PathCurve();
    first.end = ramp.q, first.velocity = ramp.velocity;
    return first;
  }

  /// Takes the rest of the running motion, if it is collision-free.
  bool takeWhole(const KnownCurves::Timed& rest) {
    const PathCurve whole = marked(rest.curve);
    const MatrixXd rows = pointsAt(whole, whole.marks());
    Steering steering = steeringTo({rows.bottomRows(1).transpose()});
    if (!isFree(steering, whole, kParts)) return false;
    TimedPath timed =
        rest.scaling.phases().empty() ? retime(rows, whole, limits_, timing()) : timedBy(rest.scaling, rows, whole);
    if (!timed.feasible()) return false;
    best_ = MotionPlan();
    best_.status = PlanStatus::solved;
    best_.scene = std::make_shared<const State>(scene_);
    best_.space = std::make_shared<const JointSpace>(space_);
    best_.path = best_.raw_path = rows;
    best_.length = pathLength(space_, rows);
    best_.goal = 0;
    best_.margin = options_.margin;
    best_.verified_margin =
        std::min(start_endpoint_.clearance, steering.check().marginAt(rows.bottomRows(1).transpose()));
    const std::string warning = marginWarning(*config_.model(), start_endpoint_, options_.margin, "start");
    if (!warning.empty()) best_.warnings.push_back(warning);
    best_.stages.push_back({"verify", 0., steering.evaluations(), "the rest of the present motion is collision-free"});
    for (const std::string& name : steering.manifold().sampled())
      best_.warnings.push_back(cat("the constraint ", name, " was checked at samples ", Steering::kSpacing, " apart"));
    best_.timed_path = std::move(timed);
    return true;
  }

  /// Tries a straight line from the end of the ramp, `farther` times as long as the stopping distance.
  void tryLine(const FirstSegment& ramp, double farther) {
    if (ramp.curve.pieces() == 0 && acceleration_.size() > 0 && !acceleration_.isZero(0.)) {
      failure_ = "the velocity is nearly zero at the end of the acceleration ramp";
      return;
    }
    MatrixXd points(2, start_.size());
    const double speed = ramp.velocity.stableNorm();
    const double length = std::max(farther * distanceToRest(ramp.velocity) * speed, kShortestLine);
    points << ramp.end.transpose(), (ramp.end + length / speed * ramp.velocity).transpose();
    const PathCurve line = polyline(points);
    FirstSegment first = ramp;
    first.curve = ramp.curve.pieces() > 0 ? joined(ramp.curve, line, false) : line;
    tryFirstSegment(first, &ramp.curve);
  }

  /// Plans from the end of a first segment. If it ends with a line behind `ramp`, the corner may be rounded.
  void tryFirstSegment(const FirstSegment& first, const PathCurve* ramp = nullptr) {
    const VectorXd end = first.curve.eval(first.curve.length());
    if (const std::string beyond = ramp ? firstBeyond(first.curve) : space_.beyondLimits(end, 0.); !beyond.empty()) {
      failure_ = cat("continuing ", first.how, " exceeds the limits: ", beyond);
      return;
    }
    Steering to_end = steeringTo({end});
    if (!isFree(to_end, first.curve, kParts)) {
      failure_ = cat("continuing ", first.how, " is in collision");
      return;
    }
    MotionPlan plan = planOnward(end);
    if (!plan.feasible()) {
      if (!best_.feasible()) best_ = std::move(plan);
      return;
    }
    Steering steering = steeringTo({end, plan.path.bottomRows(1).transpose()});
    const MatrixXd before = pointsAt(first.curve, first.curve.marks());
    MatrixXd waypoints(before.rows() + plan.path.rows() - 1, before.cols());
    waypoints << before, plan.path.bottomRows(plan.path.rows() - 1);
    TimedPath timed = first.scaling.phases().empty()
                          ? retime(waypoints, joined(first.curve, plan.timed_path.curve()), limits_, timing())
                          : concatenated(timedBy(first.scaling, before, first.curve), plan.timed_path);
    if (ramp) {
      TimedPath smoother = retime(waypoints, rounded(*ramp, waypoints, steering), limits_, timing());
      if (smoother.feasible() && (!timed.feasible() || smoother.duration() < timed.duration()))
        timed = std::move(smoother);
    }
    if (!timed.feasible()) {
      failure_ = timed.message;
      return;
    }
    if (best_.feasible() && best_.duration() <= timed.duration()) return;
    MatrixXd raw(before.rows() + plan.raw_path.rows() - 1, before.cols());
    raw << before, plan.raw_path.bottomRows(plan.raw_path.rows() - 1);
    plan.raw_path = std::move(raw);
    plan.length = pathLength(space_, waypoints);
    plan.verified_margin = std::min(plan.verified_margin, start_endpoint_.clearance);
    plan.path = std::move(waypoints);
    plan.timed_path = std::move(timed);
    best_ = std::move(plan);
  }

  /// Rounds the corners of the path through `rows` behind the ramp.
  PathCurve rounded(const PathCurve& ramp, const MatrixXd& rows, Steering& steering) const {
    const BlendOptions blends{options_.blend, limits_.limitsJerk(), collisionFreeBlends(steering)};
    if (ramp.pieces() == 0) return blendedPolyline(rows, blends);
    const auto before = Eigen::Index(ramp.marks().size()) - 1;
    return joined(ramp, blendedPolyline(rows.bottomRows(rows.rows() - before), blends), false);
  }

  /// Describes the first joint limit that a curve exceeds; "" if there is none. A polynomial stays within its Bernstein
  /// coefficients.
  std::string firstBeyond(const PathCurve& curve) const {
    for (int piece = 0; piece < curve.pieces(); ++piece) {
      for (const VectorXd& q : bernsteinOf(curve, piece))
        if (std::string beyond = space_.beyondLimits(q, kBeyond); !beyond.empty()) return beyond;
    }
    return "";
  }

  const Config& config_;
  const MotionGoal& goal_;
  const PlanOptions& options_;
  PlanOptions at_rest_;
  const VectorXd start_, velocity_;
  const VectorXd acceleration_;
  const CancellationToken& cancellation_;
  const std::chrono::steady_clock::time_point began_ = std::chrono::steady_clock::now();
  const MotionLimits limits_;
  const JointSpace space_;
  const State scene_;
  Endpoint start_endpoint_;
  MotionPlan best_;
  std::string failure_;
};

void widen(VectorXd& limits, const VectorXd& initial) {
  for (Eigen::Index j = 0; j < initial.size(); ++j)
    if (std::abs(initial[j]) <= limits[j] * (1. + kAboveLimits))
      limits[j] = std::max(limits[j], std::abs(initial[j]) * (1. + 1e-12));
}

}  // namespace

MotionLimits limitsFromStart(MotionLimits limits, const PlanOptions& options) {
  widen(limits.velocity, options.start_velocity);
  widen(limits.acceleration, options.start_acceleration);
  return limits;
}

MotionPlan planFromVelocity(const Config& config, const MotionGoal& goal, const PlanOptions& options,
                            const VectorXd& start, const CancellationToken& cancellation, const KnownCurves& known) {
  const bool at_rest = options.start_velocity.size() == 0 || options.start_velocity.isZero(0.);
  if (at_rest && known.to_goal.empty()) return planFromRest(config, goal, options, start, cancellation);
  return PlanFromVelocity(config, goal, options, start, cancellation).run(known);
}

}  // namespace kinegraph::inline planning_internal
