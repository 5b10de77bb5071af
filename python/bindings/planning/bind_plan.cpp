#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/unique_ptr.h>
#include <nanobind/stl/variant.h>
#include <nanobind/stl/vector.h>

#include "features/feature_arguments.h"
#include "ik/ik_targets.h"
#include "kinegraph/api/plan_view.h"
#include "kinegraph/common/log.h"
#include "kinegraph/common/stopwatch.h"
#include "kinegraph/planning/path_finder.h"
#include "kinegraph/planning/steering/joint_space.h"
#include "planning/path_lines_docs.h"
#include "planning/plan_arguments.h"
#include "planning/plan_docs.h"
#include "planning/plan_objects.h"
#include "progress_bar.h"
#include "python_names.h"
#include "viewer/notebook_page.h"
#include "viewer/py_viewer.h"

namespace kinegraph::python {

namespace {

namespace lines = docs::path_lines;

std::vector<VectorXd> configurationsOf(const Numbers& numbers) {
  if (numbers.rank == 1) return {numbers.values};
  std::vector<VectorXd> rows;
  const MatrixXd matrix = numbers.matrix();
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) rows.push_back(matrix.row(i).transpose());
  return rows;
}

/// A frame is a common mistake for a joint state.
MotionGoal namedGoal(const Config& config, const std::string& name) {
  const std::vector<std::string> states = config.getStateNames();
  if (std::ranges::find(states, name) == states.end() && config.scene()->find(name))
    throw ValueError(cat("planMotion: the goal '", name, "' is a frame, not a joint state; pass where it should go, {'",
                         name, "': [x, y, z]} or {'", name, "': [x, y, z, qw, qx, qy, qz]}, or joint values"));
  return MotionGoal::named(name);
}

MotionGoal goalOf(const PyConfig& config, nb::handle goal) {
  Numbers numbers;
  if (nb::isinstance<nb::str>(goal)) return namedGoal(config, nb::cast<std::string>(goal));
  if (nb::isinstance<nb::dict>(goal)) {
    IkProblems request = readIkTargets(config, goal);
    if (request.is_batch) throw ValueError("planMotion: the goal has several rows of targets; expected one of each");
    return MotionGoal(std::move(request.problems[0]));
  }
  std::vector<MotionConstraint> conditions;
  if (nb::isinstance<MotionConstraint>(goal)) return MotionGoal(planConstraintsOf(goal));
  if (nb::try_cast(goal, conditions) && !conditions.empty()) return MotionGoal(std::move(conditions));
  if (readNumbers(goal, numbers) && (numbers.rank == 1 || numbers.rank == 2) && numbers.values.size() > 0)
    return MotionGoal(configurationsOf(numbers));
  throw ValueError(cat("planMotion: the goal is ", nb::cast<std::string>(nb::repr(goal)),
                       "; expected a joint vector or several, such as result.q of solveIk, a dict of targets as for "
                       "solveIk, the name of a joint state, or MotionConstraints"));
}

/// Takes the argument `verbose`, which is no option of the planner.
int takeVerbose(nb::kwargs& arguments) {
  if (!arguments.contains("verbose")) return 0;
  int verbose = 0;
  if (!nb::try_cast(arguments["verbose"], verbose))
    throw ValueError(
        cat("planMotion: verbose is ", nb::cast<std::string>(nb::repr(arguments["verbose"])), "; expected a number"));
  nb::del(arguments["verbose"]);
  return verbose;
}

PyMotionPlan plan(const PyConfig& config, nb::handle goal, const std::optional<Numbers>& start, nb::kwargs arguments) {
  const Stopwatch stopwatch;
  warnOfMissingContacts(config);
  const int verbose = takeVerbose(arguments);
  const PlanOptions options = planOptionsFrom(arguments, PlanCall::plan);
  const MotionGoal to = goalOf(config, goal);
  const std::optional<VectorXd> from = start ? std::optional(start->values) : std::nullopt;
  const auto scene = std::make_shared<const Config>(config);  // as it is now
  ProgressBar bar("planMotion", verbose);
  PyMotionPlan found = [&]() -> PyMotionPlan {
    const nb::gil_scoped_release unlock;
    return {planMotion(*scene, to, options, from, [&bar] { bar.check(); }), scene};
  }();
  bar.finish();
  found.addSetupStage(stopwatch.seconds());
  if (verbose > 0)
    logMessage(LogLevel::info, cat("planMotion: ", inPython(found.str()), ", ", stopwatch.seconds(), " s"));
  return found;
}

PyMotionPlan replan(const PyMotionPlan& running, const PyConfig& config, double at, nb::handle goal,
                    nb::kwargs arguments) {
  const PlanOptions options = planOptionsFrom(arguments, PlanCall::replan, running.optionsAt(at));
  const std::optional<MotionGoal> to = goal.is_none() ? std::nullopt : std::optional(goalOf(config, goal));
  const auto scene = std::make_shared<const Config>(config);
  const nb::gil_scoped_release unlock;
  return {running.replan(*scene, at, to, options, CheckInterrupts()), scene};
}

std::unique_ptr<PyMotionPlans> plans(const PyConfig& config, nb::handle goal, const std::optional<Numbers>& start,
                                     nb::kwargs arguments) {
  warnOfMissingContacts(config);
  const auto scene = std::make_shared<const Config>(config);
  return std::unique_ptr<PyMotionPlans>(
      new PyMotionPlans{scene, MotionPlans(*scene, goalOf(config, goal), planOptionsFrom(arguments, PlanCall::plans),
                                           start ? std::optional(start->values) : std::nullopt)});
}

PyMotionPlan nextMotionPlan(PyMotionPlans& plans) {
  std::optional<MotionPlan> plan;
  {
    const nb::gil_scoped_release unlock;
    plan = plans.plans.next(CheckInterrupts());
  }
  if (!plan) throw nb::stop_iteration();
  return {std::move(*plan), plans.config};
}

nb::typed<nb::dict, nb::str, Array> obstaclesAt(const PyMotionPlan& plan, double t) {
  nb::dict all;
  const std::vector<VectorXd> values = plan.obstaclesAt(t);
  for (std::size_t i = 0; i < values.size(); ++i)
    all[plan.options.obstacle_trajectories[i].frame.c_str()] = toNumpy(values[i]);
  return nb::borrow<nb::typed<nb::dict, nb::str, Array>>(all);
}

/// A dict per entry, filled by `fill(entry, dict)`.
template <class Entry, class Fill>
nb::typed<nb::list, Attributes> dictsOf(const std::vector<Entry>& entries, const Fill& fill) {
  nb::list list;
  for (const Entry& entry : entries) {
    Attributes one;
    fill(entry, one);
    list.append(one);
  }
  return list;
}

nb::typed<nb::list, Attributes> stages(const PyMotionPlan& plan) {
  return dictsOf(plan.stages, [](const PlanStage& stage, Attributes& one) {
    one["name"] = stage.name;
    one["seconds"] = stage.seconds;
    one["evaluations"] = stage.evaluations;
    one["note"] = stage.note;
  });
}

nb::typed<nb::list, Attributes> searches(const PyMotionPlan& plan) {
  return dictsOf(plan.searches, [](const SearchReport& search, Attributes& one) {
    one["samples"] = search.samples;
    one["evaluations"] = search.evaluations;
    one["start_nodes"] = search.start_nodes;
    one["goal_nodes"] = search.goal_nodes;
  });
}

/// Configurations and parents of both trees.
nb::typed<nb::list, nb::typed<nb::tuple, Array, IdArray>> trees(const PyMotionPlan& plan) {
  nb::list list;
  for (const SearchTree& tree : plan.trees) {
    const std::size_t n = plan.space ? std::size_t(plan.space->dofs()) : 0, count = std::size_t(tree.size());
    const NewArray q = newArray(count, n), parents = newArray(count);
    for (int i = 0; i < tree.size(); ++i) {
      std::copy_n(tree.q(i).data(), n, q.data + std::size_t(i) * n);
      parents.data[i] = tree.node(i).parent;
    }
    list.append(nb::make_tuple(q.array, parents.array.attr("astype")("int32")));
  }
  return list;
}

nb::typed<nb::list, Attributes> obstaclesOf(const PyMotionPlan& plan) {
  return dictsOf(plan.obstacles, [](const MetObstacle& met, Attributes& one) {
    one["name"] = met.name;
    one["share"] = met.share;
    one["by"] = met.by;
  });
}

PyConfig planPictureIn(const PyMotionPlan& plan, const PyConfig& config, const std::optional<FrameNames>& frames) {
  return PyConfig{plan.picture(config, frames ? toNames(*frames) : std::vector<std::string>()), nullptr};
}

int viewPlan(const PyMotionPlan& plan, PyConfig& config, const std::optional<FrameNames>& frames, bool pause) {
  const Config shown(planPictureIn(plan, config, frames));
  if (!plan.feasible()) return viewOnPage(config, shown, pause, inPython(plan.message));
  return playOnPage(config, shown, shownPlan(plan, shown), pause, plan.str());
}

/// Without a scene, notebooks show the text.
std::optional<std::string> planPage(const PyMotionPlan& plan) {
  if (!plan.config) return std::nullopt;
  const Config shown = plan.picture(*plan.config);
  const std::optional<ShownMotion> motion = plan.feasible() ? std::optional(shownPlan(plan, shown)) : std::nullopt;
  return notebookPage(shown, motion ? &*motion : nullptr, "MotionPlan", inPython(plan.str()));
}

Array refined(MatrixXd (*refine)(const Config&, const MatrixXd&, const RefineOptions&), const PyConfig& config,
              const Numbers& path, double margin, double blend, std::uint64_t seed) {
  const MatrixXd rows = path.matrix();
  MatrixXd result;
  {
    const nb::gil_scoped_release unlock;
    result = refine(config, rows, {margin, blend, seed, CheckInterrupts()});
  }
  return toNumpy(result);
}

nb::class_<MotionConstraint> bindConstraint(nb::module_& m) {
  return nb::class_<MotionConstraint>(m, "MotionConstraint", docs::plan::constraint)
      .def(
          "__init__",
          [](MotionConstraint* self, const FeatureArgument& feature, const FrameNames& frames, ObjectiveType type,
             const std::optional<Numbers>& scale, const std::optional<Numbers>& target) {
            new (self) MotionConstraint{feature.source(), toNames(frames), type, toScale(scale), toTarget(target)};
          },
          "feature"_a, "frames"_a, "type"_a = ObjectiveType::eq, "scale"_a = nb::none(), "target"_a = nb::none(),
          docs::plan::makeConstraint)
      .def("__repr__", [](const MotionConstraint& c) {
        return cat("<MotionConstraint ", c.feature.name(), "(", join(c.frames), ")>");
      });
}

void bindUnseenPlace(nb::module_& m) {
  nb::class_<UnseenPlace>(m, "UnseenPlace",
                          "The first place on the way to a goal that is blocked only because no camera has seen it.")
      .def_prop_ro(
          "position", [](const UnseenPlace& p) { return toNumpy(VectorXd(p.position)); },
          "Middle of the first unseen cell in the way, shape (3,), m.")
      .def_ro("frame", &UnseenPlace::frame, "The name of the shape that would enter it.")
      .def_prop_ro(
          "q", [](const UnseenPlace& p) { return toNumpy(p.q); },
          "Configuration of the motion that would be possible if unseen cells were free, shape (n,).")
      .def_ro("depth", &UnseenPlace::depth, "Depth of the deepest of these cells in unseen space, to within a cell, m.")
      .def_prop_ro(
          "cells",
          [](const UnseenPlace& p) {
            MatrixXd cells(Eigen::Index(p.cells.size()), 3);
            for (Eigen::Index i = 0; i < cells.rows(); ++i) cells.row(i) = p.cells[std::size_t(i)].transpose();
            return toNumpy(cells);
          },
          "Middles of all unseen cells that it enters, shape (k, 3), m; the first ones first.")
      .def("__repr__", [](const UnseenPlace& p) { return cat("<UnseenPlace: ", p.str(), ">"); });
}

MotionPlanClass bindMotionPlan(nb::module_& m) {
  bindUnseenPlace(m);
  nb::enum_<PlanStatus> status(m, "PlanStatus", "The outcome of planMotion.");
  for (int i = 0; i <= int(PlanStatus::cancelled); ++i) {
    static std::vector<std::string> names(std::size_t(PlanStatus::cancelled) + 1);
    names[std::size_t(i)] = planStatusName(PlanStatus(i));
    status.value(names[std::size_t(i)].c_str(), PlanStatus(i));
  }
  static const std::string replan_signature =
      cat("def replan(self, config: Config, at: float, goal: typing.Any = None, *, ", planArguments(PlanCall::replan),
          ") -> MotionPlan");
  return MotionPlanClass(m, "MotionPlan", docs::plan::type)
      .def_prop_ro("feasible", &MotionPlan::feasible, "True if there is a motion; it is continuously collision-free.")
      .def_ro("status", &MotionPlan::status, "The outcome, a PlanStatus.")
      .def_prop_ro(
          "message", [](const PyMotionPlan& p) { return inPython(p.message); },
          "\"\" if there is a motion, else why there is none.")
      .def_ro("warnings", &MotionPlan::warnings,
              "Caveats of the motion, such as a start in contact: a list of sentences.")
      .def_ro(
          "blockedByUnseen", &MotionPlan::blockedByUnseen,
          "What an OccupancyMap has not seen and what alone prevents the motion, an UnseenPlace. None if there is a\n"
          "motion, or if there is none either with all unseen cells free.")
      .def_prop_ro(
          "path", [](const PyMotionPlan& p) { return toNumpy(p.path); },
          "The configurations of the path from start to goal, shape (K, n), rad or m.")
      .def_prop_ro(
          "raw_path", [](const PyMotionPlan& p) { return toNumpy(p.raw_path); },
          "The path before shortcutting, shape (L, n).")
      .def_prop_ro(
          "times", [](const PyMotionPlan& p) { return toNumpy(p.times()); },
          "Times at which the motion passes the configurations of the path, or is nearest to them at rounded corners, "
          "shape (K,), s.")
      .def_ro("length", &MotionPlan::length, "Length of the path, Euclidean in q.")
      .def_ro("goal", &MotionPlan::goal, "Index of the goal configuration that was reached; -1 without a motion.")
      .def_ro("margin", &MotionPlan::margin, "Distance that all pairs keep but around endpoints that keep less, m.")
      .def_prop_ro("stages", stages,
                   "Statistics of each stage: dicts of name, seconds, evaluations, note. The seconds add up to those "
                   "of the call.")
      .def_prop_ro(
          "trees", trees,
          "Trees of the last search, from the start and from the goals: configurations (N, n), and the index of "
          "each one's parent (N,).")
      .def_prop_ro("searches", searches,
                   "Statistics of each tree search: dicts of samples, evaluations, start_nodes, goal_nodes.")
      .def("obstaclesAt", obstaclesAt, "t"_a, docs::plan::obstaclesAt)
      .def("replan", replan, "config"_a, "at"_a, "goal"_a = nb::none(), "options"_a, nb::sig(replan_signature.c_str()),
           cat(docs::plan::replan, planArgumentDocs(PlanCall::replan), docs::plan::replanRest).c_str())
      .def("clearance", &MotionPlan::clearance, "max_distance"_a = .1, docs::plan::clearance)
      .def(
          "explain", [](const PyMotionPlan& p) { return inPython(p.explain()); },
          "Several lines: the outcome, the stages, the sizes of the trees, and the clearance.")
      .def_prop_ro(
          "obstacles", obstaclesOf,
          "If no path was found, the obstacles that most edges collided with: dicts of name, share, by (frames "
          "that collided with it), the most frequent first.")
      .def("picture", planPictureIn, "config"_a, "frames"_a = nb::none(),
           cat(docs::plan::picture, lines::frames, lines::returnsPicture, lines::raises).c_str())
      .def("view", viewPlan, "config"_a, "frames"_a = nb::none(), "pause"_a = false,
           cat(docs::plan::view, lines::frames, docs::plan::viewRest, lines::raises).c_str())
      .def("__bool__", &MotionPlan::feasible)
      .def("_repr_html_", planPage, "Returns a page for notebooks that plays the motion without a running program.")
      .def("__repr__", [](const PyMotionPlan& p) { return cat("<MotionPlan ", inPython(p.str()), ">"); });
}

}  // namespace

std::vector<MotionConstraint> planConstraintsOf(nb::handle value) {
  std::vector<MotionConstraint> all;
  if (nb::isinstance<MotionConstraint>(value)) return {nb::cast<MotionConstraint>(value)};
  if (!nb::try_cast(value, all))
    throw ValueError(
        "planMotion: constraints are not a list of MotionConstraint, as in "
        "[ry.MotionConstraint(ry.FS.vectorZ, ['glass'], target=[0, 0, 1])]");
  return all;
}

void bindPlan(nb::module_& m) {
  nb::class_<MotionConstraint> constraint = bindConstraint(m);
  MotionPlanClass motion_plan = bindMotionPlan(m);
  bindPlanCopies(constraint, motion_plan);
  const std::string head = "(config: Config, goal: typing.Any, start: numpy.typing.ArrayLike | None = None, *, ";
  static const std::string plan_signature =
      cat("def planMotion", head, planArguments(PlanCall::plan), ") -> MotionPlan");
  static const std::string plans_signature =
      cat("def planMotions", head, planArguments(PlanCall::plans), ") -> MotionPlans");
  m.def("planMotion", plan, "config"_a, "goal"_a.none(), "start"_a = nb::none(), "options"_a,
        nb::sig(plan_signature.c_str()),
        cat(docs::plan::planMotion, planArgumentDocs(PlanCall::plan), docs::plan::planMotionRest).c_str());
  nb::class_<PyMotionPlans>(m, "MotionPlans", "The iterator of MotionPlans that planMotions returns.")
      .def(
          "__iter__", [](nb::handle self) { return nb::borrow(self); },
          nb::sig("def __iter__(self) -> collections.abc.Iterator[MotionPlan]"))
      .def("__next__", nextMotionPlan);
  m.def("planMotions", plans, "config"_a, "goal"_a.none(), "start"_a = nb::none(), "options"_a,
        nb::sig(plans_signature.c_str()),
        cat(docs::plan::planMotions, planArgumentDocs(PlanCall::plans), docs::plan::planMotionsRest).c_str());
  m.def(
      "shortcut",
      [](const PyConfig& config, const Numbers& path, double margin, std::uint64_t seed) {
        return refined(shortcut, config, path, margin, 0., seed);
      },
      "config"_a, "path"_a, "margin"_a = 0., "seed"_a = 0, docs::plan::shortcut);
  m.def(
      "smooth",
      [](const PyConfig& config, const Numbers& path, double margin, double blend) {
        return refined(smooth, config, path, margin, blend, 0);
      },
      "config"_a, "path"_a, "margin"_a = 0., "blend"_a = .05, docs::plan::smooth);
}

}  // namespace kinegraph::python
