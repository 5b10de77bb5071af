#include "kinegraph/planning/plan_motion.h"

#include <chrono>
#include <cmath>

#include "kinegraph/common/errors.h"
#include "kinegraph/planning/plan_among_obstacles.h"
#include "kinegraph/planning/plan_from_velocity.h"
#include "kinegraph/planning/plan_timing.h"
#include "kinegraph/planning/plan_to_velocity.h"
#include "kinegraph/planning/unseen_place.h"
#include "kinegraph/trajectories/curve_part.h"

namespace kinegraph {

namespace {

/// Distances along the curve at which the motion may come to rest, as multiples of an estimate.
constexpr double kCurveFactors[] = {1.05, 1.5, 2.5, 4.};

/// Plans with the start acceleration. If nothing can be timed so, plans without it and adds a warning.
MotionPlan planFromState(const Config& config, const MotionGoal& goal, const PlanOptions& options,
                         const VectorXd& start, const CancellationToken& cancellation, const KnownCurves& known) {
  const auto began = std::chrono::steady_clock::now();
  const auto plan_with = [&](const PlanOptions& by) {
    if (by.end_velocity.size() > 0 && !by.end_velocity.isZero(0.))
      return planToVelocity(config, goal, by, start, cancellation);
    return by.obstacle_trajectories.empty() ? planFromVelocity(config, goal, by, start, cancellation, known)
                                            : planAmongObstacles(config, goal, by, start, cancellation, known);
  };
  MotionPlan plan = plan_with(options);
  const bool accelerates = options.start_acceleration.size() > 0 && !options.start_acceleration.isZero(0.);
  if (accelerates && (plan.status == PlanStatus::no_path_found || plan.status == PlanStatus::no_timing_found)) {
    PlanOptions relaxed = options;
    relaxed.start_acceleration = {};
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
    relaxed.time_limit = options.timeLeft(seconds);
    MotionPlan other = plan_with(relaxed);
    if (other.feasible()) {
      plan = std::move(other);
      plan.warnings.push_back("the motion begins without the start acceleration");
    }
  }
  plan.options = options;
  plan.addSetupStage(std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count());
  return plan;
}

bool areSame(const MotionLimits& a, const MotionLimits& b) {
  return a.velocity == b.velocity && a.acceleration == b.acceleration && a.jerk.size() == b.jerk.size() &&
         (a.jerk.size() == 0 || a.jerk == b.jerk);
}

/// The place s at which a motion stops next, after `time`.
double nextStop(const TimeScaling& scaling, double time, double length) {
  for (const ScalingPhase& phase : scaling.phases())
    if (phase.time > time && phase.begin.speed < 1e-9) return phase.begin.s;
  return length;
}

/// The rest of the curve of a running motion, from its place s at `time`. Its time scaling counts if it `keeps` the
/// limits.
KnownCurves knownCurves(const TimedPath& running, double time, double s, double speed, const MotionLimits& limits,
                        bool keeps, bool has_goal) {
  KnownCurves known;
  const PathCurve& curve = running.curve();
  const double rest = curve.length() - s;
  if (rest <= 1e-9 * curve.length()) return known;
  const auto timed = [&](double to) {
    const CurvePart part = partOf(curve, s, to);
    return KnownCurves::Timed{part.curve, keeps ? part.restOf(running.scaling(), time) : TimeScaling()};
  };
  if (!has_goal) known.to_goal.push_back(timed(curve.length()));
  if (speed == 0.) return known;
  if (keeps) known.to_stop.push_back(timed(nextStop(running.scaling(), time, curve.length())));
  const VectorXd tangent = curve.eval(s, 1).cwiseAbs();
  const double braking = (limits.acceleration.array() / tangent.array().max(1e-12)).minCoeff();
  const double distance = .5 * speed * speed / braking;
  for (const double farther : kCurveFactors)
    known.to_rest.push_back(partOf(curve, s, s + std::min(rest, farther * distance)).curve);
  return known;
}

}  // namespace

MotionPlan planMotion(const Config& config, const MotionGoal& goal, const PlanOptions& options,
                      const std::optional<VectorXd>& start, const CancellationToken& cancellation) {
  if (config.getJointDimension() == 0)
    throw ValueError("planMotion: the configuration has no active joints; expected a robot");
  options.validateFor(config.getJointDimension());
  const VectorXd from = start.value_or(config.getJointState());
  const auto plan_in = [&](const Config& scene) { return planFromState(scene, goal, options, from, cancellation, {}); };
  MotionPlan plan = plan_in(config);
  if (plan.feasible() || plan.status == PlanStatus::timeout || plan.status == PlanStatus::cancelled) return plan;
  plan.blockedByUnseen = findUnseenPlace(config, options.margin, plan_in);
  if (plan.blockedByUnseen)
    plan.message += cat("; without unseen space there is a motion: ", plan.blockedByUnseen->str());
  return plan;
}

MotionPlan MotionPlan::replan(const Config& config, double time, const std::optional<MotionGoal>& goal,
                              const std::optional<PlanOptions>& options_now,
                              const CancellationToken& cancellation) const {
  if (!std::isfinite(time)) throw ValueError("MotionPlan.replan: the time is not finite");
  const MotionState now = eval(time);
  PlanOptions next = options_now.value_or(optionsAt(time));
  const auto isZero = [](const VectorXd& velocity) { return velocity.size() == 0 || velocity.isZero(0.); };
  const bool ends_at_rest = isZero(options.end_velocity) && isZero(next.end_velocity);
  next.start_velocity = now.velocity;
  next.start_acceleration = next.end_velocity = next.end_acceleration = {};
  if (next.jerk.size() > 0 && !now.velocity.isZero(0.)) next.start_acceleration = now.acceleration;
  next.validateFor(config.getJointDimension());
  if (now.q.size() != config.getJointDimension())
    throw ValueError(
        cat("MotionPlan.replan: the motion has ", now.q.size(), " dofs; the scene has ", config.getJointDimension()));
  const TimeScaling& scaling = timed_path.scaling();
  const double clamped = std::clamp(time, 0., scaling.duration());
  const ScalingPhase& phase = scaling.phaseAt(clamped);
  const ScalingState state = phase.at(clamped - phase.time);
  const MotionLimits limits = planLimits(config, next);
  KnownCurves known = knownCurves(timed_path, clamped, std::clamp(state.s, phase.begin.s, phase.end), state.speed,
                                  limits, areSame(limits, planLimits(config, options)), goal.has_value());
  if (!ends_at_rest) known.to_goal.clear(), known.to_stop.clear();
  MotionPlan plan = planFromState(config, goal ? *goal : MotionGoal(VectorXd(path.bottomRows(1).transpose())), next,
                                  now.q, cancellation, known);
  if (!ends_at_rest && plan.feasible())
    plan.warnings.push_back("the motion ends at rest, not with the end velocity of the motion before");
  return plan;
}

}  // namespace kinegraph
