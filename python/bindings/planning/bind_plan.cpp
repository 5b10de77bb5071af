#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/unique_ptr.h>
#include <nanobind/stl/variant.h>
#include <nanobind/stl/vector.h>

#include "features/feature_arguments.h"
#include "ik/ik_targets.h"
#include "kinegraph/planning/refine_path.h"
#include "planning/path_lines_docs.h"
#include "planning/plan_docs.h"
#include "planning/plan_objects.h"
#include "python_names.h"

namespace kinegraph::python {

namespace {

namespace lines = docs::path_lines;

/// A number per dof, or one for all.
VectorXd limitOf(const char* name, nb::handle given) {
  Numbers numbers;
  if (!readNumbers(given, numbers) || numbers.rank > 1)
    throw ValueError(cat("planMotion: ", name, " is ", nb::cast<std::string>(nb::repr(given)),
                         "; expected a number, or one per joint"));
  return numbers.values;
}

std::vector<MotionConstraint> constraintsOf(nb::handle given) {
  std::vector<MotionConstraint> all;
  if (nb::isinstance<MotionConstraint>(given)) return {nb::cast<MotionConstraint>(given)};
  if (!nb::try_cast(given, all))
    throw ValueError(
        "planMotion: constraints are not a list of MotionConstraint, as in "
        "[ry.MotionConstraint(ry.FS.vectorZ, ['glass'], target=[0, 0, 1])]");
  return all;
}

/// A dict: frame -> (times, values).
std::vector<ObstacleTrajectory> movingOf(nb::handle given) {
  constexpr const char* kExpected =
      "expected a dict of frame -> (times, values), with values of shape (K, 7), poses, or (K, d), positions of its "
      "joint";
  if (!nb::isinstance<nb::dict>(given))
    throw ValueError(cat("planMotion: moving is ", nb::cast<std::string>(nb::repr(given)), "; ", kExpected));
  std::vector<ObstacleTrajectory> all;
  for (const auto& [key, value] : nb::borrow<nb::dict>(given)) {
    std::string frame;
    std::vector<nb::object> parts;
    Numbers times, values;
    const bool fits = nb::try_cast(key, frame) && nb::try_cast(value, parts) && parts.size() == 2 &&
                      readNumbers(parts[0], times) && times.rank == 1 && readNumbers(parts[1], values) &&
                      values.rank == 2;
    if (!fits) throw ValueError(cat("planMotion: moving[", nb::cast<std::string>(nb::repr(key)), "]: ", kExpected));
    all.push_back({frame, times.values, values.matrix()});
  }
  return all;
}

/// Options that are no single number.
void setLarge(const OptionClass<PlanOptions>&, PlanOptions& options, const std::string& name, nb::handle value) {
  if (name == "constraints") {
    options.constraints = constraintsOf(value);
  } else if (name == "obstacle_trajectories") {
    options.obstacle_trajectories = value.is_none() ? std::vector<ObstacleTrajectory>() : movingOf(value);
  } else if (!value.is_none()) {
    VectorXd PlanOptions::*const member = name == "velocity"         ? &PlanOptions::velocity
                                          : name == "acceleration"   ? &PlanOptions::acceleration
                                          : name == "jerk"           ? &PlanOptions::jerk
                                          : name == "start_velocity" ? &PlanOptions::start_velocity
                                                                     : &PlanOptions::start_acceleration;
    options.*member = limitOf(name.c_str(), value);
  }
}

PlanOptions optionsFrom(nb::kwargs given, PlanOptions options = {}) {
  planOptionClass().setFields(options, given);
  return options;
}

std::vector<VectorXd> configurationsOf(const Numbers& numbers) {
  if (numbers.rank == 1) return {numbers.values};
  std::vector<VectorXd> rows;
  const MatrixXd matrix = numbers.matrix();
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) rows.push_back(matrix.row(i).transpose());
  return rows;
}

MotionGoal goalOf(const PyConfig& config, nb::handle given) {
  Numbers numbers;
  if (nb::isinstance<nb::str>(given)) return MotionGoal::named(nb::cast<std::string>(given));
  if (nb::isinstance<nb::dict>(given)) {
    IkRequest request = readIkTargets(config, given);
    if (request.is_batch) throw ValueError("planMotion: the goal has several rows of targets; expected one of each");
    return MotionGoal(std::move(request.problems[0]));
  }
  std::vector<MotionConstraint> conditions;
  if (nb::isinstance<MotionConstraint>(given)) return MotionGoal(constraintsOf(given));
  if (nb::try_cast(given, conditions) && !conditions.empty()) return MotionGoal(std::move(conditions));
  if (readNumbers(given, numbers) && (numbers.rank == 1 || numbers.rank == 2) && numbers.values.size() > 0)
    return MotionGoal(configurationsOf(numbers));
  throw ValueError(cat("planMotion: the goal is ", nb::cast<std::string>(nb::repr(given)),
                       "; expected a joint vector or several, a dict of targets as for solveIk, the name of a joint "
                       "state, or MotionConstraints"));
}

PyMotionPlan plan(const PyConfig& config, nb::handle goal, const std::optional<Numbers>& start, nb::kwargs fields) {
  const PlanOptions options = optionsFrom(fields);
  const MotionGoal to = goalOf(config, goal);
  const std::optional<VectorXd> from = start ? std::optional(start->values) : std::nullopt;
  const auto scene = std::make_shared<const Config>(config);  // as it is now
  const nb::gil_scoped_release unlock;
  CheckInterrupts check;
  return {planMotion(*scene, to, options, from,
                     [&] {
                       check();
                       return false;
                     }),
          scene};
}

PyMotionPlan replan(const PyMotionPlan& running, const PyConfig& config, double at, nb::handle goal,
                    nb::kwargs fields) {
  const PlanOptions options = optionsFrom(fields, running.optionsAt(at));
  const std::optional<MotionGoal> to = goal.is_none() ? std::nullopt : std::optional(goalOf(config, goal));
  const auto scene = std::make_shared<const Config>(config);
  const nb::gil_scoped_release unlock;
  CheckInterrupts check;
  return {running.replan(*scene, at, to, options,
                         [&] {
                           check();
                           return false;
                         }),
          scene};
}

std::unique_ptr<PyMotionPlans> plans(const PyConfig& config, nb::handle goal, const std::optional<Numbers>& start,
                                     nb::kwargs fields) {
  const auto scene = std::make_shared<const Config>(config);
  return std::unique_ptr<PyMotionPlans>(
      new PyMotionPlans{scene, MotionPlans(*scene, goalOf(config, goal), optionsFrom(fields),
                                           start ? std::optional(start->values) : std::nullopt)});
}

PyMotionPlan nextMotionPlan(PyMotionPlans& plans) {
  std::optional<MotionPlan> plan;
  {
    const nb::gil_scoped_release unlock;
    CheckInterrupts check;
    plan = plans.plans.next([&] {
      check();
      return false;
    });
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

nb::typed<nb::tuple, Array, Array, Array> at(const PyMotionPlan& plan, double t) {
  const MotionState state = plan.at(t);
  return nb::make_tuple(toNumpy(state.q), toNumpy(state.velocity), toNumpy(state.acceleration));
}

/// A dict per entry, filled by `tell(entry, dict)`.
template <class Entry, class Tell>
nb::typed<nb::list, Attributes> dictsOf(const std::vector<Entry>& entries, const Tell& tell) {
  nb::list list;
  for (const Entry& entry : entries) {
    Attributes one;
    tell(entry, one);
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

/// Postures and parents of both trees.
nb::typed<nb::list, nb::typed<nb::tuple, Array, IdArray>> trees(const PyMotionPlan& plan) {
  nb::list list;
  for (const MotionTree& tree : plan.trees) {
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

int viewPlan(const PyMotionPlan& plan, const PyConfig& config, const std::optional<FrameNames>& frames, bool pause) {
  const nb::object shown = nb::cast(planPictureIn(plan, config, frames));
  if (!plan.feasible()) return nb::cast<int>(shown.attr("view")(pause, inPython(plan.message)));
  const double seconds = std::max(plan.options.timing ? plan.duration() : plan.length, 1e-3);
  return nb::cast<int>(shown.attr("view_path")(toNumpy(plan.path), seconds, pause, plan.str()));
}

Array refined(MatrixXd (*refine)(const Config&, const MatrixXd&, const RefineOptions&), const PyConfig& config,
              const Numbers& path, double margin, double blend, std::uint64_t seed) {
  const MatrixXd rows = path.matrix();
  MatrixXd result;
  {
    const nb::gil_scoped_release unlock;
    CheckInterrupts check;
    result = refine(config, rows, {margin, blend, seed, [&] {
                                     check();
                                     return false;
                                   }});
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

nb::class_<PyMotionPlan> bindMotionPlan(nb::module_& m) {
  nb::enum_<PlanStatus> status(m, "PlanStatus", "How planMotion ended.");
  for (int i = 0; i <= int(PlanStatus::cancelled); ++i) {
    static std::vector<std::string> names(std::size_t(PlanStatus::cancelled) + 1);
    names[std::size_t(i)] = planStatusName(PlanStatus(i));
    status.value(names[std::size_t(i)].c_str(), PlanStatus(i));
  }
  return nb::class_<PyMotionPlan>(m, "MotionPlan", docs::plan::type)
      .def_prop_ro("feasible", &MotionPlan::feasible, "True if there is a motion. It is free at all times.")
      .def_ro("status", &MotionPlan::status, "How it ended, a PlanStatus.")
      .def_prop_ro(
          "message", [](const PyMotionPlan& p) { return inPython(p.message); },
          "\"\" if there is a motion; else why there is none.")
      .def_ro("warnings", &MotionPlan::warnings,
              "Caveats of the motion, such as a start in contact: list of sentences.")
      .def_prop_ro(
          "path", [](const PyMotionPlan& p) { return toNumpy(p.path); },
          "Its postures, shape (K, n), rad or m, start and goal included.")
      .def_prop_ro(
          "raw_path", [](const PyMotionPlan& p) { return toNumpy(p.raw_path); },
          "The path before it was shortened, shape (L, n).")
      .def_prop_ro(
          "times", [](const PyMotionPlan& p) { return toNumpy(p.times()); },
          "When the motion passes these postures, or is nearest to them where corners are rounded, shape (K,), s.")
      .def_prop_ro("duration", &MotionPlan::duration, "s; 0 without a motion.")
      .def_ro("length", &MotionPlan::length, "Of the path, Euclidean in q.")
      .def_ro("goal", &MotionPlan::goal, "Which of several goal postures was reached; -1 without a motion.")
      .def_ro("margin", &MotionPlan::margin, "m, that all pairs keep but around ends that keep less.")
      .def_prop_ro("stages", stages, "What each stage took: dicts of name, seconds, evaluations, note.")
      .def_prop_ro("trees", trees,
                   "Of the last attempt, of start and goals: postures (N, n), and each one's parent (N,).")
      .def("at", at, "t"_a, docs::plan::at)
      .def("obstaclesAt", obstaclesAt, "t"_a, docs::plan::obstaclesAt)
      .def("replan", replan, "config"_a, "at"_a, "goal"_a = nb::none(), "fields"_a,
           nb::sig("def replan(self, config: Config, at: float, goal: typing.Any = None, **fields: typing.Any) -> "
                   "MotionPlan"),
           docs::plan::replan)
      .def("clearance", &MotionPlan::clearance, "most"_a = .1, docs::plan::clearance)
      .def(
          "explain", [](const PyMotionPlan& p) { return inPython(p.explain()); },
          "Several lines: how it ended, what each stage took, how the trees look, and the clearance.")
      .def_prop_ro("obstacles", obstaclesOf,
                   "Where no way was found: what most motions ended at, dicts of name, share, by (frames that ran "
                   "into it), the first one most often.")
      .def("picture", planPictureIn, "config"_a, "frames"_a = nb::none(),
           cat(docs::plan::picture, lines::frames, lines::returnsPicture, lines::raises).c_str())
      .def("view", viewPlan, "config"_a, "frames"_a = nb::none(), "pause"_a = false,
           cat(docs::plan::view, lines::frames, docs::plan::viewRest, lines::raises).c_str())
      .def("__bool__", &MotionPlan::feasible)
      .def("__repr__", [](const PyMotionPlan& p) { return cat("<MotionPlan ", inPython(p.str()), ">"); });
}

}  // namespace

const OptionClass<PlanOptions>& planOptionClass() {
  static const OptionClass<PlanOptions> options(
      planOptionTable(), {{"velocity", "acceleration", "jerk", "start_velocity", "start_acceleration", "constraints",
                           "obstacle_trajectories"},
                          setLarge});
  return options;
}

void bindPlan(nb::module_& m) {
  nb::class_<MotionConstraint> constraint = bindConstraint(m);
  nb::class_<PyMotionPlan> motion_plan = bindMotionPlan(m);
  bindPlanCopies(constraint, motion_plan);
  const std::string doc = cat(docs::plan::planMotion, planOptionClass().docs("        "), docs::plan::planMotionRest);
  m.def(
      "planMotion", plan, "config"_a, "goal"_a.none(), "start"_a = nb::none(), "fields"_a,
      nb::sig("def planMotion(config: Config, goal: typing.Any, start: numpy.typing.ArrayLike | None = None, **fields: "
              "typing.Any) -> MotionPlan"),
      doc.c_str());
  nb::class_<PyMotionPlans>(m, "MotionPlans", "What planMotions gives: MotionPlans, one by one.")
      .def(
          "__iter__", [](nb::handle self) { return nb::borrow(self); },
          nb::sig("def __iter__(self) -> collections.abc.Iterator[MotionPlan]"))
      .def("__next__", nextMotionPlan);
  m.def("planMotions", plans, "config"_a, "goal"_a.none(), "start"_a = nb::none(), "fields"_a,
        nb::sig("def planMotions(config: Config, goal: typing.Any, start: numpy.typing.ArrayLike | None = None, "
                "**fields: typing.Any) -> MotionPlans"),
        docs::plan::planMotions);
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
