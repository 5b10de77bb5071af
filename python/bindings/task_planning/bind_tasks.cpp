#include "task_planning/bind_tasks.h"

#include <nanobind/stl/map.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include "arguments.h"
#include "bindings.h"
#include "kinegraph/common/text.h"
#include "kinegraph/logic/fol_reader.h"
#include "kinegraph/task_planning/search/check_task_plan.h"
#include "kinegraph/task_planning/search/motion_checks.h"
#include "kinegraph/task_planning/search/plan_task.h"
#include "python_names.h"
#include "task_planning/py_manipulation.h"
#include "task_planning/task_objects.h"
#include "task_planning/tasks_docs.h"

namespace kinegraph::python {

namespace {

using Words = std::vector<std::string>;

Words texts(const std::vector<Literal>& literals) {
  Words out;
  for (const Literal& literal : literals) out.push_back(literal.str());
  return out;
}

std::vector<Literal> literalsOf(const Words& words) { return readLiterals(join(words, " "), "literals"); }

// --- rules -------------------------------------------------------------------------------------------------------------

/// A TaskRule whose parts are functions of the user's.
struct PyTaskRule {
  nb::callable add, variants;
};

/// A function that any thread may hold and let go of.
std::shared_ptr<const nb::callable> shared(const nb::callable& function) {
  return {new nb::callable(function), [](const nb::callable* kept) {
            const nb::gil_scoped_acquire lock;
            delete kept;
          }};
}

TaskRule ruleOf(const PyTaskRule& rule) {
  return {
      [add = shared(rule.add)](TaskWaypoints& w, double time, const TaskAction& action, const std::string& variant) {
        const nb::gil_scoped_acquire lock;
        (*add)(nb::cast(w.shared_from_this()), time, action, variant);
      },
      [variants = shared(rule.variants)](const Config& C, const TaskAction& action) {
        const nb::gil_scoped_acquire lock;
        return nb::cast<Words>((*variants)(nb::cast(PyConfig{Config(C), nullptr}), action));
      }};
}

using MaybeRules = std::optional<std::map<std::string, PyTaskRule>>;

TaskRules rulesOf(const MaybeRules& given) {
  TaskRules rules;
  if (given)
    for (const auto& [name, rule] : *given) rules[name] = ruleOf(rule);
  return rules;
}

void bindRule(nb::module_& m) {
  nb::class_<PyTaskRule>(m, "TaskRule",
                         "An action of planTask: what it asks of the waypoints, and in which ways it can be done.")
      .def(
          "__init__",
          [](PyTaskRule* self, nb::callable add, nb::callable variants) {
            new (self) PyTaskRule{std::move(add), std::move(variants)};
          },
          "add"_a, "variants"_a,
          nb::sig("def __init__(self, add: collections.abc.Callable[[TaskWaypoints, float, list[str], str], None], "
                  "variants: collections.abc.Callable[[Config, list[str]], list[str]]) -> None"),
          docs::tasks::makeRule)
      .def_ro("add", &PyTaskRule::add, "Adds what the action asks.")
      .def_ro("variants", &PyTaskRule::variants, "Names the ways in which it can be done.");
}

// --- waypoints ---------------------------------------------------------------------------------------------------------

std::shared_ptr<TaskWaypoints> waypointsOf(const PyConfig& C, const std::vector<TaskAction>& actions,
                                           const Words& variants, const MaybeRules& given) {
  TaskRules rules = rulesOf(given);
  rules.merge(defaultTaskRules());
  return makeTaskWaypoints(C, actions, variants, rules, std::make_shared<PyManipulation>());
}

nb::object helperOf(const TaskWaypoints& w) {
  const nb::object helper = nb::module_::import_("kinegraph.manipulation").attr("KOMO_ManipulationHelper")();
  helper.attr("komo") = std::static_pointer_cast<PyKomo>(w.m->komo);
  return helper;
}

Array startOf(const TaskWaypoints& w, std::optional<std::uint64_t> seed, bool grasps) {
  Rng rng(seed.value_or(0));
  return toNumpy(w.start(seed ? &rng : nullptr, grasps));
}

void bindWaypoints(nb::module_& m) {
  nb::class_<TaskWaypoints>(
      m, "TaskWaypoints", "The waypoint problem of a sequence of actions, in one variant of each: a slice per action.")
      .def(nb::new_([](const PyConfig& C, const std::vector<TaskAction>& actions, const Words& variants,
                       const MaybeRules& rules) { return waypointsOf(C, actions, variants, rules); }),
           "C"_a, "actions"_a, "variants"_a, "rules"_a = nb::none(), docs::tasks::makeWaypoints)
      .def_prop_ro(
          "C", [](const TaskWaypoints& w) { return sameScene(w.C); }, "The scene.")
      .def_ro("actions", &TaskWaypoints::actions, "The words of each action.")
      .def_ro("variants", &TaskWaypoints::variants, "In which way each is done.")
      .def_prop_ro("m", helperOf, nb::sig("def m(self) -> KOMO_ManipulationHelper"),
                   "A KOMO_ManipulationHelper on the problem.")
      .def_prop_ro(
          "komo", [](const TaskWaypoints& w) { return std::static_pointer_cast<PyKomo>(w.m->komo); }, "The problem.")
      .def("attach", &TaskWaypoints::attach, "time"_a, "hand"_a, "obj"_a, "touching"_a = false, "gap"_a = 0.,
           docs::tasks::attach)
      .def("put", &TaskWaypoints::put, "time"_a, "obj"_a, "to"_a, docs::tasks::put)
      .def("lay", &TaskWaypoints::lay, "time"_a, "obj"_a, "to"_a, "face"_a, docs::tasks::lay)
      .def("push", &TaskWaypoints::push, "start"_a, "end"_a, "pusher"_a, "obj"_a, "to"_a, docs::tasks::push)
      .def("guide", &TaskWaypoints::guide, "time"_a, "door"_a, "handle"_a, "hand"_a, "opens"_a, docs::tasks::guide)
      .def("start", startOf, "seed"_a = nb::none(), "grasps"_a = true, docs::tasks::start);
}

// --- plans -------------------------------------------------------------------------------------------------------------

nb::object orNone(const MatrixXd& rows) { return rows.size() == 0 ? nb::none() : nb::object(toNumpy(rows)); }

nb::list branchesOf(const TaskPlan& plan, nb::handle module) {
  nb::list list;
  for (const TaskBranch& branch : plan.tree) {
    nb::object ghost = nb::none();
    if (branch.ghost) ghost = nb::cast(PyConfig{Config(*branch.ghost), nullptr});
    list.append(module.attr("Branch")(branch.actions, branch.why, ghost));
  }
  return list;
}

/// As kinegraph.TaskPlan.
nb::object toPython(TaskPlan plan) {
  const nb::module_ module = nb::module_::import_("kinegraph.task_plan");
  nb::dict fields;
  fields["actions"] = plan.actions;
  fields["waypoints"] = orNone(plan.waypoints);
  fields["path"] = orNone(plan.path);
  fields["times"] = plan.times.size() == 0 ? nb::none() : nb::object(toNumpy(plan.times));
  fields["limits"] = orNone(plan.limits);
  nb::list segments, scenes;
  for (const RowRange& rows : plan.segments) segments.append(nb::slice(rows.begin, rows.end));
  for (Config& scene : plan.scenes) scenes.append(nb::cast(PyConfig{std::move(scene), nullptr}));
  fields["segments"] = segments;
  fields["scenes"] = scenes;
  fields["causes"] = plan.causes;
  fields["tree"] = branchesOf(plan, module);
  fields["violations"] = plan.violations;
  fields["evaluations"] = plan.evaluations;
  fields["expansions"] = plan.expansions;
  fields["attachments"] = plan.attachments;
  fields["goal"] = texts(plan.goal);
  fields["start"] = texts(plan.start);
  fields["again"] = nb::cpp_function([again = plan.again](const PyConfig& scene) {
    TaskPlan next;
    {
      const nb::gil_scoped_release unlock;
      next = again(scene);
    }
    return toPython(std::move(next));
  });
  return module.attr("TaskPlan")(taskStatusName(plan.status), inPython(plan.message), **fields);
}

}  // namespace

PyConfig sameScene(const Config& C) { return PyConfig{Config(C.scene()), nullptr}; }

TaskPlan taskPlanOf(nb::handle given) {
  TaskPlan plan;
  plan.message = nb::cast<std::string>(given.attr("message"));
  plan.actions = nb::cast<std::vector<TaskAction>>(given.attr("actions"));
  const auto numbers = [&](const char* name) {
    const nb::object value = given.attr(name);
    return value.is_none() ? Numbers() : nb::cast<Numbers>(value);
  };
  plan.path = numbers("path").matrix();
  plan.times = numbers("times").values;
  const Numbers limits = numbers("limits");
  if (limits.values.size() > 0) plan.limits = limits.matrix();
  for (const nb::handle rows : given.attr("segments"))
    plan.segments.push_back({nb::cast<Eigen::Index>(rows.attr("start")), nb::cast<Eigen::Index>(rows.attr("stop"))});
  plan.goal = literalsOf(nb::cast<Words>(given.attr("goal")));
  plan.start = literalsOf(nb::cast<Words>(given.attr("start")));
  for (const nb::handle scene : given.attr("scenes")) plan.scenes.push_back(nb::cast<const PyConfig&>(scene));
  for (const nb::handle branch : given.attr("tree")) {
    std::shared_ptr<const Config> ghost;
    if (!branch.attr("ghost").is_none())
      ghost = std::make_shared<const Config>(nb::cast<const PyConfig&>(branch.attr("ghost")));
    plan.tree.push_back({nb::cast<std::vector<TaskAction>>(branch.attr("actions")),
                         nb::cast<std::string>(branch.attr("why")), std::move(ghost)});
  }
  return plan;
}

namespace {

Words checkPlan(const PyConfig& C, nb::handle given, const std::optional<std::vector<Words>>& states) {
  const TaskPlan plan = taskPlanOf(given);
  std::vector<std::vector<Literal>> along;
  if (states)
    for (const Words& state : *states) along.push_back(literalsOf(state));
  warnOfContacts(C);
  const Config scene(C);
  const nb::gil_scoped_release unlock;
  return checkTaskPlan(scene, plan, along);
}

/// Plans, and the scene that they are for.
struct PyTaskPlans {
  PyConfig scene;
  TaskPlans plans;
};

/// The arguments of planTask and planTasks.
PyTaskPlans plansOf(const PyConfig& C, const std::string& goal, const std::optional<LogicDomain>& domain,
                    const MaybeRules& rules, std::optional<double> seconds, long evaluations, std::uint64_t seed,
                    const std::optional<Numbers>& velocity, const std::optional<Numbers>& acceleration, int threads) {
  TaskOptions options;
  options.domain = domain;
  options.rules = rulesOf(rules);
  if (seconds) options.seconds = *seconds;
  options.evaluations = evaluations;
  options.seed = seed;
  if (velocity) options.velocity = velocity->values;
  if (acceleration) options.acceleration = acceleration->values;
  options.threads = threads;
  options.cancellation = [check = CheckInterrupts()]() mutable { check(); };
  options.helper = [] { return std::make_shared<PyManipulation>(); };
  PyConfig scene{Config(C), nullptr};
  const nb::gil_scoped_release unlock;
  TaskPlans plans(scene, goal, options);
  return {std::move(scene), std::move(plans)};
}

nb::object nextOf(PyTaskPlans& self) {
  std::optional<TaskPlan> plan;
  {
    const nb::gil_scoped_release unlock;
    plan = self.plans.next();
  }
  if (plan && !plan->actions.empty()) warnOfContacts(self.scene);
  return plan ? toPython(std::move(*plan)) : nb::object();
}

void bindPlanTask(nb::module_& m) {
  nb::class_<PyTaskPlans>(m, "TaskPlans", "Plans that get better while one waits; planTasks makes them.")
      .def(
          "__iter__", [](nb::handle plans) { return nb::borrow(plans); }, nb::sig("def __iter__(self) -> TaskPlans"),
          "Itself.")
      .def(
          "__next__",
          [](PyTaskPlans& plans) {
            nb::object plan = nextOf(plans);
            if (!plan.is_valid()) throw nb::stop_iteration();
            return plan;
          },
          nb::sig("def __next__(self) -> TaskPlan"), "The next plan.");
  const auto bind = [&](const char* name, auto call, const char* returned, const char* doc) {
    const std::string signature =
        cat("def ", name,
            "(C: Config, goal: str, domain: Domain | None = None, rules: collections.abc.Mapping[str, TaskRule] | None "
            "= None, "
            "seconds: float | None = None, evaluations: int = 200000, seed: int = 0, velocity: numpy.typing.ArrayLike "
            "| None "
            "= None, acceleration: numpy.typing.ArrayLike | None = None, threads: int = 1) -> ",
            returned);
    m.def(name, call, "C"_a, "goal"_a, "domain"_a = nb::none(), "rules"_a = nb::none(), "seconds"_a = nb::none(),
          "evaluations"_a = 200000, "seed"_a = 0, "velocity"_a = nb::none(), "acceleration"_a = nb::none(),
          "threads"_a = 1, nb::sig(signature.c_str()), doc);
  };
  const auto first = []<class... Arguments>(PyTaskPlans (*plans)(Arguments...)) {
    return [plans](Arguments... arguments) {
      PyTaskPlans all = plans(arguments...);
      return nextOf(all);
    };
  };
  bind("planTask", first(plansOf), "TaskPlan", docs::tasks::planTask);
  bind("planTasks", plansOf, "TaskPlans", docs::tasks::planTasks);
}

}  // namespace

void bindTasks(nb::module_& m) {
  bindRule(m);
  bindWaypoints(m);
  bindPlanTask(m);
  bindTaskPlays(m);
  bindLgp(m);
  m.def("checkTaskPlan", checkPlan, "C"_a, "plan"_a, "states"_a = nb::none(),
        nb::sig("def checkTaskPlan(C: Config, plan: TaskPlan, states: "
                "collections.abc.Sequence[collections.abc.Sequence[str]] | None = None) -> list[str]"),
        docs::tasks::checkTaskPlan);
  m.def(
      "cornersOf", [](const Numbers& path) { return toNumpy(cornersOf(path.matrix())); }, "path"_a,
      docs::tasks::cornersOf);
  m.def(
      "treeText",
      [](const std::vector<std::pair<std::vector<TaskAction>, std::string>>& branches) {
        std::vector<TaskBranch> tree;
        for (const auto& [actions, why] : branches) tree.push_back({actions, why, nullptr});
        return treeText(tree);
      },
      "branches"_a, docs::tasks::treeText);
  m.def(
      "holderOf", [](const PyConfig& C, const std::string& obj, const Words& hands) { return holderOf(C, obj, hands); },
      "C"_a, "obj"_a, "hands"_a, docs::tasks::holderOf);
  m.def(
      "doorStates",
      [](const PyConfig& C) {
        std::map<std::string, std::string> states;
        for (const TaskDoor& door : doorsOf(C)) states[door.name] = door.stateAt(C.getJointState()[door.dof]);
        return states;
      },
      "C"_a, docs::tasks::doorStates);
  m.def("defaultDomain", defaultDomain, docs::tasks::defaultDomain);
}

}  // namespace kinegraph::python
