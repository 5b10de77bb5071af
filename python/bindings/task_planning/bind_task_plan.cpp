#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include "arguments.h"
#include "kinegraph/api/task_view.h"
#include "kinegraph/common/text.h"
#include "kinegraph/logic/domain.h"
#include "python_names.h"
#include "task_planning/task_objects.h"
#include "task_planning/task_plan_docs.h"
#include "viewer/notebook_page.h"
#include "viewer/py_viewer.h"

namespace kinegraph::python {

namespace {

PyConfig copyOf(const Config& C) { return PyConfig{Config(C), nullptr}; }

void makePlan(PyTaskPlan* self, const std::vector<TaskAction>& actions, const Numbers& path, const Numbers& times,
              const std::vector<nb::slice>& segments, const std::optional<Numbers>& limits,
              const std::vector<std::string>& goal, const std::vector<std::string>& start) {
  PyTaskPlan plan;
  plan.status = TaskStatus::solved;
  plan.actions = actions;
  plan.path = path.matrix();
  plan.times = times.values;
  if (limits) plan.limits = limits->matrix();
  for (const nb::slice& rows : segments) {
    const auto [begin, end, step, count] = rows.compute(std::size_t(plan.path.rows()));
    if (step != 1) throw ValueError(cat("TaskPlan: a segment has step ", step, "; expected consecutive rows"));
    plan.segments.push_back({Eigen::Index(begin), Eigen::Index(end)});
  }
  plan.goal = readLiterals(join(goal, " "), "goal");
  plan.start = readLiterals(join(start, " "), "start");
  plan.requireMotion("__init__");
  new (self) PyTaskPlan(std::move(plan));
}

nb::typed<nb::list, nb::slice> segments(const PyTaskPlan& plan) {
  nb::list list;
  for (const RowRange& rows : plan.segments) list.append(nb::slice(rows.begin, rows.end));
  return nb::borrow<nb::typed<nb::list, nb::slice>>(list);
}

nb::typed<nb::list, PyConfig> scenes(const PyTaskPlan& plan) {
  nb::list list;
  for (const Config& scene : plan.scenes) list.append(copyOf(scene));
  return nb::borrow<nb::typed<nb::list, PyConfig>>(list);
}

int show(nb::handle C, bool pause, const std::string& text) {
  return nb::cast<int>(C.attr("view")(pause, inPython(text)));
}

void play(const PyTaskPlan& plan, nb::handle_t<PyConfig> C, bool pause) {
  playTask(plan, nb::cast<PyConfig&>(C), pause,
           [&](bool wait, const std::string& text) { return show(C, wait, text); });
}

int view(const PyTaskPlan& plan, nb::handle_t<PyConfig> C, bool pause) {
  auto& scene = nb::cast<PyConfig&>(C);
  if (plan.path.rows() > 0) return playOnPage(scene, scene, taskMotion(plan, scene), pause, plan.str());
  return viewOnPage(scene, failedScene(plan, scene), pause, inPython(cat(plan.message, "\n", plan.searchTree())));
}

/// Returns the motion, else the configuration that failed in the longest branch; notebooks show the text without both.
std::optional<std::string> page(const PyTaskPlan& plan) {
  const std::string text = inPython(cat(plan.str(), "\n", plan.searchTree()));
  if (plan.path.rows() > 0 && !plan.scenes.empty()) {
    const ShownMotion motion = taskMotion(plan, plan.scenes.front());
    return notebookPage(plan.scenes.front(), &motion, "TaskPlan", text);
  }
  const TaskBranch* farthest = farthestFailed(plan);
  if (!farthest) return std::nullopt;
  return notebookPage(*farthest->failed_configuration, nullptr, "TaskPlan", text);
}

Array frames(const PyTaskPlan& plan, const PyConfig& C, double rate) {
  const std::vector<MatrixXd> poses = plan.frames(C, rate);
  const NewArray all = newArray(poses.size(), std::size_t(poses[0].rows()), 7);
  double* next = all.data;
  for (const MatrixXd& rows : poses)
    for (Eigen::Index i = 0; i < rows.rows(); ++i)
      for (Eigen::Index k = 0; k < 7; ++k) *next++ = rows(i, k);
  return all.array;
}

PyTaskPlan repair(const PyTaskPlan& plan, const PyConfig& C, std::optional<double> time_limit,
                  std::optional<long> max_evaluations, std::optional<int> threads, const std::string& also) {
  const Config scene(C);
  TaskPlan repaired = [&] {
    const nb::gil_scoped_release unlock;
    return plan.repair(scene, {time_limit, max_evaluations, threads, also});
  }();
  std::shared_ptr<const TaskRequest> request = plan.request;
  if (request && !also.empty()) {  // copies of the plan have the same goal
    TaskRequest with = *request;
    with.goal = join(literalTexts(repaired.goal), " ");
    request = std::make_shared<const TaskRequest>(std::move(with));
  }
  return {std::move(repaired), std::move(request)};
}

void bindPlanFields(nb::class_<PyTaskPlan, Trajectory>& plan) {
  plan.def_prop_ro("feasible", &TaskPlan::feasible, "True if there is a plan. checkTaskPlan accepted its motion.")
      .def_ro("status", &TaskPlan::status, "How the search ended, a TaskStatus.")
      .def_prop_ro(
          "message", [](const PyTaskPlan& p) { return inPython(p.message); },
          "\"\" if there is a plan; else the reason for which there is none.")
      .def_ro("warnings", &TaskPlan::warnings, "Caveats of a plan, as that the goal already holds: list of sentences.")
      .def_ro("actions", &TaskPlan::actions, "The actions, each a list of words: ['pick', 'cup', 'table', 'hand'].")
      .def_prop_ro(
          "waypoints", [](const PyTaskPlan& p) { return toNumpy(p.waypoints); }, "q after each action, shape (K, n).")
      .def_prop_ro(
          "path", [](const PyTaskPlan& p) { return toNumpy(p.path); },
          "The motion, shape (T, n), rad or m; without rows if there is none. It is straight between two rows.")
      .def_prop_ro(
          "times", [](const PyTaskPlan& p) { return toNumpy(p.times); },
          "The times of the rows of path, shape (T,), s.")
      .def_prop_ro(
          "limits", [](const PyTaskPlan& p) { return toNumpy(p.limits); },
          "Velocity and acceleration limits of the motion, shape (2, n); without rows if they are unknown.")
      .def_prop_ro("segments", segments,
                   "The rows of path of each action, a slice each. The motion is at rest at the beginning of each.")
      .def_ro("causes", &TaskPlan::causes,
              "(cause, count) of branches that were given up, the most frequent cause first.")
      .def_ro("tree", &TaskPlan::tree, "All branches that were tried, a TaskBranch each.")
      .def_ro("violations", &TaskPlan::violations, "What checkTaskPlan found.")
      .def_ro("margin", &TaskPlan::margin,
              "m, kept by all pairs whose contact is not meant; less than the argument of planTask with a warning.")
      .def_prop_ro(
          "tolerances", [](const PyTaskPlan& p) { return toleranceList(p.tolerances); },
          "(error, limit) of each action: the error (m) of the poses of the robot and of objects that it survives, at "
          "most .03, and what happens with a larger one.")
      .def_ro("evaluations", &TaskPlan::evaluations, "Evaluations of waypoint and motion problems.")
      .def_ro("expansions", &TaskPlan::expansions, "States that the search in logic expanded.")
      .def_ro("attachments", &TaskPlan::attachments, "(parent, object) after each action that moves an object.")
      .def_prop_ro("scenes", scenes, "The scene of each action, a Config, with held objects attached to hands.")
      .def_prop_ro(
          "goal", [](const PyTaskPlan& p) { return literalTexts(p.goal); }, "The literals of the goal.")
      .def_prop_ro(
          "start", [](const PyTaskPlan& p) { return literalTexts(p.start); }, "The literals that hold initially.");
}

}  // namespace

std::vector<std::pair<double, std::string>> toleranceList(const std::vector<StepTolerance>& tolerances) {
  std::vector<std::pair<double, std::string>> list;
  for (const StepTolerance& step : tolerances) list.emplace_back(step.error, step.limit);
  return list;
}

std::vector<std::string> literalTexts(const std::vector<Literal>& literals) {
  std::vector<std::string> texts;
  for (const Literal& literal : literals) texts.push_back(literal.str());
  return texts;
}

void bindTaskPlan(nb::module_& m) {
  namespace docs = docs::task_plan;
  nb::enum_<TaskStatus> status(m, "TaskStatus", "How planTask ended.");
  for (int i = 0; i <= int(TaskStatus::timeout); ++i) {
    static std::vector<std::string> names(std::size_t(TaskStatus::timeout) + 1);
    names[std::size_t(i)] = taskStatusName(TaskStatus(i));
    status.value(names[std::size_t(i)].c_str(), TaskStatus(i));
  }
  nb::class_<TaskBranch> branch(m, "TaskBranch", "A sequence of actions that planTask tried.");
  branch.def_ro("actions", &TaskBranch::actions, "The actions, each a list of words.")
      .def_ro("cause", &TaskBranch::cause, "The reason for which the branch was given up; \"\" for a plan.")
      .def_prop_ro(
          "failed_configuration",
          [](const TaskBranch& b) {
            return b.failed_configuration ? nb::cast(copyOf(*b.failed_configuration)) : nb::none();
          },
          nb::sig("def failed_configuration(self, /) -> Config | None"),
          "The scene at the waypoint that failed, as close to the demands of the last action as the solver came.")
      .def("__repr__", [](const TaskBranch& b) {
        return cat("<TaskBranch ", planText(b.actions), b.cause.empty() ? "" : ": ", inPython(b.cause), ">");
      });
  nb::class_<PyTaskPlan, Trajectory> plan(m, "TaskPlan", docs::type);
  plan.def("__init__", makePlan, "actions"_a, "path"_a, "times"_a, "segments"_a, nb::kw_only(), "limits"_a = nb::none(),
           "goal"_a = std::vector<std::string>(), "start"_a = std::vector<std::string>(), docs::make);
  bindPlanFields(plan);
  plan.def(
          "explain", [](const PyTaskPlan& p) { return inPython(p.explain()); },
          "Several lines: the status, the weakest step with the error of poses that it survives, the spent "
          "evaluations, "
          "and all causes for which branches were given up.")
      .def(
          "searchTree", [](const PyTaskPlan& p) { return inPython(p.searchTree()); },
          "The branches as a tree: a line per action, with the cause behind the last action of each branch.")
      .def("_repr_html_", page,
           "Returns a page for notebooks with the motion, or the configuration that failed, without a running program.")
      .def("view", view, "C"_a, "pause"_a = true, docs::view)
      .def("play", play, "C"_a, "pause"_a = false, docs::play)
      .def("frames", frames, "C"_a, "rate"_a = 25., docs::frames)
      .def(
          "failedConfiguration",
          [](const PyTaskPlan& p, const PyConfig& C) { return copyOf(p.failedConfiguration(C)); }, "C"_a,
          docs::failedConfiguration)
      .def("repair", repair, "C"_a, nb::kw_only(), "time_limit"_a = nb::none(), "max_evaluations"_a = nb::none(),
           "threads"_a = nb::none(), "also"_a = "", docs::repair)
      .def("__bool__", &TaskPlan::feasible)
      .def("__str__", [](const PyTaskPlan& p) { return inPython(p.str()); })
      .def("__repr__", [](const PyTaskPlan& p) {
        return cat("<TaskPlan ", taskStatusName(p.status), ": ", inPython(p.summary()), ">");
      });
  bindExecutionOf(plan);
  bindTaskPlanCopies(branch, plan);
}

}  // namespace kinegraph::python
