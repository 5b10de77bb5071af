#include "kinegraph/tool_paths/slow_stretches.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "kinegraph/common/text.h"
#include "kinegraph/planning/steering/joint_space.h"
#include "kinegraph/trajectories/path_curve.h"
#include "kinegraph/trajectories/time_scaling.h"

namespace kinegraph {

namespace {

constexpr double kFullSpeed = .995;
constexpr double kUsed = .97, kFast = .5, kSteady = .2;  // of a limit
constexpr int kSamplesPerPhase = 4;

/// The limits of a timed path, as shares that a motion uses.
class LimitShares {
 public:
  LimitShares(const PathCurve& curve, const MotionLimits& limits, const std::vector<std::string>& names)
      : curve_(curve), limits_(limits), names_(names), d1_(curve.dofs()), d2_(d1_), d3_(d1_) {}

  /// Speed of the last dof.
  double set(int piece, const ScalingState& state) {
    curve_.eval(piece, state.s, 1, d1_.data());
    curve_.eval(piece, state.s, 2, d2_.data());
    curve_.eval(piece, state.s, 3, d3_.data());
    state_ = state;
    return d1_[d1_.size() - 1] * state.speed;
  }

  /// The largest share, and the name of its limit. The speed of the last dof does not count.
  std::pair<double, std::string> largest() const {
    const double v = state_.speed, a = state_.acceleration;
    const Eigen::Index last = d1_.size() - 1;
    double most = 0.;
    std::pair<const char*, Eigen::Index> cause{"acceleration", last};
    const auto consider = [&](double share, const char* what, Eigen::Index dof) {
      if (share > most) most = share, cause = {what, dof};
    };
    for (Eigen::Index j = 0; j <= last; ++j) {
      if (j < last) consider(std::abs(d1_[j] * v) / limits_.velocity[j], "velocity", j);
      consider(std::abs(d1_[j] * a + d2_[j] * v * v) / limits_.acceleration[j], "acceleration", j);
      if (!limits_.limitsJerk()) continue;
      consider(std::abs(d1_[j] * state_.jerk + 3. * d2_[j] * v * a + d3_[j] * v * v * v) / limits_.jerk[j], "jerk", j);
    }
    return {most, cat(cause.first, " of ",
                      cause.second == last ? "the tool" : cat("'", names_[std::size_t(cause.second)], "'"))};
  }

 private:
  const PathCurve& curve_;
  const MotionLimits& limits_;
  const std::vector<std::string>& names_;
  VectorXd d1_, d2_, d3_;
  ScalingState state_;
};

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
                      const KinematicModel& model, std::vector<SlowStretch>& slow) {
  const std::vector<std::string> names = dofNames(model);
  LimitShares shares(timed.curve(), limits, names);
  const double full = kFullSpeed * limits.velocity[limits.velocity.size() - 1];
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
    const double speed = shares.set(piece, state);
    if (speed >= full) return close();
    const double place = state.s - from;
    if (causes.empty()) slow.push_back({path, place, place, speed, ""});
    slow.back().to = place;
    slow.back().speed = std::min(slow.back().speed, speed);
    causes[shares.largest().second] += duration;
  });
  close();
}

double idleShare(const TimedPath& timed, const MotionLimits& limits) {
  const double full = kFullSpeed * limits.velocity[limits.velocity.size() - 1];
  const std::vector<std::string> names(std::size_t(limits.velocity.size()));
  LimitShares shares(timed.curve(), limits, names);
  double idle = 0.;
  const double steady = kSteady * limits.acceleration[limits.acceleration.size() - 1];
  forSamples(timed, [&](int piece, const ScalingState& state, double duration) {
    const double speed = shares.set(piece, state);
    const bool is_slow = speed < full && speed > kFast * full && std::abs(state.acceleration) < steady;
    if (is_slow && shares.largest().first < kUsed) idle += duration;
  });
  return idle / timed.duration();
}

}  // namespace kinegraph
