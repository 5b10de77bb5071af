#include <nanobind/stl/map.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include "kinegraph/logic/domain.h"
#include "pickling.h"
#include "task_planning/task_objects.h"

namespace kinegraph::python {

namespace {

using Words = std::vector<std::string>;

nb::object sceneState(const std::shared_ptr<const Config>& scene) {
  return scene ? nb::cast(PyConfig{Config(*scene), nullptr}) : nb::none();
}

std::shared_ptr<const Config> sceneFrom(nb::handle state) {
  return state.is_none() ? nullptr : std::make_shared<const Config>(nb::cast<const PyConfig&>(state));
}

nb::tuple branchState(const TaskBranch& branch) {
  return nb::make_tuple(branch.actions, branch.cause, sceneState(branch.failed_configuration));
}

TaskBranch branchFrom(nb::handle state) {
  return {nb::cast<std::vector<TaskAction>>(state[0]), nb::cast<std::string>(state[1]), sceneFrom(state[2])};
}

std::vector<Literal> literalsFrom(nb::handle state) {
  std::vector<Literal> all;
  for (const std::string& text : nb::cast<Words>(state))
    for (Literal& literal : readLiterals(text, "TaskPlan")) all.push_back(std::move(literal));
  return all;
}

nb::object requestState(const std::shared_ptr<const TaskRequest>& request) {
  if (!request) return nb::none();
  return nb::make_tuple(request->goal, request->domain, request->rules, request->time_limit, request->max_evaluations,
                        request->seed, toNumpy(request->velocity), toNumpy(request->acceleration), request->threads,
                        request->margin, request->contact_speed);
}

std::shared_ptr<const TaskRequest> requestFrom(nb::handle state) {
  if (state.is_none()) return nullptr;
  return std::make_shared<const TaskRequest>(TaskRequest{
      nb::cast<std::string>(state[0]), nb::cast<std::optional<LogicDomain>>(state[1]), nb::cast<PyTaskRules>(state[2]),
      nb::cast<std::optional<double>>(state[3]), nb::cast<long>(state[4]), nb::cast<std::uint64_t>(state[5]),
      nb::cast<Numbers>(state[6]).values, nb::cast<Numbers>(state[7]).values, nb::cast<int>(state[8]),
      nb::cast<double>(state[9]),
      nb::len(state) > 10 ? nb::cast<double>(state[10]) : TaskOptions().contact_speed});  // older plans have none
}

nb::tuple planState(const PyTaskPlan& p) {
  nb::list segments, tree, scenes;
  for (const RowRange& rows : p.segments) segments.append(nb::make_tuple(rows.begin, rows.end));
  for (const TaskBranch& branch : p.tree) tree.append(branch);
  for (const Config& scene : p.scenes) scenes.append(PyConfig{Config(scene), nullptr});
  return nb::make_tuple(int(p.status), p.message, p.warnings, p.actions, toNumpy(p.waypoints), toNumpy(p.path),
                        toNumpy(p.times), toNumpy(p.limits), segments, p.causes, tree, p.violations, p.evaluations,
                        p.expansions, p.attachments, scenes, literalTexts(p.goal), literalTexts(p.start),
                        requestState(p.request), p.margin, toleranceList(p.tolerances));
}

PyTaskPlan planFrom(const nb::tuple& t) {
  PyTaskPlan plan;
  plan.status = TaskStatus(nb::cast<int>(t[0]));
  plan.message = nb::cast<std::string>(t[1]);
  plan.warnings = nb::cast<Words>(t[2]);
  plan.actions = nb::cast<std::vector<TaskAction>>(t[3]);
  plan.waypoints = matrixFrom(t[4]);
  plan.path = matrixFrom(t[5]);
  plan.times = nb::cast<Numbers>(t[6]).values;
  plan.limits = matrixFrom(t[7]);
  for (nb::handle rows : nb::cast<nb::list>(t[8]))
    plan.segments.push_back({nb::cast<Eigen::Index>(rows[0]), nb::cast<Eigen::Index>(rows[1])});
  plan.causes = nb::cast<std::vector<std::pair<std::string, int>>>(t[9]);
  for (nb::handle branch : nb::cast<nb::list>(t[10])) plan.tree.push_back(nb::cast<const TaskBranch&>(branch));
  plan.violations = nb::cast<Words>(t[11]);
  plan.evaluations = nb::cast<long>(t[12]);
  plan.expansions = nb::cast<long>(t[13]);
  plan.attachments = nb::cast<std::vector<std::pair<std::string, std::string>>>(t[14]);
  for (nb::handle scene : nb::cast<nb::list>(t[15])) plan.scenes.push_back(nb::cast<const PyConfig&>(scene));
  plan.goal = literalsFrom(t[16]);
  plan.start = literalsFrom(t[17]);
  plan.request = requestFrom(t[18]);
  plan.margin = nb::cast<double>(t[19]);
  for (const auto& [error, limit] : nb::cast<std::vector<std::pair<double, std::string>>>(t[20]))
    plan.tolerances.push_back({error, limit});
  if (plan.request) plan.replanner = replannerTo(plan.request->goal, plan.request->options());
  return plan;
}

}  // namespace

void bindTaskPlanCopies(nb::class_<TaskBranch>& branch, nb::class_<PyTaskPlan, Trajectory>& plan) {
  branch.def("__getstate__", branchState)
      .def(
          "__setstate__", [](TaskBranch& b, const nb::tuple& state) { new (&b) TaskBranch(branchFrom(state)); },
          "state"_a);
  plan.def("__getstate__", planState)
      .def(
          "__setstate__", [](PyTaskPlan& p, const nb::tuple& state) { new (&p) PyTaskPlan(planFrom(state)); },
          "state"_a);
}

}  // namespace kinegraph::python
