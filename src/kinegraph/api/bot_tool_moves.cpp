// The motions of a BotOp along curves of a tool. They need the planner, which is a room above BotOp.
#include "kinegraph/common/text.h"
#include "kinegraph/planning/plan_timing.h"
#include "kinegraph/robot/bot_op.h"
#include "kinegraph/robot/robot_loop.h"
#include "kinegraph/tool_paths/plan_tool_path.h"

namespace kinegraph {

namespace {

/// The limits of the options, or else of the scene, within those of the robot.
void limitBy(const RobotInfo& robot, const Config& scene, ToolPathOptions& options) {
  PlanOptions asked;
  asked.velocity = options.velocity, asked.acceleration = options.acceleration;
  const MotionLimits limits = planLimits(scene, asked);
  options.velocity = limits.velocity.cwiseMin(robot.velocity);
  options.acceleration = limits.acceleration.cwiseMin(robot.acceleration);
}

}  // namespace

ToolPathPlan BotOp::moveAlong(const char* call, const ToolPath& path, ToolPathOptions options, bool overwrite) {
  Config scene;
  {
    const Lock lock(mutex_);
    loop_->requireReady(call, {});
    options.validate(int(home_.size()));
    const double now = loop_->time();
    if (overwrite) {
      holdIfBlocked();
      if (timeToEnd() > 0.) loop_->apply(FollowSpline{loop_->stoppingSegment(now, loop_->reference(now))});
    }
    SimulatedWorld* world = loop_->driver().world();
    scene = world ? world->config() : model_;
    if (scene.getJointDimension() != int(home_.size()))
      throw ValueError(cat(call, ": the world has ", scene.getJointDimension(), " dofs; the robot has ", home_.size(),
                           ". A world with other active joints is planned with planToolPath, then follow"));
    scene.setJointState(loop_->reference(nextStart()).row(0).transpose());
    limitBy(loop_->info(), scene, options);
  }
  // The plan begins at rest where the present motion ends.
  const VectorXd from = scene.getJointState();
  options.start.reset(), options.transfer_from.reset();
  (path.first() || options.approach > 0. ? options.transfer_from : options.start) = from;
  ToolPathPlan plan = planToolPath(scene, {path}, options, options_.cancellation);
  if (plan.feasible()) follow(plan);
  return plan;
}

ToolPathPlan BotOp::moveLinear(const std::string& frame, const ToolWaypoint& target, const ToolPathOptions& options,
                               bool overwrite) {
  return moveAlong("BotOp::moveLinear", ToolPath(frame).line(target), options, overwrite);
}

ToolPathPlan BotOp::moveCircular(const std::string& frame, const Vector3d& via, const ToolWaypoint& target,
                                 const ToolPathOptions& options, bool overwrite) {
  return moveAlong("BotOp::moveCircular", ToolPath(frame).arc(via, target), options, overwrite);
}

ToolPathPlan BotOp::moveSequence(const std::string& frame, const std::vector<ToolWaypoint>& targets, double blend,
                                 const ToolPathOptions& options, bool overwrite) {
  if (targets.empty()) throw ValueError("BotOp::moveSequence: there are no targets; expected at least one pose");
  ToolPath path(frame);
  for (std::size_t k = 0; k < targets.size(); ++k) path.line(targets[k], k > 0 ? blend : 0.);
  return moveAlong("BotOp::moveSequence", path, options, overwrite);
}

ToolPathPlan BotOp::moveSequence(const ToolPath& path, const ToolPathOptions& options, bool overwrite) {
  return moveAlong("BotOp::moveSequence", path, options, overwrite);
}

}  // namespace kinegraph
