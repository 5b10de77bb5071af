#include "kinegraph/tool_paths/plan_tool_path.h"

#include <algorithm>
#include <cmath>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/trajectories/path_curve.h"
#include "kinegraph/trajectories/time_scaling.h"

namespace kinegraph {

std::string nearestLimitName(NearestLimit::Kind kind) {
  static const char* const names[] = {"velocity", "acceleration", "jerk"};
  return names[int(kind)];
}

NearestLimit nearestLimit(const PathCurve& curve, int piece, const ScalingState& state, const MotionLimits& limits) {
  MatrixXd d(curve.dofs(), 3);
  for (int order = 1; order <= 3; ++order) curve.eval(piece, state.s, order, d.col(order - 1).data());
  const double v = state.speed, a = state.acceleration;
  NearestLimit nearest;
  const auto consider = [&](double value, double limit, NearestLimit::Kind kind, int dof) {
    if (std::abs(value) / limit > nearest.share) nearest = {std::abs(value) / limit, kind, dof};
  };
  for (int j = 0; j < curve.dofs(); ++j) {
    const double first = d(j, 0), second = d(j, 1), third = d(j, 2);
    consider(first * v, limits.velocity[j], NearestLimit::Kind::velocity, j);
    consider(first * a + second * v * v, limits.acceleration[j], NearestLimit::Kind::acceleration, j);
    if (limits.limitsJerk())
      consider(first * state.jerk + 3. * second * v * a + third * v * v * v, limits.jerk[j], NearestLimit::Kind::jerk,
               j);
  }
  return nearest;
}

NearestLimit nearestLimit(const TimedPath& motion, double t, const MotionLimits& limits) {
  limits.validate(motion.dimension());
  if (!motion.feasible()) throw ValueError(cat("nearestLimit: there is no motion: ", motion.message));
  if (std::isnan(t)) throw ValueError("nearestLimit: t is NaN; expected a time in s");
  const TimeScaling& scaling = motion.scaling();
  if (scaling.phases().empty()) return {};
  const double time = std::clamp(t, 0., scaling.duration());
  const ScalingPhase& phase = scaling.phaseAt(time);
  return nearestLimit(motion.curve(), phase.piece, phase.at(time - phase.time), limits);
}

}  // namespace kinegraph
