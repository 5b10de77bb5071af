#include "kinegraph/motion/plan_in_motion.h"

#include <algorithm>
#include <cmath>

#include "kinegraph/motion/plan_timing.h"
#include "kinegraph/motion/planner.h"
#include "kinegraph/spline/curve_part.h"

namespace kinegraph {

namespace {

constexpr const char* kStarting = "planMotion";
constexpr double kLineFactors[] = {1., 2., 4.};  // lines on which it goes on, as multiples of what it takes to stop
constexpr double kALittle = 1. + 1e-6;           // more than what it takes, so that rounding does no harm
constexpr double kAboveLimits = 1e-9;  // by which velocities of a running motion may be above limits, as a share
constexpr int kParts = 16;             // of what is curved, when it is looked at

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

class PlanInMotion {
 public:
  PlanInMotion(const Config& config, const MotionGoal& goal, const PlanOptions& options, const VectorXd& start,
               const MotionWatch& watch)
      : config_(config),
        goal_(goal),
        options_(options),
        at_rest_(options),
        start_(start),
        velocity_(options.start_velocity),
        watch_(watch),
        limits_(planLimits(config, options)),
        space_(*config.program()),
        scene_(config.state()) {
    at_rest_.start_velocity = {};
    at_rest_.moving.clear();
  }

  MotionPlan run(const KnownCurves& known) {
    if (!allowsVelocity() || !looksAtStart()) return std::move(best_);
    for (const PathCurve& curve : known.to_goal)
      if (takeWhole(curve)) return std::move(best_);
    if (velocity_.isZero(0.)) return planFromRest(config_, goal_, at_rest_, start_, watch_);
    for (const double farther : kLineFactors)
      if (!isStopped()) tryLine(farther * distanceToRest());
    for (const PathCurve& curve : known.to_rest)
      if (!best_.feasible() && !isStopped()) tryLead(marked(curve), false);
    if (!best_.feasible() && best_.message.empty()) {
      best_.status = PlanStatus::no_way;
      best_.message = cat("the motion cannot come to rest: ", why_);
    }
    return std::move(best_);
  }

 private:
  bool isStopped() const { return watch_ && watch_(); }

  MotionDemands demandsAround(const std::vector<const MotionEnd*>& ends) {
    return {.scene = &scene_,
            .space = &space_,
            .clearance = clearanceAround(options_.margin, ends),
            .constraints = options_.constraints,
            .constraint_tolerance = options_.constraint_tolerance};
  }

  bool allowsVelocity() {
    for (Eigen::Index j = 0; j < velocity_.size(); ++j) {
      double& limit = limits_.velocity[j];
      const double speed = std::abs(velocity_[j]);
      if (speed > limit * (1. + kAboveLimits)) {
        best_.status = PlanStatus::start_blocked;
        best_.message =
            cat("the start velocity of ", space_.nameOf(int(j)), " is ", velocity_[j], "; its limit is ", limit);
        return false;
      }
      limit = std::max(limit, speed * (1. + 1e-12));
    }
    return true;
  }

  bool looksAtStart() {
    Steering steering(demandsAround({}));
    first_ = checkEnd(steering, *config_.program(), start_, options_.margin, "start", kStarting);
    if (first_.isFree()) return true;
    best_.status = PlanStatus::start_blocked;
    best_.message = first_.problem;
    return false;
  }

  /// Steering with the margins that hold around the start and other ends of the motion.
  Steering steeringTo(const std::vector<VectorXd>& others) {
    Steering loose(demandsAround({}));
    std::vector<MotionEnd> ends;
    for (const VectorXd& q : others)
      ends.push_back(checkEnd(loose, *config_.program(), q, options_.margin, "goal", kStarting));
    std::vector<const MotionEnd*> list = {&first_};
    for (const MotionEnd& end : ends) list.push_back(&end);
    return Steering(demandsAround(list));
  }

  /// Factor on the velocity: the distance that it takes to come to rest, by constant acceleration and jerk.
  double distanceToRest() const {
    double acceleration = std::numeric_limits<double>::infinity(), jerk = acceleration;  // as multiples of the velocity
    for (Eigen::Index j = 0; j < velocity_.size(); ++j) {
      const double speed = std::abs(velocity_[j]);
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
    return options;
  }

  /// The rest of a motion that is known.
  bool takeWhole(const PathCurve& curve) {
    const PathCurve whole = marked(curve);
    const MatrixXd rows = pointsAt(whole, whole.marks());
    Steering steering = steeringTo({rows.bottomRows(1).transpose()});
    if (!isFree(steering, whole, kParts)) return false;
    TimedPath timed = retime(rows, whole, limits_, timing());
    if (!timed.feasible()) return false;
    best_ = MotionPlan();
    best_.status = PlanStatus::solved;
    best_.scene = std::make_shared<const State>(scene_);
    best_.space = std::make_shared<const JointSpace>(space_);
    best_.path = best_.first_way = rows;
    best_.length = pathLength(space_, rows);
    best_.goal = 0;
    best_.margin = options_.margin;
    best_.kept = std::min(first_.kept, steering.check().marginAt(rows.bottomRows(1).transpose()));
    best_.stages.push_back({"verify", 0., steering.evaluations(), "the rest of the present motion is free"});
    best_.timed = std::move(timed);
    return true;
  }

  void tryLine(double distance) {
    MatrixXd points(2, start_.size());
    points << start_.transpose(), (start_ + distance * velocity_).transpose();
    tryLead(polyline(points), true);
  }

  /// Plans from the end of a lead.
  void tryLead(const PathCurve& lead, bool is_line) {
    const VectorXd end = lead.eval(lead.length());
    if (const std::string beyond = space_.beyondLimits(end, 0.); !beyond.empty()) {
      why_ = cat("going on ", is_line ? "straight" : "as before", " leaves the limits: ", beyond);
      return;
    }
    Steering to_end = steeringTo({end});
    if (!isFree(to_end, lead, kParts)) {
      why_ = cat("going on ", is_line ? "straight" : "as before", " is not free");
      return;
    }
    MotionPlan plan = planFromRest(config_, goal_, at_rest_, end, watch_);
    if (!plan.feasible()) {
      if (!best_.feasible()) best_ = std::move(plan);
      return;
    }
    Steering steering = steeringTo({end, plan.path.bottomRows(1).transpose()});
    const MatrixXd before = pointsAt(lead, lead.marks());
    MatrixXd rows(before.rows() + plan.path.rows() - 1, before.cols());
    rows << before, plan.path.bottomRows(plan.path.rows() - 1);
    TimedPath timed = retime(rows, joined(lead, plan.timed.curve()), limits_, timing());
    if (is_line) {
      const PathCurve rounded = blendedPolyline(rows, {options_.blend, limits_.limitsJerk(), freeBlends(steering)});
      TimedPath smoother = retime(rows, rounded, limits_, timing());
      if (smoother.feasible() && (!timed.feasible() || smoother.duration() < timed.duration()))
        timed = std::move(smoother);
    }
    if (!timed.feasible()) {
      why_ = timed.message;
      return;
    }
    if (best_.feasible() && best_.duration() <= timed.duration()) return;
    MatrixXd first(before.rows() + plan.first_way.rows() - 1, before.cols());
    first << before, plan.first_way.bottomRows(plan.first_way.rows() - 1);
    plan.first_way = std::move(first);
    plan.length = pathLength(space_, rows);
    plan.kept = std::min(plan.kept, first_.kept);
    plan.path = std::move(rows);
    plan.timed = std::move(timed);
    best_ = std::move(plan);
  }

  const Config& config_;
  const MotionGoal& goal_;
  const PlanOptions& options_;
  PlanOptions at_rest_;
  const VectorXd start_, velocity_;
  const MotionWatch& watch_;
  MotionLimits limits_;
  const JointSpace space_;
  const State scene_;
  MotionEnd first_;
  MotionPlan best_;
  std::string why_;
};

}  // namespace

MotionPlan planInMotion(const Config& config, const MotionGoal& goal, const PlanOptions& options, const VectorXd& start,
                        const MotionWatch& watch, const KnownCurves& known) {
  const bool at_rest = options.start_velocity.size() == 0 || options.start_velocity.isZero(0.);
  if (at_rest && known.to_goal.empty()) return planFromRest(config, goal, options, start, watch);
  return PlanInMotion(config, goal, options, start, watch).run(known);
}

}  // namespace kinegraph
