#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include "kinegraph/planning/dynamic_obstacles/dynamic_scene.h"
#include "kinegraph/planning/steering/joint_space.h"
#include "kinegraph/trajectories/time_scaling.h"
#include "pickling.h"
#include "planning/plan_objects.h"

namespace kinegraph::python {

namespace {

nb::tuple constraintState(const MotionConstraint& c) {
  return nb::make_tuple(featureState(c.feature), c.frames, int(c.type), toNumpy(c.scale.matrix()),
                        toNumpy(c.target.vector()));
}

void setConstraintState(MotionConstraint& c, const nb::tuple& state) {
  new (&c) MotionConstraint{featureFrom(state[0]), nb::cast<std::vector<std::string>>(state[1]),
                            ObjectiveType(nb::cast<int>(state[2])), matrixFrom(state[3]),
                            nb::cast<Numbers>(state[4]).values};
}

/// The options as keyword arguments of planMotion.
nb::dict optionFields(const PlanOptions& options) {
  nb::dict fields = planOptionClass().dict(options);
  const auto add = [&](const char* name, const VectorXd& values) {
    if (values.size() > 0) fields[name] = toNumpy(values);
  };
  add("velocity", options.velocity);
  add("acceleration", options.acceleration);
  add("jerk", options.jerk);
  add("start_velocity", options.start_velocity);
  add("start_acceleration", options.start_acceleration);
  add("end_velocity", options.end_velocity);
  add("end_acceleration", options.end_acceleration);
  nb::list constraints;
  for (const MotionConstraint& constraint : options.constraints) constraints.append(constraint);
  fields["constraints"] = constraints;
  nb::dict obstacles;
  for (const ObstacleTrajectory& obstacle : options.obstacle_trajectories)
    obstacles[obstacle.frame.c_str()] = nb::make_tuple(toNumpy(obstacle.times), toNumpy(obstacle.values));
  fields["obstacle_trajectories"] = obstacles;
  return fields;
}

nb::tuple treeState(const SearchTree& tree, int dofs) {
  const NewArray q = newArray(std::size_t(tree.size()), std::size_t(dofs)), radius = newArray(std::size_t(tree.size()));
  std::vector<int> parents;
  std::vector<bool> verified;
  for (int i = 0; i < tree.size(); ++i) {
    std::copy_n(tree.q(i).data(), dofs, q.data + std::ptrdiff_t(i) * dofs);
    radius.data[i] = tree.node(i).radius;
    parents.push_back(tree.node(i).parent);
    verified.push_back(tree.node(i).is_verified);
  }
  return nb::make_tuple(q.array, radius.array, parents, verified);
}

/// Rebuilds a tree: first its roots, then the other nodes with their parents.
SearchTree treeFrom(nb::handle state, const JointSpace& space) {
  const MatrixXd q = matrixFrom(state[0]);
  const VectorXd radius = nb::cast<Numbers>(state[1]).values;
  const auto parents = nb::cast<std::vector<int>>(state[2]);
  const auto verified = nb::cast<std::vector<bool>>(state[3]);
  const std::size_t count = parents.size();
  if (q.cols() != space.dofs() || std::size_t(q.rows()) != count || std::size_t(radius.size()) != count ||
      verified.size() != count)
    throw ValueError("MotionPlan: the arrays of a tree differ in length");
  std::vector<VectorXd> roots;
  while (roots.size() < count && parents[roots.size()] < 0)
    roots.push_back(q.row(Eigen::Index(roots.size())).transpose());
  SearchTree tree(space.dofs(), roots);
  for (std::size_t i = roots.size(); i < count; ++i) {
    if (parents[i] < 0 || parents[i] >= int(i)) throw ValueError("MotionPlan: a node of a tree precedes its parent");
    tree.add(q.row(Eigen::Index(i)).transpose(), parents[i], verified[i]);
  }
  for (std::size_t i = 0; i < count; ++i) tree.node(int(i)).radius = radius[Eigen::Index(i)];
  return tree;
}

nb::object placeState(const std::optional<UnseenPlace>& place) {
  if (!place) return nb::none();
  MatrixXd points(Eigen::Index(place->cells.size()) + 1, 3);
  points.row(0) = place->position.transpose();
  for (Eigen::Index i = 1; i < points.rows(); ++i) points.row(i) = place->cells[std::size_t(i - 1)].transpose();
  return nb::make_tuple(toNumpy(points), place->frame, toNumpy(MatrixXd(place->q.transpose())), place->depth);
}

UnseenPlace placeFrom(const nb::tuple& t) {
  const MatrixXd points = matrixFrom(t[0]);
  UnseenPlace place{points.row(0).transpose(), nb::cast<std::string>(t[1]), matrixFrom(t[2]).row(0).transpose(),
                    nb::cast<double>(t[3])};
  for (Eigen::Index i = 1; i < points.rows(); ++i) place.cells.push_back(points.row(i).transpose());
  return place;
}

nb::tuple planState(const PyMotionPlan& p) {
  nb::list stages, searches, trees, obstacles;
  for (const PlanStage& s : p.stages) stages.append(nb::make_tuple(s.name, s.seconds, s.evaluations, s.note));
  for (const SearchReport& a : p.searches)
    searches.append(nb::make_tuple(a.samples, a.evaluations, a.start_nodes, a.goal_nodes));
  for (const SearchTree& tree : p.trees) trees.append(treeState(tree, p.space->dofs()));
  for (const MetObstacle& o : p.obstacles) obstacles.append(nb::make_tuple(o.frame, o.name, o.share, o.by));
  const nb::object timed = p.timed_path.scaling().phases().empty() ? nb::none() : nb::cast(p.timed_path);
  return nb::make_tuple(PyConfig{Config(*p.config), nullptr}, optionFields(p.options), int(p.status), p.message,
                        p.warnings, toNumpy(p.path), toNumpy(p.raw_path), timed, p.length, p.goal, stages, searches,
                        trees, obstacles, p.margin, p.verified_margin, placeState(p.blockedByUnseen));
}

/// Sets the static scene and the joint space.
void setScene(PyMotionPlan& plan) {
  Config static_scene(*plan.config);
  if (!plan.options.obstacle_trajectories.empty()) {
    plan.dynamic_scene =
        std::make_shared<const DynamicScene>(*plan.config, plan.options.obstacle_trajectories, "MotionPlan");
    static_scene = plan.dynamic_scene->staticScene();
  }
  plan.scene = std::make_shared<const State>(static_scene.state());
  plan.space = std::make_shared<const JointSpace>(*static_scene.model());
}

PyMotionPlan planFrom(const nb::tuple& t) {
  PyMotionPlan plan;
  plan.config = std::make_shared<const Config>(nb::cast<const PyConfig&>(t[0]));
  planOptionClass().setFields(plan.options, nb::cast<nb::dict>(t[1]));
  setScene(plan);
  plan.status = PlanStatus(nb::cast<int>(t[2]));
  plan.message = nb::cast<std::string>(t[3]);
  plan.warnings = nb::cast<std::vector<std::string>>(t[4]);
  plan.path = matrixFrom(t[5]);
  plan.raw_path = matrixFrom(t[6]);
  if (!nb::handle(t[7]).is_none()) plan.timed_path = nb::cast<const TimedPath&>(t[7]);
  plan.length = nb::cast<double>(t[8]);
  plan.goal = nb::cast<int>(t[9]);
  for (nb::handle s : nb::cast<nb::list>(t[10]))
    plan.stages.push_back(
        {nb::cast<std::string>(s[0]), nb::cast<double>(s[1]), nb::cast<long>(s[2]), nb::cast<std::string>(s[3])});
  for (nb::handle a : nb::cast<nb::list>(t[11]))
    plan.searches.push_back({nb::cast<long>(a[0]), nb::cast<long>(a[1]), nb::cast<int>(a[2]), nb::cast<int>(a[3])});
  for (nb::handle tree : nb::cast<nb::list>(t[12])) plan.trees.push_back(treeFrom(tree, *plan.space));
  for (nb::handle o : nb::cast<nb::list>(t[13]))
    plan.obstacles.push_back({nb::cast<int>(o[0]), nb::cast<std::string>(o[1]), nb::cast<double>(o[2]),
                              nb::cast<std::vector<std::string>>(o[3])});
  plan.margin = nb::cast<double>(t[14]);
  plan.verified_margin = nb::cast<double>(t[15]);
  if (!nb::handle(t[16]).is_none()) plan.blockedByUnseen = placeFrom(nb::cast<nb::tuple>(t[16]));
  return plan;
}

}  // namespace

void bindPlanCopies(nb::class_<MotionConstraint>& constraint, MotionPlanClass& plan) {
  constraint.def("__getstate__", constraintState).def("__setstate__", setConstraintState, "state"_a);
  plan.def("__getstate__", planState)
      .def(
          "__setstate__", [](PyMotionPlan& p, const nb::tuple& state) { new (&p) PyMotionPlan(planFrom(state)); },
          "state"_a);
}

}  // namespace kinegraph::python
