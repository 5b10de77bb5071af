#include <nanobind/stl/optional.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/variant.h>
#include <nanobind/stl/vector.h>

#include <cmath>

#include "bindings.h"
#include "defaults.h"
#include "features/feature_arguments.h"
#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/features/feature_source.h"
#include "kinegraph/komo/force_exchange.h"
#include "kinegraph/komo/komo.h"
#include "kinegraph/komo/mode_switches.h"
#include "kinegraph/solvers/nlp_solver.h"
#include "komo/komo_docs.h"
#include "komo/py_komo.h"
#include "solvers/explanation_dicts.h"
#include "solvers/solving.h"

namespace kinegraph::python {

namespace {

using Optional = const std::optional<Numbers>&;

std::vector<double> toTimes(Optional times) { return times ? times->list() : std::vector<double>(); }

void warn(Komo& komo) {
  for (const std::string& warning : komo.takeWarnings()) emitWarning(warning);
}

void addObjective(PyKomo& komo, Optional times, const FeatureArgument& feature, const FrameNames& frames,
                  ObjectiveType type, Optional scale, Optional target, int order, double margin) {
  komo.addObjective(toTimes(times), feature.source(), toNames(frames), type, toScale(scale), toTarget(target), order,
                    margin);
  warn(komo);
}

void addObjectivePerSlice(PyKomo& komo, Optional times, const FeatureArgument& feature, const FrameNames& frames,
                          ObjectiveType type, const Numbers& targets, Optional scale, int order) {
  if (targets.rank != 2)
    throw ValueError(cat("addObjectivePerSlice: targets have rank ", targets.rank, "; expected shape (K, d)"));
  komo.addObjectivePerSlice(toTimes(times), feature.source(), toNames(frames), type, targets.matrix(), toScale(scale),
                            order);
  warn(komo);
}

void addControl(PyKomo& komo, Optional times, int order, double scale, Optional target, int from, int to) {
  komo.addControlObjective(toTimes(times), order, scale, toTarget(target), from, to);
  warn(komo);
}

Frame addedFrame(PyKomo& komo, const std::string& name) {
  warn(komo);
  return komo.configuration(-komo.order()).getFrame(name);
}

Frame addFrameDof(PyKomo& komo, const std::string& name, const std::string& parent, JointType type, bool stable,
                  const std::optional<std::string>& origin_name, const std::optional<Frame>& origin) {
  FrameSpec spec{name, parent, type, stable, origin ? origin->getName() : origin_name.value_or("")};
  if (origin) spec.origin_pose = origin->getPose();
  kinegraph::addFrameDof(komo.path(), spec);
  return addedFrame(komo, name);
}

std::string addContact(PyKomo& komo, const Numbers& times, const std::string& object, const std::string& from,
                       const std::string& kind, double friction) {
  return komo.addForceExchange(times.list(), object, from, forceExchangeFromName(kind), friction);
}

SolverResult optimize(const std::shared_ptr<PyKomo>& komo, double noise, int verbose) {
  const auto nlp = makeNlp(komo);
  NlpSolver solver(nlp, verbose);
  solver.options = startingOptions();
  solver.options.verbose = verbose;
  VectorXd x = komo->path().variables();
  Rng rng(defaults().seed);
  for (double& value : x) value += noise * rng.normal();
  solver.setInitialization(x);
  return solveInterruptibly(solver, false);
}

Explanation explainPath(const std::shared_ptr<PyKomo>& komo, double tolerance) {
  const VectorXd x = komo->path().variables();
  return explainInterruptibly(*makeNlp(komo), x, tolerance);
}

double costs(const PyKomo& komo) {
  const ErrorSums sums = measurePath(komo).totals;
  return sums.sos + sums.f;
}

double violations(const PyKomo& komo) {
  const ErrorSums sums = measurePath(komo).totals;
  return sums.eq + sums.ineq;
}

void bindSwitchModes(nb::module_& m) {
  nb::enum_<SwitchMode> modes(m, "SY", nb::is_arithmetic(), "Symbols of skeletons and mode switches.");
  for (const auto& [name, value] : switchModeNames()) modes.value(name.c_str(), value);
}

void bindObjectives(nb::class_<PyKomo>& komo) {
  komo.def("addObjective", addObjective, "times"_a, "feature"_a, "frames"_a, "type"_a, "scale"_a = nb::none(),
           "target"_a = nb::none(), "order"_a = -1, "margin"_a = 0., docs::komo::addObjective)
      .def("addObjective", addObjective, "time"_a = nb::none(), "feature"_a, "frames"_a = std::vector<std::string>(),
           "type"_a, "scale"_a = nb::none(), "target"_a = nb::none(), "order"_a = -1, "margin"_a = 0.,
           nb::sig("def addObjective(self, *, time: numpy.typing.ArrayLike | None = None, feature: FS | "
                   "collections.abc.Callable, frames: "
                   "typing.Sequence[str] | str = [], "
                   "type: OT, scale: numpy.typing.ArrayLike | None = None, target: numpy.typing.ArrayLike | None = "
                   "None, order: int = -1, margin: float = 0.0) -> None"),
           docs::komo::addObjectiveByName)
      .def("addObjective", addObjective, "times"_a, "feature"_a, "frames"_a = std::vector<std::string>(), "type"_a,
           "scale"_a = nb::none(), "target"_a = nb::none(), "order"_a = -1, "margin"_a = 0.,
           nb::sig("def addObjective(self, *, times: numpy.typing.ArrayLike | None, feature: FS | "
                   "collections.abc.Callable, frames: "
                   "typing.Sequence[str] | str = [], "
                   "type: OT, scale: numpy.typing.ArrayLike | None = None, target: numpy.typing.ArrayLike | None = "
                   "None, order: int = -1, margin: float = 0.0) -> None"),
           docs::komo::addObjectiveByTimes)
      .def("addObjectivePerSlice", addObjectivePerSlice, "times"_a, "feature"_a, "frames"_a, "type"_a, "targets"_a,
           "scale"_a = nb::none(), "order"_a = -1, docs::komo::addObjectivePerSlice)
      .def(
          "addFreeMotion",
          [](PyKomo& k, Optional times, double margin, double scale) {
            k.addFreeMotion(toTimes(times), margin, scale);
            warn(k);
          },
          "times"_a = nb::none(), "margin"_a = 1e-3, "scale"_a = 10., docs::komo::addFreeMotion)
      .def(
          "addStepLimit",
          [](PyKomo& k, double step, Optional times) {
            addStepLimit(k, step, toTimes(times));
            warn(k);
          },
          "step"_a, "times"_a = nb::none(), docs::komo::addStepLimit)
      .def("addControlObjective", addControl, "times"_a, "order"_a, "scale"_a = 1., "target"_a = nb::none(),
           "deltaFromSlice"_a = 0, "deltaToSlice"_a = 0, docs::komo::addControlObjective)
      .def(
          "addQuaternionNorms",
          [](PyKomo& k, Optional times, double scale, bool hard) {
            k.addQuaternionNorms(toTimes(times), scale, hard);
            warn(k);
          },
          "times"_a = nb::none(), "scale"_a = 3., "hard"_a = true, docs::komo::addQuaternionNorms)
      .def("clearObjectives", &Komo::clearObjectives, "Removes all objectives.")
      .def(
          "addTimeOptimization",
          [](PyKomo&) { throw Error("addTimeOptimization is not available; set durations with setTiming"); },
          docs::komo::addTimeOptimization);
}

void bindSwitches(nb::class_<PyKomo>& komo) {
  komo.def(
          "addModeSwitch",
          [](PyKomo& k, const Numbers& times, SwitchMode mode, const std::vector<std::string>& frames, bool first) {
            k.addModeSwitch(times.list(), mode, frames, first);
            warn(k);
          },
          "times"_a, "newMode"_a, "frames"_a, "firstSwitch"_a = true, docs::komo::addModeSwitch)
      .def(
          "addRigidSwitch",
          [](PyKomo& k, double time, const std::vector<std::string>& frames, bool no_jump) {
            if (frames.size() != 2)
              throw ValueError(cat("addRigidSwitch: frames must be [parent, object]; got ", frames.size()));
            k.addRigidSwitch(time, frames[0], frames[1], no_jump);
            warn(k);
          },
          "times"_a, "frames"_a, "noJumpStart"_a = true, docs::komo::addRigidSwitch)
      .def("addFrameDof", addFrameDof, "name"_a, "parent"_a, "jointType"_a, "stable"_a,
           "originFrameName"_a = nb::none(), "originFrame"_a = nb::none(), docs::komo::addFrameDof);
}

void bindContacts(nb::class_<PyKomo>& komo) {
  komo.def(
          "addContactForceFrame",
          [](PyKomo& k, const Numbers& times, const std::string& object, const std::string& from, double friction,
             double mass, const std::string&) {
            return addedFrame(k, k.addContactForce(times.list(), object, from, friction, mass));
          },
          "times"_a, "obj"_a, "from_"_a, "frictionCone_mu"_a, "init_objMass"_a, "obj_com_frame"_a = "",
          docs::komo::addContactForceFrame)
      .def(
          "addContact_WithPoaFrame",
          [](PyKomo& k, const Numbers& time, const std::string& object, const std::string& from, double friction,
             double mass, double distance) {
            return addedFrame(k, k.addFreeContactForce(time.list(), object, from, friction, mass, distance));
          },
          "time"_a, "obj"_a, "from_"_a, "frictionCone_mu"_a, "init_objMass"_a, "init_POAdist"_a,
          docs::komo::addContact_WithPoaFrame)
      .def("addContact", addContact, "times"_a, "obj"_a, "from_"_a, "kind"_a, "friction"_a = .5,
           docs::komo::addContact);
}

}  // namespace

void bindKomo(nb::module_& m) {
  bindSwitchModes(m);
  nb::class_<PyKomo> komo(m, "KOMO",
                          "A trajectory optimization problem: slices of a configuration, coupled by objectives.");
  komo.def(nb::init<>(), "Makes an empty problem; call setConfig and setTiming.")
      .def(
          "__init__",
          [](PyKomo* self, const PyConfig& config, double phases, int slices, int order, bool collisions) {
            if (collisions) warnOfContacts(config);
            new (self) PyKomo{Komo(config, phases, slices, order), nullptr};
          },
          "config"_a, "phases"_a, "slicesPerPhase"_a, "kOrder"_a, "enableCollisions"_a, docs::komo::makePath)
      .def(
          "setConfig", [](PyKomo& k, const PyConfig& config, bool) { k.setConfig(config); }, "config"_a,
          "enableCollisions"_a = false, docs::komo::setConfig)
      .def(
          "setTiming",
          [](PyKomo& k, double phases, int slices, double duration, int order) {
            k.setTiming(phases, slices, duration, order);
          },
          "phases"_a, "slicesPerPhase"_a, "durationPerPhase"_a, "kOrder"_a, docs::komo::setTiming)
      .def(
          "nlp", [](std::shared_ptr<PyKomo> k) { return makeNlp(std::move(k)); },
          "Returns the problem for a solver. It keeps this object alive, which receives the solution.")
      .def("optimize", optimize, "addInitializationNoise"_a = .01, "verbose"_a = 0, docs::komo::optimize)
      .def("getCosts", costs, "Returns the sum of the costs (f and sos) of the present path.")
      .def("getConstraintViolations", violations,
           "Returns the sum of the violations of all constraints (eq and ineq) at the present path.")
      .def(
          "explain",
          [](const std::shared_ptr<PyKomo>& k, double tolerance) { return textOf(explainPath(k, tolerance)); },
          "tolerance"_a = 1e-3, docs::komo::explain)
      .def(
          "conflicts",
          [](const std::shared_ptr<PyKomo>& k, double tolerance) { return toDicts(explainPath(k, tolerance)); },
          "tolerance"_a = 1e-3, docs::komo::conflicts)
      .def("__repr__", [](const PyKomo& k) {
        return cat("<KOMO: ", k.slices(), " slices, order ", k.order(), ", ", k.objectives().size(), " objectives>");
      });
  bindObjectives(komo);
  bindSwitches(komo);
  bindContacts(komo);
  bindKomoPath(m, komo);
  bindKomoReports(komo);
  bindKomoCopies(komo);
}

}  // namespace kinegraph::python
