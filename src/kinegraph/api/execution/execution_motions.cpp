#include "kinegraph/api/execution/execution_motions.h"

#include <algorithm>

#include "kinegraph/api/execution/task_execution.h"
#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/task_planning/motions/motion_checks.h"
#include "kinegraph/task_planning/open_hands.h"
#include "kinegraph/task_planning/task_doors.h"
#include "kinegraph/task_planning/task_tools.h"

namespace kinegraph::inline api_internal {

namespace {

constexpr double kBlocked = .5;     ///< rad or m: of a robot that was stopped, to its path
constexpr double kSlowdown = 3.;    ///< factor on the time of a motion for its reversal
constexpr double kStart = .3;       ///< s to the first row
constexpr double kMargin = 5e-3;    ///< m: of the motion to the start of a plan
constexpr double kInContact = .02;  ///< m: depth of contacts that it resolves

}  // namespace

VectorXd effortLimits(const ExecutionOptions& options, Eigen::Index n) {
  const VectorXd& limits = options.max_external_effort;
  if (options.repairs < 0)
    throw ValueError(cat("TaskPlan.execute: repairs is ", options.repairs, "; expected 0 or more"));
  if (limits.size() > 1 && limits.size() != n)
    throw ValueError(
        cat("TaskPlan.execute: max_external_effort has ", limits.size(), " numbers; expected one, or ", n));
  if (limits.size() > 0 && !(limits.minCoeff() > 0.))
    throw ValueError("TaskPlan.execute: max_external_effort has a number that is not above 0");
  return limits.size() == 1 ? VectorXd(VectorXd::Constant(n, limits[0])) : limits;
}

bool isClear(Config& C, const VectorXd& q) {
  C.setJointState(q);
  return C.getCollisions(-kOverlap).empty();
}

std::optional<Retreat> retreatAlong(const TaskPlan& plan, const RowRange& rows, const ObservedWorld& world,
                                    const VectorXd& q,
                                    const std::function<bool(Eigen::Index row, const VectorXd& q)>& is_end) {
  MatrixXd path = plan.path.middleRows(rows.begin, rows.size());
  const VectorXd times = plan.times.segment(rows.begin, rows.size());
  for (const auto& [door, dof] : world.doors()) path.col(dof).setConstant(q[dof]);
  Eigen::Index at = 0;  // the row that is nearest to the robot
  for (Eigen::Index row = 1; row < path.rows(); ++row)
    if (world.jointErrors(path.row(row)).maxCoeff() <= world.jointErrors(path.row(at)).maxCoeff()) at = row;
  if (world.jointErrors(path.row(at)).maxCoeff() > kBlocked) return std::nullopt;
  Eigen::Index end = at;
  while (end >= 0 && !is_end(end, path.row(end))) --end;
  if (end < 0) return std::nullopt;
  const Eigen::Index count = std::max<Eigen::Index>(at - end, 1);
  return Retreat{path.middleRows(end, count).colwise().reverse(),
                 (kSlowdown * (times[at] - times.segment(end, count).array()) + kStart).reverse()};
}

std::optional<Retreat> retreatToOpen(const TaskPlan& plan, std::size_t action, const ObservedWorld& world,
                                     const VectorXd& q, const std::string& hand, double width) {
  Config C = world.scene();
  if (opensFreely(C, hand, width) || action == 0 || isGuided(plan.actions[action - 1])) return std::nullopt;
  const auto is_end = [&](Eigen::Index, const VectorXd& row) { return isClear(C, row) && opensFreely(C, hand, width); };
  const RowRange rows{plan.segments[action - 1].begin, plan.segments[action].end};
  std::optional<Retreat> back = retreatAlong(plan, rows, world, q, is_end);
  bool was_clear = false;
  for (Eigen::Index row = 0; back && row < back->path.rows(); ++row) {
    const bool clear = isClear(C, back->path.row(row));
    if (was_clear && !clear) return std::nullopt;  // something is in the way
    was_clear = clear;
  }
  return back;
}

MotionPlan motionToStart(const TaskPlan& plan, Config C, const VectorXd& start) {
  ignorePairs(C, wedgedPairs(C, wordsOf(plan.start, "is_gripper"), wordsOf(plan.start, "is_object"), kOverlap));
  PlanOptions options;
  options.margin = kMargin;
  options.max_start_penetration = kInContact;
  if (plan.limits.rows() == 2) {
    options.velocity = plan.limits.row(0).transpose();
    options.acceleration = plan.limits.row(1).transpose();
  }
  MotionPlan motion = planMotion(C, start, options);
  if (motion.feasible()) return motion;
  options.margin = 0.;
  return planMotion(C, start, options);
}

}  // namespace kinegraph::inline api_internal
