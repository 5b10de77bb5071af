#include "task_planning/bind_tasks.h"

#include <nanobind/stl/map.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include "arguments.h"
#include "bindings.h"
#include "kinegraph/task_planning/task_actions.h"
#include "task_planning/py_manipulation.h"
#include "task_planning/task_objects.h"
#include "task_planning/tasks_docs.h"

namespace kinegraph::python {

namespace {

using Words = std::vector<std::string>;

/// A function that any thread may copy and destroy.
std::shared_ptr<const nb::callable> shared(const nb::callable& function) {
  return {new nb::callable(function), [](const nb::callable* owned) {
            const nb::gil_scoped_acquire lock;
            delete owned;
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

void bindRule(nb::module_& m) {
  nb::class_<PyTaskRule>(
      m, "TaskRule",
      "The geometric meaning of an action of planTask: the constraints of its waypoints, and its variants.")
      .def(
          "__init__",
          [](PyTaskRule* self, nb::callable add, nb::callable variants) {
            new (self) PyTaskRule{std::move(add), std::move(variants)};
          },
          "add"_a, "variants"_a,
          nb::sig("def __init__(self, add: collections.abc.Callable[[TaskWaypoints, float, list[str], str], None], "
                  "variants: collections.abc.Callable[[Config, list[str]], list[str]]) -> None"),
          docs::tasks::makeRule)
      .def_ro("add", &PyTaskRule::add, "The function that adds the constraints of the action.")
      .def_ro("variants", &PyTaskRule::variants, "The function that names the variants of the action.")
      .def("__getstate__", [](const PyTaskRule& rule) { return nb::make_tuple(rule.add, rule.variants); })
      .def(
          "__setstate__",
          [](PyTaskRule& rule, const nb::tuple& state) {
            new (&rule) PyTaskRule{nb::cast<nb::callable>(state[0]), nb::cast<nb::callable>(state[1])};
          },
          "state"_a);
}

std::shared_ptr<TaskWaypoints> waypointsOf(const PyConfig& C, const std::vector<TaskAction>& actions,
                                           const Words& variants, const PyTaskRules& own) {
  TaskRules rules = taskRules(own);
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
      m, "TaskWaypoints",
      "The waypoint problem of a sequence of actions in one variant each: a KOMO with a slice per action.")
      .def(nb::new_([](const PyConfig& C, const std::vector<TaskAction>& actions, const Words& variants,
                       const PyTaskRules& rules) { return waypointsOf(C, actions, variants, rules); }),
           "C"_a, "actions"_a, "variants"_a, "rules"_a = nb::none(), docs::tasks::makeWaypoints)
      .def_prop_ro(
          "C", [](const TaskWaypoints& w) { return sameScene(w.C); }, "The scene.")
      .def_ro("actions", &TaskWaypoints::actions, "The actions, each a list of words.")
      .def_ro("variants", &TaskWaypoints::variants, "The variant of each action.")
      .def_prop_ro("m", helperOf, nb::sig("def m(self) -> KOMO_ManipulationHelper"),
                   "A KOMO_ManipulationHelper for the problem.")
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

}  // namespace

PyConfig sameScene(const Config& C) { return PyConfig{Config(C.scene()), nullptr}; }

TaskRules taskRules(const PyTaskRules& own) {
  TaskRules rules;
  if (own)
    for (const auto& [name, rule] : *own) rules[name] = ruleOf(rule);
  return rules;
}

void bindTasks(nb::module_& m) {
  bindRule(m);
  bindWaypoints(m);
  bindTaskExecution(m);
  bindTaskPlan(m);
  bindPlanTask(m);
  bindLgp(m);
  m.def(
      "doorStates", [](const PyConfig& C) { return doorStates(C); }, "C"_a, docs::tasks::doorStates);
  m.def("defaultDomain", defaultDomain, docs::tasks::defaultDomain);
}

}  // namespace kinegraph::python
