#include "kinegraph/tool_paths/slow_stretches.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "kinegraph/common/text.h"
#include "kinegraph/planning/steering/joint_space.h"
#include "kinegraph/tool_paths/plan_tool_path.h"
#include "kinegraph/trajectories/path_curve.h"
#include "kinegraph/trajectories/time_scaling.h"

namespace kinegraph::inline tool_paths_internal {

namespace {

constexpr double kFullSpeed = .995;
constexpr double kUsed = .97, kFast = .5, kSteady = .2;  // of a limit
constexpr int kSamplesPerPhase = 4;

/// Speed of the last dof.
double toolSpeed(const PathCurve& curve, int piece, const ScalingState& state) {
  VectorXd slope(curve.dofs());
  curve.eval(piece, state.s, 1, slope.data());
  return slope[slope.size() - 1] * state.speed;
}

/// The limits without the speed of the tool, the last dof: the others are causes of a lower speed.
MotionLimits causesOf(MotionLimits limits) {
  limits.velocity[limits.velocity.size() - 1] = std::numeric_limits<double>::infinity();
  return limits;
}

/// Calls visit(piece, state, duration) for samples of a time scaling.
template <class Visit>
void forSamples(const TimedPath& timed, const Visit& visit) {
  const std::vector<ScalingPhase>& phases = timed.scaling().phases();
  for (std::size_t i = 0; i < phases.size(); ++i) {
    const double duration = (i + 1 < phases.size() ? phases[i + 1].time : timed.duration()) - phases[i].time;
    for (int k = 0; k < kSamplesPerPhase; ++k)
      visit(phases[i].piece, phases[i].at(duration * (k + .5) / kSamplesPerPhase), duration / kSamplesPerPhase);
  }
}

}  // namespace

void addSlowStretches(const TimedPath& timed, int path, double from, double to, const MotionLimits& limits,
                      const KinematicModel& model, const std::function<double(double)>& speed_of,
                      std::vector<SlowStretch>& slow) {
  const std::vector<std::string> names = dofNames(model);
  const int last = timed.curve().dofs() - 1;
  const MotionLimits others = causesOf(limits);
  std::map<std::string, double> causes;  // time for which each limit is the nearest, in the open stretch
  const auto close = [&] {
    if (causes.empty()) return;
    const auto most = std::max_element(causes.begin(), causes.end(),
                                       [](const auto& a, const auto& b) { return a.second < b.second; });
    slow.back().cause = most->first;
    causes.clear();
  };
  forSamples(timed, [&](int piece, const ScalingState& state, double duration) {
    if (state.s < from || state.s > to) return;
    const double speed = toolSpeed(timed.curve(), piece, state);
    if (speed >= kFullSpeed * speed_of(state.s)) return close();
    const double place = state.s - from;
    if (causes.empty()) slow.push_back({path, place, place, speed, ""});
    slow.back().to = place;
    slow.back().speed = std::min(slow.back().speed, speed);
    const NearestLimit cause = nearestLimit(timed.curve(), piece, state, others);
    const bool is_tool = cause.dof < 0 || cause.dof == last;
    causes[cat(nearestLimitName(cause.kind), " of ",
               is_tool ? "the tool" : cat("'", names[std::size_t(cause.dof)], "'"))] += duration;
  });
  close();
}

double idleShare(const TimedPath& timed, const MotionLimits& limits, const std::function<double(double)>& speed_of) {
  const MotionLimits others = causesOf(limits);
  double idle = 0.;
  const double steady = kSteady * limits.acceleration[limits.acceleration.size() - 1];
  forSamples(timed, [&](int piece, const ScalingState& state, double duration) {
    const double speed = toolSpeed(timed.curve(), piece, state), full = kFullSpeed * speed_of(state.s);
    const bool is_slow = speed < full && speed > kFast * full && std::abs(state.acceleration) < steady;
    if (is_slow && nearestLimit(timed.curve(), piece, state, others).share < kUsed) idle += duration;
  });
  return idle / timed.duration();
}

}  // namespace kinegraph::inline tool_paths_internal
