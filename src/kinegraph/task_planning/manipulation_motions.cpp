#include <cmath>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/komo/mode_switches.h"
#include "kinegraph/task_planning/manipulation_helper.h"

// Pushes, and straight motions of the hand.
namespace kinegraph {

namespace {

using F = FeatureSymbol;
using O = ObjectiveType;

constexpr double kDepth = .025;  ///< m: depth of a gripper's marker inside of a pushed object

/// Formats a number like Python: 1.0
std::string number(double value) { return std::floor(value) == value ? cat(value, ".0") : cat(value); }

std::pair<double, double> fromTo(const std::vector<double>& times, const char* call) {
  if (times.size() == 2 && times[0] < times[1]) return {times[0], times[1]};
  throw ValueError(cat("ManipulationHelper.", call, ": times are [from, to] in phases, the first one less"));
}

MatrixXd row(double x, double y, double z) { return Eigen::RowVector3d(x, y, z); }

}  // namespace

std::string ManipulationHelper::straight_push(const std::vector<double>& times, const std::string& obj,
                                              const std::string& gripper, const std::string& table, double scale,
                                              std::string helper) {
  Komo& k = problem("straight_push");
  const auto [from, to] = fromTo(times, "straight_push");
  if (helper.empty()) helper = cat("_straight_pushStart_", gripper, "_", obj, "_", number(from));
  if (!table.empty()) frame(table);  // throws if it does not exist
  if (!hasFrame(helper)) add_stable_frame(JointType::hingeZ, obj, helper);
  k.addObjective({to}, F::AlignYWithDiff, {helper, obj}, O::eq, 1., {}, 1);
  k.addObjective({from}, F::distance, {gripper, obj}, O::eq, scale, -kDepth);
  MatrixXd beside(2, 3);
  beside << row(scale, 0., 0.), row(0., 0., scale);
  k.addObjective({from}, F::positionRel, {gripper, helper}, O::eq, beside);
  k.addObjective({from}, F::positionRel, {gripper, helper}, O::ineq, row(0., scale, 0.), {0., -.02, 0.});
  k.addObjective({from}, F::scalarProductYY, {gripper, helper}, O::ineq, -1., .2);
  k.addObjective({from}, F::scalarProductYZ, {gripper, helper}, O::ineq, -1., .2);
  k.addObjective({from}, F::vectorXDiff, {gripper, helper}, O::eq, 1.);
  k.addObjective({to}, F::poseRel, {gripper, obj}, O::eq, 1e1, {}, 1);
  return helper;
}

void ManipulationHelper::pull(const std::vector<double>& times, const std::string& obj, const std::string& gripper,
                              const std::string& table) {
  Komo& k = problem("pull");
  const auto [from, to] = fromTo(times, "pull");
  std::string end = "_pull_end";
  if (hasFrame(end)) end = cat(end, "_", gripper, "_", obj, "_", number(to));
  add_stable_frame(JointType::transXYPhi, table, end, obj);
  MatrixXd above(2, 3);
  above << row(1e1, 0., 0.), row(0., 1e1, 0.);
  for (const std::string& upright : {gripper, obj}) {
    for (double time : {from, to}) k.addObjective({time}, F::vectorZ, {upright}, O::eq, 1e1, {0., 0., 1.});
  }
  k.addObjective({to}, F::positionDiff, {obj, end}, O::eq, 1e1);
  k.addObjective({from}, F::positionRel, {gripper, obj}, O::eq, above, {0., 0., 0.});
  k.addObjective({from}, F::distance, {gripper, obj}, O::eq, 1e1, -.005);
}

/// Adds a static frame at the pose of the gripper in the path at a time.
void ManipulationHelper::addReference(const std::string& name, const std::string& gripper, double time) {
  const Path& path = komo->path();
  const Pose X_WG(path.state(path.grid().sliceAt(time)).pose(frameId(path.state(0).model(), gripper, "gripper")));
  addFrameDof(komo->path(),
              {.name = name, .type = JointType::none, .stable = true, .origin = gripper, .origin_pose = X_WG});
}

void ManipulationHelper::moveAlongZ(const std::vector<double>& times, const std::string& gripper, double dist,
                                    bool leave) {
  const char* call = leave ? "retract" : "approach";
  Komo& k = problem(call);
  const auto [from, to] = fromTo(times, call);
  const std::string held = cat("_", gripper, "_", call, "_", number(leave ? from : to));
  addReference(held, gripper, leave ? from : to);
  k.addObjective(times, F::positionRel, {gripper, held}, O::eq, row(1e2, 0., 0.));
  k.addObjective(times, F::quaternionDiff, {gripper, held}, O::eq, 1e2);
  k.addObjective({leave ? to : from}, F::positionRel, {gripper, held}, O::ineq, row(-0., -0., -1e2), {0., 0., dist});
}

void ManipulationHelper::moveAlongPush(const std::vector<double>& times, const std::string& gripper, double dist,
                                       bool leave) {
  const char* call = leave ? "retractPush" : "approachPush";
  Komo& k = problem(call);
  const auto [from, to] = fromTo(times, call);
  const std::string held = cat("_", gripper, "_", call, "_", number(leave ? from : to));
  addReference(held, gripper, leave ? from : to);
  const double at = leave ? to : from;
  k.addObjective(times, F::positionRel, {gripper, held}, O::eq, row(1e2, 0., 0.));
  k.addObjective({at}, F::positionRel, {gripper, held}, O::ineq, row(0., 1e2, 0.), {0., -dist, 0.});
  k.addObjective({at}, F::positionRel, {gripper, held}, O::ineq, row(0., 0., -1e2), {0., 0., dist});
}

void ManipulationHelper::retract(const std::vector<double>& times, const std::string& gripper, double dist) {
  moveAlongZ(times, gripper, dist, true);
}

void ManipulationHelper::approach(const std::vector<double>& times, const std::string& gripper, double dist) {
  moveAlongZ(times, gripper, dist, false);
}

void ManipulationHelper::retractPush(const std::vector<double>& times, const std::string& gripper, double dist) {
  moveAlongPush(times, gripper, dist, true);
}

void ManipulationHelper::approachPush(const std::vector<double>& times, const std::string& gripper, double dist) {
  moveAlongPush(times, gripper, dist, false);
}

}  // namespace kinegraph
