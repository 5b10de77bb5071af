#include "kinegraph/task_planning/manipulation_helper.h"

#include <array>
#include <map>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/log.h"
#include "kinegraph/common/text.h"
#include "kinegraph/geometry/shapes/shape_kinds.h"
#include "kinegraph/komo/mode_switches.h"
#include "kinegraph/komo/path/sub_problem.h"
#include "kinegraph/solvers/nlp_solver.h"
#include "kinegraph/task_planning/shape_points.h"
#include "kinegraph/task_planning/task_tools.h"

namespace kinegraph {

namespace {

using F = FeatureSymbol;
using O = ObjectiveType;

constexpr double kAlign = .2, kKeepOff = .3;  ///< phases before a grasp
constexpr int kMotionSlices = 50;

/// Rows of a scaled unit matrix, a scale that selects these coordinates.
template <class... Axis>
MatrixXd only(double scale, Axis... axes) {
  MatrixXd rows = MatrixXd::Zero(int(sizeof...(axes)), 3);
  int row = 0;
  ((rows(row++, axes) = scale), ...);
  return rows;
}

F product(int a, int b) {
  static constexpr F kProducts[3][3] = {{F::scalarProductXX, F::scalarProductXY, F::scalarProductXZ},
                                        {F::scalarProductYX, F::scalarProductYY, F::scalarProductYZ},
                                        {F::scalarProductZX, F::scalarProductZY, F::scalarProductZZ}};
  return kProducts[a][b];
}

/// The distance from the origin of an upright object down to its lowest point, m.
double depthOf(const Frame& obj) {
  constexpr double kRounding = 1e-6;  // m
  const bool has_height = shapeKind(obj.getShapeType()).extent;
  double depth = has_height ? .5 * height(obj) : 0.;
  bool is_first = !has_height;
  for (const Frame& part : shapesOf(obj)) {
    if (!part.data().shape->contact && !(part == obj)) continue;
    const RigidTransform X = part.getPose(obj).transform();
    for (const Vector3d& point : shapePoints(part)) {
      const double below = -Vector3d(X * point).z();
      if (is_first || below > depth + kRounding) depth = below;
      is_first = false;
    }
  }
  return depth;
}

F axis(int which) { return std::array{F::vectorX, F::vectorY, F::vectorZ}[std::size_t(which)]; }

int axisOf(const std::string& direction, const char* call, const char* argument) {
  const std::size_t found = std::string("xyz").find(direction);
  if (direction.size() == 1 && found != std::string::npos) return int(found);
  throw ValueError(cat("ManipulationHelper.", call, ": ", argument, " is '", direction, "'; expected x, y or z"));
}

}  // namespace

std::shared_ptr<Komo> ManipulationHelper::newKomo(const Config& C, double phases, int slices, int order) const {
  return std::make_shared<Komo>(C, phases, slices, order);
}

Komo& ManipulationHelper::problem(const char* call) const {
  if (!komo) throw Error(cat("ManipulationHelper.", call, ": there is no problem yet; call one of the setups first"));
  return *komo;
}

Frame ManipulationHelper::frame(const std::string& name) const {
  return komo->path().modes().empty() ? komo->configuration(-komo->order()).getFrame(name)
                                      : komo->path().mode(-komo->order()).config.getFrame(name);
}

bool ManipulationHelper::hasFrame(const std::string& name) const {
  try {
    frame(name);
    return true;
  } catch (const FrameNotFound&) {
    return false;
  }
}

VectorXd ManipulationHelper::boxSize(const std::string& name, const char* call) const {
  const std::vector<double> size = frame(name).getSize();
  using Body = ShapeKind::Body;
  const Body body = shapeKind(frame(name).getShapeType()).body;
  if (body == Body::box) return Eigen::Map<const VectorXd>(size.data(), 3);
  // The bounding box of cylinders and capsules without their caps.
  if (body == Body::cylinder || body == Body::capsule) return Vector3d(2. * size[1], 2. * size[1], size[0]);
  throw ValueError(cat("ManipulationHelper.", call, ": frame '", name,
                       "' has no box, cylinder or capsule; give it one with setShape"));
}

void ManipulationHelper::setup(const Config& C, double phases, int slices, int order) {
  komo = newKomo(C, phases, slices, order);
  ret.reset();
  path.resize(0, 0);
}

void ManipulationHelper::addDefaults(const ManipulationDefaults& with) {
  if (with.accumulated_collisions) komo->addObjective({}, F::accumulatedCollisions, {}, O::eq, 1.);
  if (with.joint_limits) komo->addObjective({}, F::jointLimits, {}, O::ineq, 1.);
  if (with.quaternion_norms) komo->addQuaternionNorms();
}

void ManipulationHelper::setup_inverse_kinematics(const Config& C, double homing_scale,
                                                  const ManipulationDefaults& with) {
  setup(C, 1., 1, 0);
  if (homing_scale > 0.) komo->addControlObjective({}, 0, homing_scale);
  addDefaults(with);
}

void ManipulationHelper::setup_sequence(const Config& C, double K, double homing_scale, double velocity_scale,
                                        const ManipulationDefaults& with) {
  setup(C, K, 1, 1);
  if (homing_scale > 0.) komo->addControlObjective({}, 0, homing_scale);
  if (velocity_scale > 0.) komo->addControlObjective({}, 1, velocity_scale);
  addDefaults(with);
}

void ManipulationHelper::setup_motion(const Config& C, double K, int steps_per_phase, double homing_scale,
                                      double acceleration_scale, const ManipulationDefaults& with) {
  setup(C, K, steps_per_phase, 2);
  if (homing_scale > 0.) komo->addControlObjective({}, 0, homing_scale);
  if (acceleration_scale > 0.) komo->addControlObjective({}, 2, acceleration_scale);
  addDefaults(with);
  komo->addObjective({K}, F::qItself, {}, O::eq, 1., {}, 1);
}

void ManipulationHelper::setup_pick_and_place_waypoints(const Config& C, const std::string& gripper,
                                                        const std::string& obj, double homing_scale,
                                                        double velocity_scale, const ManipulationDefaults& with) {
  setup_sequence(C, 2., homing_scale, velocity_scale, with);
  add_stable_frame(JointType::free, gripper, obj + "_grasp", obj);
  snap_switch(1., obj + "_grasp", obj);
}

void ManipulationHelper::setup_point_to_point_motion(const Config& C, const VectorXd& q1, double homing_scale,
                                                     double acceleration_scale, const ManipulationDefaults& with) {
  setup_motion(C, 1., kMotionSlices, homing_scale, acceleration_scale, with);
  komo->setWaypoints({q1}, {1, true, .5});
  komo->addObjective({1.}, F::qItself, {}, O::eq, 1., q1);
}

void ManipulationHelper::add_stable_frame(JointType jointType, const std::string& parent, const std::string& name,
                                          const std::string& initFrame) {
  problem("add_stable_frame").addFrameDof(name, parent, jointType, true, initFrame);
}

void ManipulationHelper::add_place_frame(const std::string& parent, const std::string& obj, const std::string& name) {
  problem("add_place_frame");
  const double above = .5 * height(frame(parent)) + depthOf(frame(obj));
  const Pose X_WP = frame(parent).getPose() * Pose(Vector3d(0., 0., above), Quaterniond::Identity());
  addFrameDof(komo->path(), {.name = name,
                             .parent = parent,
                             .type = JointType::transXYPhi,
                             .stable = true,
                             .origin = parent,
                             .origin_pose = X_WP});
}

void ManipulationHelper::snap_switch(double time, const std::string& parent, const std::string& obj) {
  problem("snap_switch").addRigidSwitch(time, parent, obj);
}

void ManipulationHelper::grasp_top_box(double time, const std::string& gripper, const std::string& obj,
                                       const std::string& grasp_direction) {
  // The scalar products of axes of the object and the gripper that have to vanish.
  using Products = std::array<F, 3>;
  static const std::map<std::string, Products> vanishing = {
      {"xz", {F::scalarProductXY, F::scalarProductXZ, F::scalarProductYZ}},
      {"yz", {F::scalarProductYY, F::scalarProductXZ, F::scalarProductYZ}},
      {"xy", {F::scalarProductXY, F::scalarProductXZ, F::scalarProductZZ}},
      {"zy", {F::scalarProductXX, F::scalarProductXZ, F::scalarProductZZ}},
      {"yx", {F::scalarProductYY, F::scalarProductYZ, F::scalarProductZZ}},
      {"zx", {F::scalarProductYX, F::scalarProductYZ, F::scalarProductZZ}}};
  Komo& k = problem("grasp_top_box");
  const auto found = vanishing.find(grasp_direction);
  if (found == vanishing.end()) {
    throw ValueError(cat("ManipulationHelper.grasp_top_box: grasp_direction is '", grasp_direction,
                         "'; expected one of xz, yz, xy, zy, yx, zx"));
  }
  k.addObjective({time}, F::positionDiff, {gripper, obj}, O::eq, 1e1);
  for (F feature : found->second) k.addObjective({time - kAlign, time}, feature, {obj, gripper}, O::eq, 1.);
}

void ManipulationHelper::addPalm(double time, const std::string& palm, const std::string& obj) {
  if (palm.empty()) return;
  komo->addObjective({time - kKeepOff, time}, F::distance, {palm, obj}, O::ineq, 1e1, -.001);
}

void ManipulationHelper::grasp_box(double time, const std::string& gripper, const std::string& obj,
                                   const std::string& palm, const std::string& grasp_direction, double margin) {
  Komo& k = problem("grasp_box");
  const int along = axisOf(grasp_direction, "grasp_box", "grasp_direction");
  const std::array<int, 2> others = along == 0 ? std::array{1, 2} : along == 1 ? std::array{0, 2} : std::array{0, 1};
  const VectorXd inside = (.5 * boxSize(obj, "grasp_box")).array() - margin;
  const std::vector<std::string> frames = {gripper, obj};
  k.addObjective({time}, F::positionRel, frames, O::eq, only(1e1, along));
  k.addObjective({time}, F::positionRel, frames, O::ineq, only(1e1, others[0], others[1]), inside);
  k.addObjective({time}, F::positionRel, frames, O::ineq, only(-1e1, others[0], others[1]), VectorXd(-inside));
  for (int other : others) k.addObjective({time - kAlign, time}, product(0, other), frames, O::eq, 1.);
  addPalm(time, palm, obj);
}

void ManipulationHelper::grasp_cylinder(double time, const std::string& gripper, const std::string& obj,
                                        const std::string& palm, double margin) {
  Komo& k = problem("grasp_cylinder");
  const double inside = .5 * boxSize(obj, "grasp_cylinder").z() - margin;
  const std::vector<std::string> frames = {gripper, obj};
  k.addObjective({time}, F::positionRel, frames, O::eq, only(1e1, 0, 1));
  k.addObjective({time}, F::positionRel, frames, O::ineq, only(1e1, 2), {0., 0., inside});
  k.addObjective({time}, F::positionRel, frames, O::ineq, only(-1e1, 2), {0., 0., -inside});
  k.addObjective({time - kAlign, time}, F::scalarProductXZ, frames, O::eq, 1.);
  addPalm(time, palm, obj);
}

void ManipulationHelper::place_box(double time, const std::string& obj, const std::string& table,
                                   const std::string& palm, const std::string& place_direction, double margin) {
  Komo& k = problem("place_box");
  const bool down = place_direction.size() == 4 && place_direction.substr(1) == "Neg";
  const int up = axisOf(down ? place_direction.substr(0, 1) : place_direction, "place_box", "place_direction");
  const VectorXd size = boxSize(obj, "place_box"), table_size = boxSize(table, "place_box");
  const double height = .5 * (size[up] + table_size.z());
  const VectorXd inside = (.5 * table_size).array() - margin;
  k.addObjective({time}, F::positionDiff, {obj, table}, O::eq, only(1e1, 2), {0., 0., height});
  k.addObjective({time}, F::positionRel, {obj, table}, O::ineq, only(1e1, 0, 1), inside);
  k.addObjective({time}, F::positionRel, {obj, table}, O::ineq, only(-1e1, 0, 1), VectorXd(-inside));
  k.addObjective({time - kAlign, time}, axis(up), {obj}, O::eq, .5, {0., 0., down ? -1. : 1.});
  for (int flat : {0, 1}) k.addObjective({time - kAlign, time}, product(flat, up), {table, obj}, O::eq, 1.);
  addPalm(time, palm, table);
}

void ManipulationHelper::no_collisions(const std::vector<double>& times, const std::vector<std::string>& pairs,
                                       double margin, double scale) {
  Komo& k = problem("no_collisions");
  if (pairs.size() % 2 != 0) {
    throw ValueError(cat("ManipulationHelper.no_collisions: frames come in pairs, got ", pairs.size()));
  }
  for (std::size_t i = 0; i < pairs.size(); i += 2)
    k.addObjective(times, F::distance, {pairs[i], pairs[i + 1]}, O::ineq, scale, -margin);
}

void ManipulationHelper::freeze_joint(const std::vector<double>& times, const std::vector<std::string>& joints) {
  problem("freeze_joint").addObjective(times, F::qItself, joints, O::eq, 1e1, {}, 1);
}

void ManipulationHelper::freeze_relativePose(const std::vector<double>& times, const std::string& to,
                                             const std::string& from) {
  problem("freeze_relativePose").addObjective(times, F::poseRel, {to, from}, O::eq, 1e1, {}, 1);
}

void ManipulationHelper::target_position(double time, const std::string& obj, const Vector3d& position) {
  problem("target_position").addObjective({time}, F::position, {obj}, O::eq, 1e1, position);
}

void ManipulationHelper::target_relative_xy_position(double time, const std::string& obj, const std::string& relativeTo,
                                                     const VectorXd& position) {
  Komo& k = problem("target_relative_xy_position");
  if (position.size() != 2 && position.size() != 3) {
    throw ValueError(cat("ManipulationHelper.target_relative_xy_position: position has ", position.size(),
                         " numbers; expected x and y, m"));
  }
  k.addObjective({time}, F::positionRel, {obj, relativeTo}, O::eq, only(1e1, 0, 1), {position[0], position[1], 0.});
}

void ManipulationHelper::target_x_orientation(double time, const std::string& obj, const Vector3d& x_vector) {
  problem("target_x_orientation").addObjective({time}, F::vectorX, {obj}, O::eq, 1e1, x_vector);
}

void ManipulationHelper::bias(double time, const VectorXd& q, double scale) {
  problem("bias").addObjective({time}, F::qItself, {}, O::sos, scale, q);
}

const SolverResult& ManipulationHelper::solve(int verbose) {
  problem("solve");
  NlpSolver solver(makeNlp(komo), verbose - 1);
  solver.options.verbose = std::max(verbose - 1, 0);
  solver.options.damping = .1;
  solver.options.stopTolerance = 1e-3;
  solver.options.lambdaMax = 100.;
  solver.options.stopInners = 20;
  solver.options.stopEvals = 200;
  solver.setInitialization(komo->path().variables());
  ret = solver.solve();
  path = ret->feasible ? komo->getPath() : MatrixXd();
  if (verbose > 0) {
    logMessage(LogLevel::info, cat("  -- ", ret->feasible ? "feasible" : "infeasible", ": ", info,
                                   info.empty() ? "" : ": ", ret->message));
  }
  return *ret;
}

ManipulationHelper ManipulationHelper::sub_motion(int phase, bool fixEnd, double homing_scale,
                                                  double acceleration_scale, const ManipulationDefaults& with) const {
  const SubProblem sub = subProblem(problem("sub_motion").path(), phase);
  ManipulationHelper motion(cat("sub_motion ", phase));
  if (fixEnd) {
    motion.setup_point_to_point_motion(sub.config, sub.end, homing_scale, acceleration_scale, with);
  } else {
    motion.setup_motion(sub.config, 1., kMotionSlices, homing_scale, acceleration_scale, with);
    motion.komo->setWaypoints({sub.end}, {1, true, .5});
  }
  return motion;
}

}  // namespace kinegraph
