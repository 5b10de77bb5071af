#include "kinegraph/planning/plan_motion.h"

#include <chrono>
#include <cmath>

#include "kinegraph/planning/plan_among_obstacles.h"
#include "kinegraph/planning/plan_from_velocity.h"
#include "kinegraph/planning/plan_timing.h"
#include "kinegraph/trajectories/curve_part.h"

namespace kinegraph {

namespace {

/// How far along its curve it may come to rest, as multiples of a guess.
constexpr double kCurveFactors[] = {1.05, 1.5, 2.5, 4.};

/// From a start acceleration, or without it where nothing can be timed so, and then a note says it.
MotionPlan planWith(const Config& config, const MotionGoal& goal, const PlanOptions& options, const VectorXd& start,
                    const CancellationToken& cancellation, const KnownCurves& known) {
  const auto began = std::chrono::steady_clock::now();
  const auto plan_by = [&](const PlanOptions& by) {
    return by.obstacle_trajectories.empty() ? planFromVelocity(config, goal, by, start, cancellation, known)
                                            : planAmongObstacles(config, goal, by, start, cancellation, known);
  };
  MotionPlan plan = plan_by(options);
  const bool accelerates = options.start_acceleration.size() > 0 && !options.start_acceleration.isZero(0.);
  if (accelerates && (plan.status == PlanStatus::no_path_found || plan.status == PlanStatus::no_timing_found)) {
    PlanOptions without = options;
    without.start_acceleration = {};
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
    without.time_limit = options.timeLeft(seconds);
    MotionPlan other = plan_by(without);
    if (other.feasible()) {
      plan = std::move(other);
      plan.warnings.push_back("the motion begins without the start acceleration");
    }
  }
  plan.options = options;
  return plan;
}

bool areSame(const MotionLimits& a, const MotionLimits& b) {
  return a.velocity == b.velocity && a.acceleration == b.acceleration && a.jerk.size() == b.jerk.size() &&
         (a.jerk.size() == 0 || a.jerk == b.jerk);
}

/// Where a motion stands still next, after `time`.
double nextStop(const TimeScaling& scaling, double time, double length) {
  for (const ScalingPhase& phase : scaling.phases())
    if (phase.time > time && phase.begin.speed < 1e-9) return phase.begin.s;
  return length;
}

/// Along the curve of a running motion, where it is at `time`, from s on. Its law is of use where it `keeps` the limits.
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
  options.validateFor(config.getJointDimension());
  return planWith(config, goal, options, start.value_or(config.getJointState()), cancellation, {});
}

MotionPlan MotionPlan::replan(const Config& config, double time, const std::optional<MotionGoal>& goal,
                              const std::optional<PlanOptions>& given, const CancellationToken& cancellation) const {
  if (!std::isfinite(time)) throw ValueError("replan: the time is not finite");
  const MotionState now = at(time);
  PlanOptions next = given.value_or(optionsAt(time));
  next.start_velocity = now.velocity;
  next.start_acceleration = {};
  if (next.jerk.size() > 0 && !now.velocity.isZero(0.)) next.start_acceleration = now.acceleration;
  next.validateFor(config.getJointDimension());
  if (now.q.size() != config.getJointDimension())
    throw ValueError(
        cat("replan: the running motion has ", now.q.size(), " dofs; the scene has ", config.getJointDimension()));
  const TimeScaling& scaling = timed.scaling();
  const double held = std::clamp(time, 0., scaling.duration());
  const ScalingPhase& phase = scaling.phaseAt(held);
  const ScalingState state = phase.at(held - phase.time);
  const MotionLimits limits = planLimits(config, next);
  const KnownCurves known = knownCurves(timed, held, std::clamp(state.s, phase.begin.s, phase.end), state.speed, limits,
                                        areSame(limits, planLimits(config, options)), goal.has_value());
  return planWith(config, goal ? *goal : MotionGoal(VectorXd(path.bottomRows(1).transpose())), next, now.q,
                  cancellation, known);
}

}  // namespace kinegraph
