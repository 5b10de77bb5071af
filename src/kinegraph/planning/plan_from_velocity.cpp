#include "kinegraph/planning/plan_from_velocity.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "kinegraph/planning/acceleration_ramp.h"
#include "kinegraph/planning/plan_timing.h"
#include "kinegraph/planning/planner.h"
#include "kinegraph/trajectories/curve_part.h"

namespace kinegraph {

namespace {

constexpr const char* kStarting = "planMotion";
constexpr double kLineFactors[] = {1., 2., 4.};  // lines on which it goes on, as multiples of what it takes to stop
constexpr double kALittle = 1. + 1e-6;           // more than what it takes, so that rounding does no harm
constexpr double kAboveLimits = 1e-9;            // by which what a running motion has may be above limits, as a share
constexpr int kParts = 16;                       // of what is curved, when it is looked at
constexpr double kBeyond = 1e-12;                // rad, m: by which rounding may leave the limits of joints

/// Places of a curve between which it is straight, or nearly so.
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

/// The same curve with marks at all of these places.
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
    if (!allowed("velocity", velocity_, limits_.velocity) ||
        !allowed("acceleration", acceleration_, limits_.acceleration) || !looksAtStart())
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

  /// Nothing was planned.
  void fail() {
    if (isCancelled()) {
      best_.status = PlanStatus::cancelled;
      best_.message = "cancelled before the motion came to rest";
    } else if (isStopped()) {
      best_.status = PlanStatus::timeout;
      best_.message = cat("time limit of ", options_.time_limit, " s; no way to come to rest was found");
    } else {
      best_.status = PlanStatus::no_path_found;
      best_.message = cat("the motion cannot come to rest: ", why_);
    }
  }

  /// From an end of the first piece on, in the time that is left.
  MotionPlan planOnward(const VectorXd& from) {
    at_rest_.time_limit = options_.timeLeft(seconds());
    return planFromRest(config_, goal_, at_rest_, from, cancellation_);
  }

  void tryAll(const KnownCurves& known) {
    const Lead ramp = easing();
    for (const double farther : kLineFactors)  // the first one finds straight motions also where there is no time
      if (farther == kLineFactors[0] || !isStopped()) tryLine(ramp, farther);
    for (const PathCurve& curve : known.to_rest)
      if (!best_.feasible() && !isStopped()) tryLead({marked(curve), {}, "as before"});
    for (const KnownCurves::Timed& stop : known.to_stop)
      if (!best_.feasible() && !isStopped()) tryLead({marked(stop.curve), stop.scaling, "as before"});
  }

  PlanningConstraints demandsAround(const std::vector<const Endpoint*>& ends) {
    return {.scene = &scene_,
            .space = &space_,
            .clearance = clearanceAround(options_.margin, ends),
            .constraints = options_.constraints,
            .constraint_tolerance = options_.constraint_tolerance};
  }

  /// Does what the motion begins with keep the limits?
  bool allowed(const char* what, const VectorXd& given, const VectorXd& limits) {
    for (Eigen::Index j = 0; j < given.size(); ++j) {
      if (std::abs(given[j]) <= limits[j]) continue;
      best_.status = PlanStatus::invalid_start;
      best_.message =
          cat("the start ", what, " of ", space_.nameOf(int(j)), " is ", given[j], "; its limit is ", limits[j]);
      return false;
    }
    return true;
  }

  bool looksAtStart() {
    Steering steering(demandsAround({}));
    first_ = checkEndpoint(steering, *config_.model(), start_, options_.margin, "start", kStarting);
    if (first_.isFree()) return true;
    best_.status = PlanStatus::invalid_start;
    best_.message = first_.problem;
    return false;
  }

  /// Steering with the margins that hold around the start and other ends of the motion.
  Steering steeringTo(const std::vector<VectorXd>& others) {
    Steering loose(demandsAround({}));
    std::vector<Endpoint> ends;
    for (const VectorXd& q : others)
      ends.push_back(checkEndpoint(loose, *config_.model(), q, options_.margin, "goal", kStarting));
    std::vector<const Endpoint*> list = {&first_};
    for (const Endpoint& end : ends) list.push_back(&end);
    return Steering(demandsAround(list));
  }

  /// Factor on a velocity: the distance that it takes to come to rest, by constant acceleration and jerk.
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
    return .5 * kALittle * time;
  }

  RetimeOptions timing() const {
    RetimeOptions options;
    options.start_velocity = velocity_;
    options.start_acceleration = acceleration_;
    return options;
  }

  /// Where it goes first: a curve, its end, and how.
  struct Lead {
    PathCurve curve;      ///< no pieces: there is none, and its end is the start
    TimeScaling scaling;  ///< that ends at rest; no phases: it is timed with what follows
    std::string how;
    VectorXd end = {}, velocity = {};  ///< of easing: there
  };

  /// The curve on which accelerations go to zero.
  Lead easing() const {
    Lead lead{{}, {}, "straight", start_, velocity_};
    if (acceleration_.size() == 0 || acceleration_.isZero(0.)) return lead;
    const AccelerationRamp ramp = rampDown(start_, velocity_, acceleration_, limits_);
    lead.curve = ramp.curve.pieces() > 0 ? marked(ramp.curve) : PathCurve();
    lead.end = ramp.q, lead.velocity = ramp.velocity;
    return lead;
  }

  /// The rest of a motion that is known.
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
    best_.verified_margin = std::min(first_.verified_margin, steering.check().marginAt(rows.bottomRows(1).transpose()));
    best_.stages.push_back({"verify", 0., steering.evaluations(), "the rest of the present motion is free"});
    for (const std::string& name : steering.manifold().sampled())
      best_.warnings.push_back(
          cat("the constraint ", name, " was looked at every ", Steering::kSpacing, " along the way"));
    best_.timed = std::move(timed);
    return true;
  }

  /// Straight on from where the accelerations are zero, so many times as far as it takes to come to rest.
  void tryLine(const Lead& ramp, double farther) {
    if (ramp.curve.pieces() == 0 && acceleration_.size() > 0 && !acceleration_.isZero(0.)) {
      why_ = "where its accelerations are zero it hardly moves";
      return;
    }
    MatrixXd points(2, start_.size());
    points << ramp.end.transpose(), (ramp.end + farther * distanceToRest(ramp.velocity) * ramp.velocity).transpose();
    const PathCurve line = polyline(points);
    Lead lead = ramp;
    lead.curve = ramp.curve.pieces() > 0 ? joined(ramp.curve, line, false) : line;
    tryLead(lead, &ramp.curve);
  }

  /// Plans from the end of a lead. Where it ends with a line behind `eased`, the corner may be rounded.
  void tryLead(const Lead& lead, const PathCurve* ramp = nullptr) {
    const VectorXd end = lead.curve.eval(lead.curve.length());
    if (const std::string beyond = ramp ? firstBeyond(lead.curve) : space_.beyondLimits(end, 0.); !beyond.empty()) {
      why_ = cat("going on ", lead.how, " leaves the limits: ", beyond);
      return;
    }
    Steering to_end = steeringTo({end});
    if (!isFree(to_end, lead.curve, kParts)) {
      why_ = cat("going on ", lead.how, " is not free");
      return;
    }
    MotionPlan plan = planOnward(end);
    if (!plan.feasible()) {
      if (!best_.feasible()) best_ = std::move(plan);
      return;
    }
    Steering steering = steeringTo({end, plan.path.bottomRows(1).transpose()});
    const MatrixXd before = pointsAt(lead.curve, lead.curve.marks());
    MatrixXd rows(before.rows() + plan.path.rows() - 1, before.cols());
    rows << before, plan.path.bottomRows(plan.path.rows() - 1);
    TimedPath timed = lead.scaling.phases().empty()
                          ? retime(rows, joined(lead.curve, plan.timed.curve()), limits_, timing())
                          : inTurn(timedBy(lead.scaling, before, lead.curve), plan.timed);
    if (ramp) {
      TimedPath smoother = retime(rows, rounded(*ramp, rows, steering), limits_, timing());
      if (smoother.feasible() && (!timed.feasible() || smoother.duration() < timed.duration()))
        timed = std::move(smoother);
    }
    if (!timed.feasible()) {
      why_ = timed.message;
      return;
    }
    if (best_.feasible() && best_.duration() <= timed.duration()) return;
    MatrixXd first(before.rows() + plan.raw_path.rows() - 1, before.cols());
    first << before, plan.raw_path.bottomRows(plan.raw_path.rows() - 1);
    plan.raw_path = std::move(first);
    plan.length = pathLength(space_, rows);
    plan.verified_margin = std::min(plan.verified_margin, first_.verified_margin);
    plan.path = std::move(rows);
    plan.timed = std::move(timed);
    best_ = std::move(plan);
  }

  /// The lines through these points, the first of which are on an eased curve, with rounded corners.
  PathCurve rounded(const PathCurve& ramp, const MatrixXd& rows, Steering& steering) const {
    const BlendOptions blends{options_.blend, limits_.limitsJerk(), freeBlends(steering)};
    if (ramp.pieces() == 0) return blendedPolyline(rows, blends);
    const auto before = Eigen::Index(ramp.marks().size()) - 1;
    return joined(ramp, blendedPolyline(rows.bottomRows(rows.rows() - before), blends), false);
  }

  /// What of a curve is beyond the limits of joints, in words; "" if nothing is. A polynomial keeps within its Bernstein
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
  Endpoint first_;
  MotionPlan best_;
  std::string why_;
};

void widen(VectorXd& limits, const VectorXd& given) {
  for (Eigen::Index j = 0; j < given.size(); ++j)
    if (std::abs(given[j]) <= limits[j] * (1. + kAboveLimits))
      limits[j] = std::max(limits[j], std::abs(given[j]) * (1. + 1e-12));
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

}  // namespace kinegraph
