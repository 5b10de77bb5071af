#include "kinegraph/api/robot_motion.h"

#include <cmath>
#include <limits>
#include <memory>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/kinematics/kinematic_model.h"
#include "kinegraph/kinematics/state.h"
#include "kinegraph/planning/steering/joint_space.h"
#include "kinegraph/scene/dynamics.h"
#include "kinegraph/tool_paths/plan_tool_path.h"
#include "kinegraph/trajectories/motion_curve.h"
#include "kinegraph/trajectories/path_curve.h"
#include "kinegraph/trajectories/time_scaling.h"

namespace kinegraph {

namespace {

constexpr int kSamplesOfPhases = 4;
constexpr double kNoEffortLimit = std::numeric_limits<double>::infinity();

/// Returns the dofs with effort limits.
std::vector<int> actuatedDofs(const VectorXd& efforts) {
  std::vector<int> dofs;
  for (int j = 0; j < efforts.size(); ++j)
    if (efforts[j] < kNoEffortLimit) dofs.push_back(j);
  return dofs;
}

/// Returns the torque constraints along a curve: M q' s'' + (M q'' + C(q, q') q') s'^2 + gravity.
ConstraintSource torqueRows(const Config& config, const PathCurve& curve) {
  const VectorXd efforts = getEffortLimits(config);
  const std::vector<int> dofs = actuatedDofs(efforts);
  if (dofs.empty())
    throw ValueError(
        "retime: torque needs effort limits, but no joint of the scene has one (the second number of "
        "ctrl_limits)");
  ConstraintSource rows;
  rows.unit = " N m";
  rows.high.resize(Eigen::Index(dofs.size()));
  for (std::size_t r = 0; r < dofs.size(); ++r) rows.high[Eigen::Index(r)] = efforts[dofs[r]];
  rows.low = -rows.high;
  const std::vector<std::string> names = config.getJointNames();
  for (const int j : dofs) rows.names.push_back(names[std::size_t(j)]);
  const auto robot = std::make_shared<Config>(config);
  rows.at = [robot, dofs, &curve](double s, int piece) {
    const int n = curve.dofs();
    VectorXd q(n), first(n), second(n);
    curve.eval(piece, s, 0, q.data()), curve.eval(piece, s, 1, first.data()), curve.eval(piece, s, 2, second.data());
    robot->setJointState(q);
    const VectorXd rest = VectorXd::Zero(n), gravity = robot->inverseDynamics(rest, rest);
    const VectorXd a = robot->inverseDynamics(rest, first) - gravity,
                   b = robot->inverseDynamics(first, second) - gravity;
    ScalingConstraints at{VectorXd(dofs.size()), VectorXd(dofs.size()), VectorXd(dofs.size())};
    for (std::size_t r = 0; r < dofs.size(); ++r) {
      const Eigen::Index row = Eigen::Index(r);
      at.a[row] = a[dofs[r]], at.b[row] = b[dofs[r]], at.c[row] = gravity[dofs[r]];
    }
    return at;
  };
  return rows;
}

/// Returns the speed limits of frames along a curve: |J q'|^2 s'^2 <= 1 in units of the limit.
ConstraintSource toolSpeedRows(const Config& config, const PathCurve& curve,
                               const std::map<std::string, double>& speeds) {
  ConstraintSource rows;
  const auto state = std::make_shared<State>(config.state());
  std::vector<std::pair<int, double>> frames;
  for (const auto& [name, speed] : speeds) {
    if (!(speed > 0.)) throw ValueError(cat("retime: tool_speed of '", name, "' is ", speed, "; expected m/s > 0"));
    frames.emplace_back(frameId(state->model(), name, "retime: tool_speed"), speed);
    rows.names.push_back(cat("speed of ", name));
  }
  const Eigen::Index count = Eigen::Index(frames.size());
  rows.low = VectorXd::Constant(count, -1.), rows.high = VectorXd::Ones(count);  // the rows are not negative
  rows.at = [state, frames, count, &curve](double s, int piece) {
    VectorXd q(curve.dofs()), slope(curve.dofs());
    curve.eval(piece, s, 0, q.data()), curve.eval(piece, s, 1, slope.data());
    state->setJoints(q.data());
    Eigen::Matrix<double, 6, Eigen::Dynamic, Eigen::RowMajor> J(6, curve.dofs());
    ScalingConstraints at{VectorXd::Zero(count), VectorXd(count), VectorXd::Zero(count)};
    for (Eigen::Index k = 0; k < count; ++k) {
      const auto& [frame, speed] = frames[std::size_t(k)];
      state->jacobian(frame, state->position(frame), J);
      at.b[k] = (J.topRows(3) * slope).squaredNorm() / (speed * speed);
    }
    return at;
  };
  return rows;
}

/// The rows of both.
ConstraintSource together(const ConstraintSource& first, const ConstraintSource& second) {
  const auto joined = [](const VectorXd& a, const VectorXd& b) {
    VectorXd c(a.size() + b.size());
    c << a, b;
    return c;
  };
  ConstraintSource rows{joined(first.low, second.low), joined(first.high, second.high), {}, first.names, first.unit};
  rows.names.insert(rows.names.end(), second.names.begin(), second.names.end());
  rows.at = [joined, first = first.at, second = second.at](double s, int piece) {
    const ScalingConstraints a = first(s, piece), b = second(s, piece);
    return ScalingConstraints{joined(a.a, b.a), joined(a.b, b.b), joined(a.c, b.c)};
  };
  return rows;
}

/// The limits with those of the model; throws for a motion of other dofs.
MotionLimits completeLimits(const char* call, const Config& config, Eigen::Index dofs, const RobotLimits& limits) {
  const int n = config.getJointDimension();
  if (dofs != n)
    throw ValueError(
        cat(call, ": the path has ", dofs, " dofs; the scene has ", n, ": ", join(config.getJointNames())));
  MotionLimits motion = limits.motion;
  if (motion.velocity.size() == 0) motion.velocity = getVelocityLimits(config);
  if (motion.acceleration.size() == 0) {
    if (!limits.torque)
      throw ValueError(cat(call, ": acceleration is missing; expected a number per dof or one for all, or torque"));
    motion.acceleration = VectorXd::Constant(n, kNoEffortLimit);
  }
  return motion;
}

/// The torques, then the speeds of frames; empty without both.
ConstraintSource constraintsAlong(const Config& config, const PathCurve& curve, const RobotLimits& limits) {
  if (limits.tool_speed.empty()) return limits.torque ? torqueRows(config, curve) : ConstraintSource();
  const ConstraintSource speeds = toolSpeedRows(config, curve, limits.tool_speed);
  return limits.torque ? together(torqueRows(config, curve), speeds) : speeds;
}

/// Finds the nearest limit at states of a motion.
class NearestCause {
 public:
  NearestCause(const Config& config, const TimedPath& motion, const RobotLimits& limits)
      : curve_(motion.curve()),
        limits_(completeLimits("activeLimits", config, motion.dimension(), limits)),
        rows_(constraintsAlong(config, curve_, limits)),
        joints_(dofNames(*config.model())),
        torques_(rows_.names.size() - limits.tool_speed.size()) {
    limits_.validate(motion.dimension());
    for (std::size_t k = 0; k < torques_; ++k) row_names_.push_back(cat("torque of '", rows_.names[k], "'"));
    for (const auto& [frame, speed] : limits.tool_speed) row_names_.push_back(cat("speed of '", frame, "'"));
  }

  ActiveLimit at(int piece, const ScalingState& state) const {
    const NearestLimit nearest = nearestLimit(curve_, piece, state, limits_);
    ActiveLimit active;
    active.share = nearest.share;
    if (nearest.dof >= 0)
      active.cause = cat(nearestLimitName(nearest.kind), " of '", joints_[std::size_t(nearest.dof)], "'");
    if (!rows_) return active;
    const ScalingConstraints row = rows_.at(state.s, piece);
    const VectorXd value = row.a * state.acceleration + row.b * state.speed * state.speed + row.c;
    for (Eigen::Index k = 0; k < value.size(); ++k) {
      const double used = value[k] / (value[k] > 0. ? rows_.high[k] : rows_.low[k]);
      const bool is_speed = std::size_t(k) >= torques_;  // the row is the square of a speed
      const double share = is_speed ? std::sqrt(used) : used;
      if (state.speed > 0. && share > active.share) active.share = share, active.cause = row_names_[std::size_t(k)];
    }
    return active;
  }

 private:
  const PathCurve& curve_;
  MotionLimits limits_;
  const ConstraintSource rows_;
  const std::vector<std::string> joints_;
  const std::size_t torques_;  ///< number of rows before those of speeds
  std::vector<std::string> row_names_;
};

}  // namespace

TimedPath retime(const Config& config, const MatrixXd& path, const RobotLimits& limits, const RetimeOptions& options) {
  const MotionLimits motion = completeLimits("retime", config, path.cols(), limits);
  if (!limits.torque && limits.tool_speed.empty()) return retime(path, motion, options);
  return retime(path, motion, options, [&](const PathCurve& curve) { return constraintsAlong(config, curve, limits); });
}

TimedPath retime(const Config& config, const Trajectory& motion, const RobotLimits& limits,
                 const RetimeOptions& options) {
  const MotionLimits complete = completeLimits("retime", config, motion.dimension(), limits);
  const PathCurve curve = curveOf(motion, options.cancellation);
  MatrixXd points(Eigen::Index(curve.marks().size()), curve.dofs());
  for (Eigen::Index k = 0; k < points.rows(); ++k)
    points.row(k) = curve.eval(curve.marks()[std::size_t(k)]).transpose();
  RetimeOptions constrained = options;
  constrained.constraints = constraintsAlong(config, curve, limits);
  return retime(points, curve, complete, constrained);
}

std::vector<ActiveLimit> activeLimits(const Config& config, const TimedPath& motion, const RobotLimits& limits) {
  if (!motion.feasible()) throw ValueError(cat("activeLimits: there is no motion: ", motion.message));
  const NearestCause causes(config, motion, limits);
  const std::vector<ScalingPhase>& phases = motion.scaling().phases();
  std::vector<ActiveLimit> all;
  for (std::size_t i = 0; i < phases.size(); ++i) {
    const double end = i + 1 < phases.size() ? phases[i + 1].time : motion.duration();
    const double step = (end - phases[i].time) / kSamplesOfPhases;
    for (int k = 0; k < kSamplesOfPhases && step > 0.; ++k) {
      ActiveLimit active = causes.at(phases[i].piece, phases[i].at((k + .5) * step));
      if (active.cause.empty()) continue;
      active.from = phases[i].time + k * step, active.to = active.from + step;
      const bool continues = !all.empty() && all.back().cause == active.cause && active.from <= all.back().to + step;
      if (!continues) all.push_back(active);
      all.back().to = active.to, all.back().share = std::max(all.back().share, active.share);
    }
  }
  return all;
}

}  // namespace kinegraph
