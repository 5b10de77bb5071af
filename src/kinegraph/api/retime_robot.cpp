#include "kinegraph/api/robot_motion.h"

#include <limits>
#include <memory>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/kinematics/kinematic_model.h"
#include "kinegraph/kinematics/state.h"
#include "kinegraph/scene/dynamics.h"
#include "kinegraph/trajectories/path_curve.h"

namespace kinegraph {

namespace {

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

}  // namespace

TimedPath retime(const Config& config, const MatrixXd& path, const RobotLimits& limits, const RetimeOptions& options) {
  const int n = config.getJointDimension();
  if (path.cols() != n)
    throw ValueError(
        cat("retime: the path has ", path.cols(), " dofs; the scene has ", n, ": ", join(config.getJointNames())));
  MotionLimits motion = limits.motion;
  if (motion.velocity.size() == 0) motion.velocity = getVelocityLimits(config);
  if (motion.acceleration.size() == 0) {
    if (!limits.torque)
      throw ValueError("retime: acceleration is missing; expected a number per dof or one for all, or torque");
    motion.acceleration = VectorXd::Constant(n, kNoEffortLimit);
  }
  if (!limits.torque && limits.tool_speed.empty()) return retime(path, motion, options);
  return retime(path, motion, options, [&](const PathCurve& curve) {
    if (limits.tool_speed.empty()) return torqueRows(config, curve);
    const ConstraintSource speeds = toolSpeedRows(config, curve, limits.tool_speed);
    return limits.torque ? together(torqueRows(config, curve), speeds) : speeds;
  });
}

}  // namespace kinegraph
