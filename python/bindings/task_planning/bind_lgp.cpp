#include <nanobind/stl/optional.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>
#include <nanobind/trampoline.h>

#include "arguments.h"
#include "bindings.h"
#include "defaults.h"
#include "kinegraph/common/errors.h"
#include "kinegraph/common/log.h"
#include "kinegraph/common/text.h"
#include "kinegraph/task_planning/lgp/lgp_tool.h"
#include "logic/logic_objects.h"
#include "python_names.h"
#include "task_planning/lgp_docs.h"
#include "task_planning/py_manipulation.h"
#include "task_planning/task_objects.h"

namespace kinegraph::python {

namespace {

using LgpPlan = std::vector<TaskAction>;

std::shared_ptr<PyKomo> asPython(const std::shared_ptr<Komo>& komo) { return std::static_pointer_cast<PyKomo>(komo); }

/// The value that a method of a Python class returned.
template <class T>
T returnedBy(const char* call, const nb::object& given, const char* expected) {
  try {
    T value = nb::cast<T>(given);
    if constexpr (std::is_same_v<T, std::shared_ptr<PyKomo>>)
      if (!value) throw nb::cast_error();
    return value;
  } catch (const nb::cast_error&) {
    const auto type = nb::cast<std::string>(given.type().attr("__name__"));
    throw ValueError(cat(call, " returned a ", type, "; expected ", expected));
  }
}

std::function<void()> asksForInterrupts() {
  return [check = CheckInterrupts()]() mutable { check(); };
}

void warnOfProblem(Komo& komo) {
  const nb::gil_scoped_acquire lock;
  for (const std::string& warning : komo.takeWarnings()) emitWarning(warning);
}

/// An abstraction for Python: overrides in Python are called, and problems are KOMOs.
template <class Base>
struct PyAbstraction final : Base {
  NB_TRAMPOLINE(Base);
  using KomoPointer = std::shared_ptr<Komo>;

  std::optional<LgpPlan> getNewActionSequence() override {
    std::optional<LgpPlan> plan;
    const bool is_own = callOwn("getNewActionSequence", [&](const nb::object& own) {
      plan = returnedBy<std::optional<LgpPlan>>("getNewActionSequence", own(), "a list of actions, or None");
    });
    return is_own ? plan : Base::getNewActionSequence();
  }
  void forbidBeginning(const LgpPlan& plan) override {
    if (!callOwn("forbidBeginning", [&](const nb::object& own) { own(plan); })) Base::forbidBeginning(plan);
  }
  KomoPointer setup_sequence(const Config& C, int K) override {
    KomoPointer komo;
    return callOwn("setup_sequence", [&](const nb::object& own) { komo = made("setup_sequence", own, C, K); })
               ? komo
               : Base::setup_sequence(C, K);
  }
  KomoPointer setup_motion(const Config& C, int K) override {
    KomoPointer komo;
    return callOwn("setup_motion", [&](const nb::object& own) { komo = made("setup_motion", own, C, K); })
               ? komo
               : Base::setup_motion(C, K);
  }
  void add_action_constraints(const KomoPointer& komo, double time, const TaskAction& before,
                              const TaskAction& action) override {
    if (!callOwn("add_action_constraints", [&](const nb::object& own) { own(asPython(komo), time, before, action); }))
      Base::add_action_constraints(komo, time, before, action);
  }
  void add_action_constraints_motion(const KomoPointer& komo, double time, const TaskAction& before,
                                     const TaskAction& action) override {
    if (!callOwn("add_action_constraints_motion",
                 [&](const nb::object& own) { own(asPython(komo), time, before, action); }))
      Base::add_action_constraints_motion(komo, time, before, action);
  }
  void add_all(const KomoPointer& komo, const LgpPlan& plan, bool motion) override {
    if (callOwn("add_all", [&](const nb::object& own) { own(asPython(komo), plan, motion); })) return;
    Base::add_all(komo, plan, motion);
    warnOfProblem(*komo);
  }
  std::shared_ptr<ManipulationHelper> newHelper() const override { return std::make_shared<PyManipulation>(); }

 private:
  static KomoPointer made(const char* call, const nb::object& own, const Config& C, int K) {
    return returnedBy<std::shared_ptr<PyKomo>>(call, own(sameScene(C), K), "a KOMO");
  }

  /// Calls the override of a Python class with the interpreter lock. False if there is none.
  template <class Call>
  bool callOwn(const char* name, const Call& call) {
    const nb::detail::ticket ticket(this->nb_trampoline, name, nb::detail::str_hash(name), false);
    if (!ticket.key.is_valid()) return false;
    call(nb::object(this->nb_trampoline.base().attr(ticket.key)));
    return true;
  }
};

using Abstraction = LgpAbstraction;
using DefaultAbstraction = DefaultLgpAbstraction;

void makeAbstraction(Abstraction* self, const PyConfig& C) { new (self) PyAbstraction<Abstraction>(C); }

void makeDefault(DefaultAbstraction* self, const PyConfig& C, const PathText& file) {
  new (self) PyAbstraction<DefaultAbstraction>(C, file.text, asksForInterrupts());
}

nb::tuple explicitPairs(const Abstraction& tamp) { return nb::tuple(nb::cast(tamp.explicitCollisions)); }

// Types as subclasses write them.
#define KINEGRAPH_LGP_ADD "(self, komo: KOMO, time: float, prev_action: list[str], action: list[str]) -> None"
constexpr char kAdd[] = "def add_action_constraints" KINEGRAPH_LGP_ADD;
constexpr char kAddMotion[] = "def add_action_constraints_motion" KINEGRAPH_LGP_ADD;
constexpr char kAddAll[] = "def add_all(self, komo: KOMO, plan: list[list[str]], motion: bool) -> None";
constexpr char kForbid[] = "def forbidBeginning(self, plan: list[list[str]]) -> None";
#undef KINEGRAPH_LGP_ADD

// Bound methods call the class itself, not an override, as super() needs it.
void bindAbstraction(nb::module_& m) {
  nb::class_<Abstraction, PyAbstraction<Abstraction>>(m, "LGP_TAMP_Abstraction", nb::dynamic_attr(),
                                                      docs::lgp::abstraction)
      .def("__init__", makeAbstraction, "C"_a, docs::lgp::makeAbstraction)
      .def_prop_ro(
          "C", [](const Abstraction& tamp) { return sameScene(tamp.C); }, "The scene.")
      .def_prop_rw(
          "explicitCollisions", explicitPairs,
          [](Abstraction& tamp, std::vector<std::string> pairs) { tamp.explicitCollisions = std::move(pairs); },
          nb::for_getter(nb::sig("def explicitCollisions(self, /) -> tuple[str, ...]")),
          "Pairs of names of frames that overlap in no slice. To change them, assign a list.")
      .def(
          "getNewActionSequence", [](Abstraction& tamp) { return tamp.Abstraction::getNewActionSequence(); },
          docs::lgp::getNewActionSequence)
      .def(
          "forbidBeginning", [](Abstraction& tamp, const LgpPlan& plan) { tamp.Abstraction::forbidBeginning(plan); },
          "plan"_a, nb::sig(kForbid), docs::lgp::forbidBeginning)
      .def(
          "setup_sequence",
          [](Abstraction& tamp, const PyConfig& C, int K) { return asPython(tamp.Abstraction::setup_sequence(C, K)); },
          "C"_a, "K"_a, docs::lgp::setup_sequence)
      .def(
          "setup_motion",
          [](Abstraction& tamp, const PyConfig& C, int K) { return asPython(tamp.Abstraction::setup_motion(C, K)); },
          "C"_a, "K"_a, docs::lgp::setup_motion)
      .def(
          "add_action_constraints",
          [](Abstraction& tamp, const std::shared_ptr<PyKomo>& komo, double time, const TaskAction& before,
             const TaskAction& action) { tamp.Abstraction::add_action_constraints(komo, time, before, action); },
          "komo"_a, "time"_a, "prev_action"_a, "action"_a, nb::sig(kAdd), docs::lgp::add_action_constraints)
      .def(
          "add_action_constraints_motion",
          [](Abstraction& tamp, const std::shared_ptr<PyKomo>& komo, double time, const TaskAction& before,
             const TaskAction& action) {
            tamp.Abstraction::add_action_constraints_motion(komo, time, before, action);
            warnOfProblem(*komo);
          },
          "komo"_a, "time"_a, "prev_action"_a, "action"_a, nb::sig(kAddMotion),
          docs::lgp::add_action_constraints_motion)
      .def(
          "add_all",
          [](Abstraction& tamp, const std::shared_ptr<PyKomo>& komo, const LgpPlan& plan, bool motion) {
            tamp.Abstraction::add_all(komo, plan, motion);
            warnOfProblem(*komo);
          },
          "komo"_a, "plan"_a, "motion"_a, nb::sig(kAddAll), docs::lgp::add_all);
}

void bindDefault(nb::module_& m) {
  nb::class_<DefaultAbstraction, Abstraction, PyAbstraction<DefaultAbstraction>>(m, "default_LGP_TAMP_Abstraction",
                                                                                 docs::lgp::defaultAbstraction)
      .def("__init__", makeDefault, "C"_a, "lgp_config_file"_a, docs::lgp::makeDefault)
      .def_prop_ro(
          "domain", [](const DefaultAbstraction& tamp) { return tamp.domain(); }, "Its actions and rules, a Domain.")
      .def_prop_ro(
          "search", [](const DefaultAbstraction& tamp) { return PyPlanSearch{tamp.search()}; },
          "The PlanSearch that enumerates the plans.")
      .def(
          "getNewActionSequence",
          [](DefaultAbstraction& tamp) {
            const nb::gil_scoped_release unlock;
            return tamp.DefaultAbstraction::getNewActionSequence();
          },
          docs::lgp::nextPlan)
      .def(
          "forbidBeginning",
          [](DefaultAbstraction& tamp, const LgpPlan& plan) { tamp.DefaultAbstraction::forbidBeginning(plan); },
          "plan"_a, nb::sig(kForbid), docs::lgp::forbid)
      .def(
          "add_action_constraints",
          [](DefaultAbstraction& tamp, const std::shared_ptr<PyKomo>& komo, double time, const TaskAction& before,
             const TaskAction& action) {
            tamp.DefaultAbstraction::add_action_constraints(komo, time, before, action);
            warnOfProblem(*komo);
          },
          "komo"_a, "time"_a, "prev_action"_a, "action"_a, nb::sig(kAdd), docs::lgp::addDefaultConstraints)
      .def(
          "switch",
          [](DefaultAbstraction& tamp, PyManipulation& helper, double time, const std::string& frame,
             const std::string& obj) {
            tamp.switchTo(helper, time, frame, obj);
            warnOfProblem(*helper.komo);
          },
          "m"_a, "time"_a, "frame"_a, "obj"_a, docs::lgp::switchTo)
      .def(
          "steps", [](const DefaultAbstraction& tamp, const PyKomo& komo) { return tamp.steps(komo); }, "komo"_a,
          docs::lgp::steps)
      .def("is_last", &DefaultAbstraction::is_last, "time"_a, docs::lgp::is_last);
}

/// `results`, unless None, converts a SolverReturn to the returned object.
struct PyLgpTool : LgpTool {
  PyLgpTool(const PyConfig& C, std::shared_ptr<Abstraction> tamp, LgpOptions options, nb::object results)
      : LgpTool(C, std::move(tamp), std::move(options)), results(std::move(results)) {}

  nb::object results;

  nb::object returned(SolverResult result) const {
    const nb::object own = nb::cast(std::move(result));
    return results.is_none() ? own : results(own);
  }

  /// Reads the current settings of params_add and rnd_seed.
  void readDefaults() {
    options.solver = startingOptions();
    options.solver.verbose = 0;
    options.seed = defaults().seed;
  }
};

void makeTool(PyLgpTool* self, const PyConfig& C, std::shared_ptr<Abstraction> tamp, nb::handle, int threads,
              const nb::object& results) {
  LgpOptions options;
  options.threads = threads;
  options.cancellation = asksForInterrupts();
  options.print = [](const std::string& line) { logMessage(LogLevel::info, inPython(line)); };
  if (!results.is_none()) {
    options.accepts = [results](const SolverResult& result) {
      const nb::gil_scoped_acquire lock;
      return nb::cast<bool>(results(result).attr("feasible"));
    };
    options.describes = [results](const SolverResult& result) {
      const nb::gil_scoped_acquire lock;
      return nb::cast<std::string>(results(result).attr("message"));
    };
  }
  new (self) PyLgpTool(C, std::move(tamp), std::move(options), results);
}

template <class Call>
auto withoutLock(PyLgpTool& lgp, const Call& call) {
  lgp.readDefaults();
  const nb::gil_scoped_release unlock;
  return call();
}

nb::list pieces(PyLgpTool& lgp, int verbose) {
  nb::list list;
  for (SolverResult& result : withoutLock(lgp, [&] { return lgp.solvePiecewiseMotions(verbose); }))
    list.append(lgp.returned(std::move(result)));
  return list;
}

int viewSolved(const PyLgpTool& lgp, bool pause) {
  const LgpPlan& plan = lgp.getSolvedPlan();
  return nb::cast<int>(nb::cast(asPython(lgp.getSolvedKOMO())).attr("view")(pause, planText(plan)));
}

void bindToolResults(nb::class_<PyLgpTool>& tool) {
  tool.def_prop_ro(
          "C", [](const PyLgpTool& lgp) { return sameScene(lgp.C); }, "The scene.")
      .def_prop_ro(
          "tamp", [](const PyLgpTool& lgp) { return lgp.tamp; }, "The abstraction.")
      .def_prop_ro(
          "status", [](const PyLgpTool& lgp) { return lgp.status; }, "How the last solve ended, an LgpStatus.")
      .def_prop_ro(
          "message", [](const PyLgpTool& lgp) { return inPython(lgp.message); },
          "\"\" if solved; else the reason for which there is no plan.")
      .def_prop_ro("solves", &LgpTool::solves, "The number of waypoint problems solved so far; each guess counts.")
      .def_prop_ro("evaluations", &LgpTool::evaluations, "The evaluations spent by them.")
      .def_prop_ro(
          "paths",
          [](const PyLgpTool& lgp) {
            nb::typed<nb::list, Array> list;
            for (const MatrixXd& path : lgp.paths) list.append(toNumpy(path));
            return list;
          },
          "The motion of each action by solvePiecewiseMotions, shape (30, n), rad or m.")
      .def_prop_ro(
          "motion", [](const PyLgpTool& lgp) { return asPython(lgp.motion); },
          nb::sig("def motion(self, /) -> KOMO | None"), "The problem of solveFullMotion at its solution.")
      .def_prop_ro(
          "path", [](const PyLgpTool& lgp) { return toNumpy(lgp.path); },
          "The path of solveFullMotion, shape (T, n), rad or m; without rows before it.");
}

void bindTool(nb::module_& m) {
  nb::enum_<LgpStatus> status(m, "LgpStatus", "How LGP_Tool.solve ended.");
  for (int i = 0; i <= int(LgpStatus::no_plan_found); ++i) {
    static std::vector<std::string> names(std::size_t(LgpStatus::no_plan_found) + 1);
    names[std::size_t(i)] = lgpStatusName(LgpStatus(i));
    status.value(names[std::size_t(i)].c_str(), LgpStatus(i));
  }
  nb::class_<PyLgpTool> tool(m, "LGP_Tool", nb::dynamic_attr(), docs::lgp::tool);
  tool.def("__init__", makeTool, "C"_a, "tamp"_a, "translator"_a = nb::none(), nb::kw_only(), "threads"_a = 1,
           "results"_a = nb::none(),
           nb::sig("def __init__(self, C: Config, tamp: LGP_TAMP_Abstraction, translator: object = None, *, threads: "
                   "int = 1, results: collections.abc.Callable[[SolverReturn], SolverReturn] | None = None) -> None"),
           docs::lgp::makeTool)
      .def(
          "solve",
          [](PyLgpTool& lgp, int verbose, int most) {
            return withoutLock(lgp, [&] { return lgp.solve(verbose, most); });
          },
          "verbose"_a = 1, "maxSolves"_a = 2000, docs::lgp::solve)
      .def("getSolvedPlan", &LgpTool::getSolvedPlan, docs::lgp::getSolvedPlan)
      .def(
          "getSolvedKOMO", [](const PyLgpTool& lgp) { return asPython(lgp.getSolvedKOMO()); }, docs::lgp::getSolvedKOMO)
      .def(
          "get_piecewiseMotionProblem",
          [](const PyLgpTool& lgp, int phase, bool fix_end) {
            return asPython(lgp.get_piecewiseMotionProblem(phase, fix_end));
          },
          "phase"_a, "fixEnd"_a = true, docs::lgp::get_piecewiseMotionProblem)
      .def(
          "get_fullMotionProblem",
          [](const PyLgpTool& lgp, bool init) { return asPython(lgp.get_fullMotionProblem(init)); },
          "initWithWaypoints"_a = true, docs::lgp::get_fullMotionProblem)
      .def("solvePiecewiseMotions", pieces, "verbose"_a = 1,
           nb::sig("def solvePiecewiseMotions(self, verbose: int = 1) -> list[SolverReturn]"),
           docs::lgp::solvePiecewiseMotions)
      .def(
          "solveFullMotion",
          [](PyLgpTool& lgp, int verbose) {
            return lgp.returned(withoutLock(lgp, [&] { return lgp.solveFullMotion(verbose); }));
          },
          "verbose"_a = 1, nb::sig("def solveFullMotion(self, verbose: int = 1) -> SolverReturn"),
          docs::lgp::solveFullMotion)
      .def("view_solved", viewSolved, "pause"_a = true, docs::lgp::view_solved)
      .def(
          "view_close",
          [](const PyLgpTool& lgp) {
            if (lgp.hasPlan()) nb::cast(asPython(lgp.getSolvedKOMO())).attr("view_close")();
          },
          "Closes the viewer of the waypoints.");
  bindToolResults(tool);
}

}  // namespace

void bindLgp(nb::module_& m) {
  bindAbstraction(m);
  bindDefault(m);
  bindTool(m);
}

}  // namespace kinegraph::python
