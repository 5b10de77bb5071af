#include "kinegraph/motion/plan_motion.h"

#include <cmath>

#include "kinegraph/motion/plan_among_moving.h"
#include "kinegraph/motion/plan_in_motion.h"
#include "kinegraph/motion/plan_timing.h"
#include "kinegraph/spline/curve_part.h"

namespace kinegraph {

namespace {

/// How far along its curve it may come to rest, as multiples of a guess.
constexpr double kCurveFactors[] = {1.05, 1.5, 2.5, 4.};

MotionPlan planWith(const Config& config, const MotionGoal& goal, const PlanOptions& options, const VectorXd& start,
                    const MotionWatch& watch, const KnownCurves& known) {
  MotionPlan plan = options.moving.empty() ? planInMotion(config, goal, options, start, watch, known)
                                           : planAmongMoving(config, goal, options, start, watch, known);
  plan.options = options;
  return plan;
}

/// Along the curve of a running motion, from s on.
KnownCurves knownCurves(const TimedPath& running, double s, double speed, const MotionLimits& limits, bool has_goal) {
  KnownCurves known;
  const PathCurve& curve = running.curve();
  const double rest = curve.length() - s;
  if (rest <= 1e-9 * curve.length()) return known;
  if (!has_goal) known.to_goal.push_back(partOf(curve, s, curve.length()).curve);
  if (speed == 0.) return known;
  const VectorXd tangent = curve.eval(s, 1).cwiseAbs();
  const double braking = (limits.acceleration.array() / tangent.array().max(1e-12)).minCoeff();
  const double distance = .5 * speed * speed / braking;
  for (const double farther : kCurveFactors)
    known.to_rest.push_back(partOf(curve, s, s + std::min(rest, farther * distance)).curve);
  return known;
}

}  // namespace

MotionPlan planMotion(const Config& config, const MotionGoal& goal, const PlanOptions& options,
                      const std::optional<VectorXd>& start, const MotionWatch& watch) {
  options.validateFor(config.getJointDimension());
  return planWith(config, goal, options, start.value_or(config.getJointState()), watch, {});
}

MotionPlan replanMotion(const Config& config, const MotionPlan& running, double time,
                        const std::optional<MotionGoal>& goal, const std::optional<PlanOptions>& given,
                        const MotionWatch& watch) {
  if (!std::isfinite(time)) throw ValueError("replan: the time is not finite");
  const MotionState now = running.at(time);
  PlanOptions options = given.value_or(running.optionsAt(time));
  options.start_velocity = now.velocity;
  options.validateFor(config.getJointDimension());
  if (now.q.size() != config.getJointDimension())
    throw ValueError(
        cat("replan: the running motion has ", now.q.size(), " dofs; the scene has ", config.getJointDimension()));
  const TimeLaw& law = running.timed.law();
  const double held = std::clamp(time, 0., law.duration());
  const LawPhase& phase = law.phaseAt(held);
  const LawState state = phase.at(held - phase.time);
  const KnownCurves known = knownCurves(running.timed, std::clamp(state.s, phase.begin.s, phase.end), state.speed,
                                        planLimits(config, options), goal.has_value());
  return planWith(config, goal ? *goal : MotionGoal(VectorXd(running.path.bottomRows(1).transpose())), options, now.q,
                  watch, known);
}

}  // namespace kinegraph
