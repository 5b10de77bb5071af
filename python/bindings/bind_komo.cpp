#include <nanobind/stl/optional.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/variant.h>
#include <nanobind/stl/vector.h>

#include <cmath>

#include "bindings.h"
#include "defaults.h"
#include "explanation_dicts.h"
#include "feature_arguments.h"
#include "kinegraph/base/errors.h"
#include "kinegraph/base/text.h"
#include "kinegraph/features/registry.h"
#include "kinegraph/komo/report.h"
#include "kinegraph/komo/sub_problem.h"
#include "kinegraph/solvers/nlp_solver.h"
#include "py_komo.h"
#include "solving.h"

namespace kinegraph::python {

namespace {

using Optional = const std::optional<Numbers>&;

std::vector<double> toTimes(Optional times) { return times ? times->list() : std::vector<double>(); }

void warn(Komo& komo) {
  for (const std::string& warning : komo.takeWarnings()) emitWarning(warning);
}

void addObjective(PyKomo& komo, Optional times, const FeatureArgument& feature, const FrameNames& frames,
                  ObjectiveType type, Optional scale, Optional target, int order) {
  komo.addObjective(toTimes(times), feature.source(), toNames(frames), type, toScale(scale), toTarget(target), order);
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

nb::list forceInteractions(const PyKomo& komo) {
  nb::list list;
  for (const Interaction& interaction : komo.interactions()) {
    nb::dict entry;
    entry["slice"] = interaction.slice;
    entry["onto"] = interaction.object;
    entry["from"] = interaction.onto;
    entry["poa"] = toNumpy(VectorXd(interaction.point));
    entry["force"] = toNumpy(VectorXd(interaction.force));
    entry["torque"] = toNumpy(VectorXd(VectorXd::Zero(3)));
    list.append(entry);
  }
  return list;
}

Frame addFrameDof(PyKomo& komo, const std::string& name, const std::string& parent, JointType type, bool stable,
                  const std::optional<std::string>& origin_name, const std::optional<Frame>& origin) {
  komo.addFrameDof(name, parent, type, stable, origin ? origin->getName() : origin_name.value_or(""));
  return addedFrame(komo, name);
}

std::string addContact(PyKomo& komo, const Numbers& times, const std::string& object, const std::string& onto,
                       const std::string& kind, double friction) {
  return komo.addExchange(times.list(), object, onto, exchangeFromName(kind), friction);
}

Array pathFrames(const PyKomo& komo) {
  nb::list slices;
  for (int t = 0; t < komo.slices(); ++t) slices.append(toNumpy(komo.getFrameState(t)));
  return Array(nb::module_::import_("numpy").attr("stack")(slices));
}

nb::typed<nb::list, Array> ownDofs(const PyKomo& komo) {
  nb::list slices;
  for (int t = 0; t < komo.slices(); ++t) slices.append(toNumpy(komo.path().ownDofs(t)));
  return slices;
}

nb::typed<nb::tuple, PyConfig, Array, Array> subProblem(const PyKomo& komo, int phase) {
  SubProblem sub = kinegraph::subProblem(komo.path(), phase);
  return nb::make_tuple(PyConfig{std::move(sub.config), nullptr}, toNumpy(sub.start), toNumpy(sub.end));
}

/// A sequence of vectors, an array with a row per waypoint, or an array of arrays.
std::vector<int> initWithWaypoints(PyKomo& komo, nb::iterable waypoints, int per_phase, bool interpolate,
                                   double towards_home, int) {
  std::vector<VectorXd> list;
  for (nb::handle waypoint : waypoints) list.push_back(nb::cast<Numbers>(waypoint).values);
  return komo.setWaypoints(list, {per_phase, interpolate, towards_home});
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

std::shared_ptr<PyKomo> pathProblem(const PyConfig& config, double phases, int slices, double time, int order) {
  auto komo = std::make_shared<PyKomo>();
  komo->setConfig(config);
  komo->setTiming(phases, slices, time, order);
  return komo;
}

/// The shorthands of older scripts, on Config.
void bindOldConstructors() {
  nb::object config = nb::borrow(nb::type<PyConfig>());
  nb::setattr(config, "komo_IK",
              nb::cpp_function(
                  [](const PyConfig& c, nb::args, nb::kwargs) {
                    auto komo = pathProblem(c, 1., 1, 1., 1);
                    komo->addControlObjective({}, 1, 1e-1);
                    komo->addQuaternionNorms();
                    return komo;
                  },
                  nb::is_method(), nb::name("komo_IK"), nb::scope(config),
                  "A KOMO of one slice with a cost on leaving the present posture (older scripts)."));
  nb::setattr(config, "komo_path",
              nb::cpp_function(
                  [](const PyConfig& c, double phases, int slices, double time, nb::args, nb::kwargs) {
                    auto komo = pathProblem(c, phases, slices, time, 2);
                    komo->addControlObjective({}, 2, 1e-1);
                    komo->addQuaternionNorms();
                    return komo;
                  },
                  nb::is_method(), nb::name("komo_path"), nb::scope(config), "phases"_a, "stepsPerPhase"_a = 20,
                  "timePerPhase"_a = 5., "args"_a, "kwargs"_a,
                  "A KOMO of a path with a cost on accelerations (older scripts)."));
}

void bindSwitchModes(nb::module_& m) {
  nb::enum_<SwitchMode> modes(m, "SY", nb::is_arithmetic(), "Symbols of skeletons and mode switches.");
  for (const auto& [name, value] : switchModeNames()) modes.value(name.c_str(), value);
}

void bindObjectives(nb::class_<PyKomo>& komo) {
  const char* doc =
      "Adds scale * (feature - target) in the slices of `times`: [] all, [t] one, [from, to] both included, in "
      "phases.\n"
      "feature: a symbol of FS, or a function of your own, as for Config.eval. type: OT.sos, OT.eq, OT.ineq, OT.f, "
      "OT.ineqB or\n"
      "OT.ineqP. scale: a number, one per row, or a matrix. order: of the time derivative.";
  komo.def("addObjective", addObjective, "times"_a, "feature"_a, "frames"_a, "type"_a, "scale"_a = nb::none(),
           "target"_a = nb::none(), "order"_a = -1, doc)
      .def("addObjective", addObjective, "time"_a = nb::none(), "feature"_a, "frames"_a = std::vector<std::string>(),
           "type"_a, "scale"_a = nb::none(), "target"_a = nb::none(), "order"_a = -1,
           nb::sig("def addObjective(self, *, time: numpy.typing.ArrayLike | None = None, feature: FS, frames: "
                   "typing.Sequence[str] | str = [], "
                   "type: OT, scale: numpy.typing.ArrayLike | None = None, target: numpy.typing.ArrayLike | None = "
                   "None, order: int = -1) -> None"),
           doc)
      .def("addControlObjective", addControl, "times"_a, "order"_a, "scale"_a = 1., "target"_a = nb::none(),
           "deltaFromSlice"_a = 0, "deltaToSlice"_a = 0,
           "Sum of squares of the order-th derivative of all dofs; order 0: of the distance from home.")
      .def("add_qControlObjective", addControl, "times"_a = nb::none(), "order"_a = 2, "scale"_a = 1.,
           "target"_a = nb::none(), "deltaFromSlice"_a = 0, "deltaToSlice"_a = 0, "The same as addControlObjective.")
      .def(
          "addQuaternionNorms",
          [](PyKomo& k, Optional times, double scale, bool hard) {
            k.addQuaternionNorms(toTimes(times), scale, hard);
            warn(k);
          },
          "times"_a = nb::none(), "scale"_a = 3., "hard"_a = true, "Keeps quaternion dofs at norm one.")
      .def("clearObjectives", &Komo::clearObjectives, "Removes all objectives.")
      .def(
          "addTimeOptimization",
          [](PyKomo&) { throw Error("addTimeOptimization: durations are fixed; give them with setTiming"); },
          "Not available.");
}

void bindSwitches(nb::class_<PyKomo>& komo) {
  komo.def(
          "addModeSwitch",
          [](PyKomo& k, const Numbers& times, SwitchMode mode, const std::vector<std::string>& frames, bool first) {
            k.addModeSwitch(times.list(), mode, frames, first);
            warn(k);
          },
          "times"_a, "newMode"_a, "frames"_a, "firstSwitch"_a = true,
          "From times[0] on, frames[1] hangs below frames[0]: SY.stable (a grasp), stableOn (on a box), stableOnX, "
          "stableOnY,\n"
          "stableYPhi, stableZero, dynamic (flies, or is pushed), dynamicOn (slides), dynamicTrans, quasiStatic or "
          "quasiStaticOn\n"
          "(moves as far as contact forces push it), magic or magicTrans (moves as it likes). times[1]: when the next "
          "switch follows,\n"
          "or -1.")
      .def(
          "addRigidSwitch",
          [](PyKomo& k, double time, const std::vector<std::string>& frames, bool no_jump) {
            if (frames.size() != 2)
              throw ValueError(cat("addRigidSwitch: frames are [parent, object], got ", frames.size()));
            k.addRigidSwitch(time, frames[0], frames[1], no_jump);
            warn(k);
          },
          "times"_a, "frames"_a, "noJumpStart"_a = true, "From that time on, frames[1] sits at frames[0].")
      .def("addFrameDof", addFrameDof, "name"_a, "parent"_a, "jointType"_a, "stable"_a,
           "originFrameName"_a = nb::none(), "originFrame"_a = nb::none(),
           "Adds a frame with a joint to all slices. Returns a copy of it.");
}

void bindContacts(nb::class_<PyKomo>& komo) {
  komo.def(
          "addContactForceFrame",
          [](PyKomo& k, const Numbers& times, const std::string& object, const std::string& from, double friction,
             double mass, const std::string&) {
            return addedFrame(k, k.addContactForce(times.list(), object, from, friction, mass));
          },
          "times"_a, "obj"_a, "from_"_a, "frictionCone_mu"_a, "init_objMass"_a, "obj_com_frame"_a = "",
          "In these slices `from_` pushes `obj` where they touch, along the z axis of a frame on `obj` that is added: "
          "a copy of it is\n"
          "returned. One dof per slice is the force, in units of the weight of init_objMass. FS.totalForce and "
          "FS.physics balance it,\n"
          "about the object's own center of mass; obj_com_frame is there for older scripts and is not used.")
      .def(
          "addContact_WithPoaFrame",
          [](PyKomo& k, const Numbers& time, const std::string& object, const std::string& from, double friction,
             double mass, double distance) {
            return addedFrame(k, k.addFreeContactForce(time.list(), object, from, friction, mass, distance));
          },
          "time"_a, "obj"_a, "from_"_a, "frictionCone_mu"_a, "init_objMass"_a, "init_POAdist"_a,
          "The same with a force of any direction within the cone of friction: three dofs per slice.")
      .def("addContact", addContact, "times"_a, "obj"_a, "from_"_a, "kind"_a, "friction"_a = .5,
           "In these slices `from_` and `obj` may push each other at a point that moves along both: six more dofs per "
           "slice, the\n"
           "point and the force on `obj` there, in weights of `obj`. kind: 'slide' (they touch, the force is along the "
           "normal), 'stick'\n"
           "(they do not slide; in a KOMO of kOrder 0 the force is within the cone of friction), 'complementary' (no "
           "force where\n"
           "they do not touch) or 'bounce' (off each other, in one slice; kOrder 2). Returns the name of the frame at "
           "the point.\n"
           "What balances the forces is up to FS.totalForce and FS.physics.")
      .def("getForceInteractions", forceInteractions,
           "Contact forces, a dict per force and slice: `from` pushes `onto` at `poa` with `force` (N); all in the "
           "world.");
}

void bindPath(nb::class_<PyKomo>& komo) {
  komo.def("getT", &Komo::slices, "Number of slices.")
      .def(
          "getPath", [](const PyKomo& k, const std::vector<int>& frames) { return toNumpy(k.getPath(frames)); },
          "dofIndices"_a = std::vector<int>(),
          "(T, n): the joint states of all slices, or of the joints of the frames with these ids.")
      .def(
          "getPath_qOrg", [](const PyKomo& k) { return toNumpy(k.getPath()); }, "The same as getPath.")
      .def("getPath_qAll", ownDofs, "A vector per slice: the dofs that belong to it, those of mode switches included.")
      .def(
          "getPathTau", [](const PyKomo& k) { return toNumpy(VectorXd(VectorXd::Constant(k.slices(), k.tau()))); },
          "(T,): duration of each slice, s.")
      .def("getPathFrames", pathFrames, "(T, frames, 7): world poses of all frames in all slices.")
      .def(
          "getFrameState", [](const PyKomo& k, int t) { return toNumpy(k.getFrameState(t)); }, "t"_a,
          "(frames, 7): world poses of all frames in a slice.")
      .def(
          "getFrame",
          [](const PyKomo& k, const std::string& name, double time) {
            return k.configuration(k.path().grid().sliceAt(time)).getFrame(name);
          },
          "frameName"_a, "phaseTime"_a, "A frame as it is in the slice at a phase time; a copy.")
      .def(
          "getConfig",
          [](const PyKomo& k) {
            return PyConfig{k.configuration(-k.order()), nullptr};
          },
          "The scene with the frames that were added, as it is before the path; a copy.")
      .def(
          "getConfiguration",
          [](const PyKomo& k, int t) {
            return PyConfig{k.configuration(t), nullptr};
          },
          "t"_a, "The scene in slice t, a copy; -1 is the one before the first.")
      .def("getSubProblem", subProblem, "phase"_a,
           "For one slice per phase: (configuration at the beginning of a phase, its q at the beginning, at the end).");
}

void bindStarts(nb::class_<PyKomo>& komo) {
  komo.def(
          "initWithConstant", [](PyKomo& k, const Numbers& q) { k.setConstantPath(q.values); }, "q"_a,
          "Starts with q in all slices.")
      .def(
          "setConfigurations", [](PyKomo& k, const PyConfig& config) { k.setConstantPath(config.getJointState()); },
          "config"_a, "Starts with the joint state of a configuration in all slices (older scripts).")
      .def(
          "initWithPath", [](PyKomo& k, const Numbers& q) { k.setPath(q.matrix()); }, "q"_a,
          "Starts with a path (T, n).")
      .def("initWithWaypoints", initWithWaypoints, "waypoints"_a, "waypointSlicesPerPhase"_a = 1,
           "interpolate"_a = false, "qHomeInterpolate"_a = 0., "verbose"_a = -1,
           "Starts with waypoint i at phase time (i+1)/waypointSlicesPerPhase. Returns their slices.")
      .def(
          "initPhaseWithDofsPath",
          [](PyKomo& k, int phase, const std::vector<int>& dofs, const Numbers& path, bool resample) {
            k.setPhasePath(phase, dofs, path.matrix(), resample);
          },
          "t_phase"_a, "dofIDs"_a, "path"_a, "autoResamplePath"_a = false,
          "Starts a phase with a path for the joints of these frames.")
      .def(
          "initRandom", [](PyKomo& k, int) { k.setRandomPath(defaults().random); }, "verbose"_a = 0,
          "Starts at random joint states.")
      .def(
          "initOrg", [](PyKomo& k) { k.resetPath(); }, "Starts with the given configuration in all slices.")
      .def(
          "updateRootObjects", [](PyKomo& k, const PyConfig& config) { k.updateRootObjects(config); }, "config"_a,
          "Takes over the constant poses of the configuration; the path stays, for a warm start.");
}

}  // namespace

void bindKomo(nb::module_& m) {
  bindSwitchModes(m);
  nb::class_<PyKomo> komo(m, "KOMO", "A motion problem: slices of a configuration, tied together by objectives.");
  komo.def(nb::init<>(), "An empty problem; call setConfig and setTiming.")
      .def(
          "__init__",
          [](PyKomo* self, const PyConfig& config, double phases, int slices, int order, bool) {
            new (self) PyKomo{Komo(config, phases, slices, order), nullptr};
          },
          "config"_a, "phases"_a, "slicesPerPhase"_a, "kOrder"_a, "enableCollisions"_a,
          "phases x slicesPerPhase configurations; features of up to kOrder + 1 consecutive ones. With (1, 1, 0) it is "
          "inverse\n"
          "kinematics. Collisions are computed where objectives ask for them, whatever enableCollisions says.")
      .def(
          "setConfig", [](PyKomo& k, const PyConfig& config, bool) { k.setConfig(config); }, "config"_a,
          "enableCollisions"_a = false, "The configuration that moves.")
      .def(
          "setModel", [](PyKomo& k, const PyConfig& config, bool) { k.setConfig(config); }, "config"_a,
          "enableCollisions"_a = false, "The same as setConfig.")
      .def(
          "setTiming",
          [](PyKomo& k, double phases, int slices, double duration, int order) {
            k.setTiming(phases, slices, duration, order);
          },
          "phases"_a, "slicesPerPhase"_a, "durationPerPhase"_a, "kOrder"_a, "The time grid; durations in s.")
      .def(
          "nlp", [](std::shared_ptr<PyKomo> k) { return makeNlp(std::move(k)); },
          "The problem for a solver. It keeps this object alive, which then holds the solution.")
      .def("optimize", optimize, "addInitializationNoise"_a = .01, "verbose"_a = 0,
           "Solves from the present path, moved by a little noise.")
      .def("getCosts", costs, "Sum of the costs (f and sos) of the present path.")
      .def("getConstraintViolations", violations,
           "Sum of the violations of all constraints (eq and ineq) at the present path.")
      .def(
          "explain", [](const std::shared_ptr<PyKomo>& k, double tolerance) { return explainPath(k, tolerance).str(); },
          "tolerance"_a = 1e-3,
          "In words: which objectives and limits contradict each other around the present path, in which slices, by "
          "how many m\n"
          "or rad, and which single one helps most if it gives way. Solves small problems; the path stays.")
      .def(
          "conflicts",
          [](const std::shared_ptr<PyKomo>& k, double tolerance) { return toDicts(explainPath(k, tolerance)); },
          "tolerance"_a = 1e-3, "What explain says, as a list of dicts, as SolverReturn.conflicts.")
      .def("__repr__", [](const PyKomo& k) {
        return cat("<KOMO: ", k.slices(), " slices, order ", k.order(), ", ", k.objectives().size(), " objectives>");
      });
  bindObjectives(komo);
  bindSwitches(komo);
  bindContacts(komo);
  bindPath(komo);
  bindStarts(komo);
  bindKomoReports(komo);
  bindKomoCopies(komo);
  bindOldConstructors();
}

}  // namespace kinegraph::python
