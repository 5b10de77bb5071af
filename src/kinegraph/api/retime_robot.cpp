#include "kinegraph/api/retime_robot.h"

#include <limits>
#include <memory>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/scene/motor_limits.h"
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
  if (!limits.torque) return retime(path, motion, options);
  return retime(path, motion, options, [&](const PathCurve& curve) { return torqueRows(config, curve); });
}

}  // namespace kinegraph
