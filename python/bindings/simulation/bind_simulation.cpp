#include <nanobind/ndarray.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include "arguments.h"
#include "bindings.h"
#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/simulation/simulation.h"
#include "option_class.h"
#include "rendering/images.h"
#include "scene/contact_dicts.h"
#include "simulation/depth_noise.h"
#include "simulation/simulation_docs.h"
#include "simulation/simulation_objects.h"

namespace kinegraph::python {

namespace {

const OptionClass<SimulationOptions>& simulationOptions() {
  static const OptionClass<SimulationOptions> options(simulationOptionTable());
  return options;
}

void warn(PySimulation& s) {
  for (const std::string& warning : s.simulation.takeWarnings()) emitWarning(warning);
}

/// Returns the default options, overridden by `params_add` of reference scripts.
SimulationOptions startOptions() {
  const nb::object set = nb::module_::import_("kinegraph.compatibility.parameters").attr("params_get")();
  SimulationOptions options;
  options.friction = nb::cast<double>(set.attr("get")("physx/defaultFriction", options.friction));
  return options;
}

void makeSimulation(PySimulation* self, nb::object config, SimulationEngine engine, std::optional<int> verbose,
                    nb::handle options) {
  if (!nb::isinstance<PyConfig>(config)) throw nb::next_overload();
  const SimulationOptions chosen = optionsFrom(options);
  Simulation made(nb::cast<PyConfig&>(config), engine, chosen);
  new (self) PySimulation{std::move(config), std::move(made)};
  warn(*self);
  applyVerbosity(*self, verbose);
}

constexpr double kLong = .1;  ///< s of simulated time: longer steps check for Ctrl-C

void stepSimulation(PySimulation& s, const Numbers& u, double tau, ControlMode mode) {
  const std::shared_ptr<SimulationObserver> observer = s.simulation.observer();
  while (observer && !observer->mayStep(s.simulation)) observer->rest();
  s.simulation.update();
  warn(s);
  try {
    const nb::gil_scoped_release unlock;
    CheckInterrupts check;
    CancellationToken cancellation;
    if (tau > kLong) cancellation = [&] { check(); };
    s.simulation.advance(u.values, tau, mode, cancellation);
  } catch (const DivergenceError&) {
    if (!observer || !observer->replaceStep(s.simulation, tau)) throw;
  }
  s.simulation.publish();
  if (observer) observer->afterStep(s.simulation);
  if (s.recorder.is_valid()) s.recorder.attr("step")(nb::find(s));
}

void multiStep(PySimulation& s, double tau_step, double tau_sim) {
  if (s.recorder.is_valid() && tau_step > 0. && tau_sim > 0.) {
    for (long i = std::lround(tau_step / tau_sim); i > 0; --i) stepSimulation(s, {}, tau_sim, ControlMode::spline);
    return;
  }
  s.simulation.update();
  CheckInterrupts check;
  const auto go = [&] { s.simulation.multi_step(tau_step, tau_sim, [&] { check(); }); };
  if (s.simulation.observer()) return go();
  const nb::gil_scoped_release unlock;
  go();
}

/// Returns velocities with shape (F, 2, 3).
Array velocityArray(const MatrixXd& velocities) {
  const NewArray made = newArray(std::size_t(velocities.rows()), 2, 3);
  for (long i = 0; i < velocities.rows(); ++i) {
    for (long k = 0; k < 6; ++k) made.data[6 * i + k] = velocities(i, k);
  }
  return made.array;
}

MatrixXd velocityMatrix(const Numbers& given, const char* what) {
  if (given.values.size() % 6 != 0)
    throw ValueError(cat(what, " has ", given.values.size(), " entries; expected shape (F, 2, 3)"));
  return Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, 6, Eigen::RowMajor>>(given.values.data(),
                                                                                     given.values.size() / 6, 6);
}

void pushConfig(PySimulation& s, const Numbers& frames, const Numbers& joints) {
  const bool given = frames.values.size() > 0;
  s.simulation.pushConfigToSim(given ? velocityMatrix(frames, "Simulation: frameVelocities") : MatrixXd(),
                               joints.values);
  warn(s);
}

/// Also accepts C.getFrameState(), as scripts of 2024 do.
void setState(PySimulation& s, nb::handle state, nb::handle q, const Numbers& frames, const Numbers& joints) {
  if (nb::isinstance<SimulationState>(state)) return s.simulation.setState(nb::cast<const SimulationState&>(state));
  s.config.attr("setFrameState")(state);
  if (nb::len(q) > 0) s.config.attr("setJointState")(q);
  pushConfig(s, frames, joints);
}

nb::typed<nb::list, nb::dict> contacts(const PySimulation& s) { return contactDicts(s.simulation.getContacts()); }

std::string name(const PySimulation& s, const FrameArgument& frame) {
  return toFrame(nb::cast<PyConfig&>(s.config), frame).getName();
}

Vector3d vector3(const Numbers& given, const char* what) {
  if (given.values.size() != 3) throw ValueError(cat(what, " has ", given.values.size(), " entries; expected 3"));
  return given.values;
}

nb::object getPerturbation(const PySimulation& s) {
  const std::optional<Perturbation> perturbation = s.simulation.getPerturbation();
  if (!perturbation) return nb::none();
  nb::dict found;
  found["position"] = toNumpy(VectorXd(perturbation->position));
  found["target"] = toNumpy(VectorXd(perturbation->target));
  found["force"] = toNumpy(VectorXd(perturbation->force));
  return found;
}

void bindState(nb::module_& m) {
  using State = SimulationState;
  nb::class_<State>(m, "SimulationState", docs::simulation::state)
      .def_rw("time", &State::time, "Time, s.")
      .def_prop_rw(
          "q", [](const State& s) { return toNumpy(s.q); }, [](State& s, const Numbers& q) { s.q = q.values; },
          "Joint state, (n,).")
      .def_prop_rw(
          "qDot", [](const State& s) { return toNumpy(s.qDot); }, [](State& s, const Numbers& q) { s.qDot = q.values; },
          "Joint velocities, (n,).")
      .def_prop_rw(
          "freePos", [](const State& s) { return toNumpy(s.freePos); },
          [](State& s, const Numbers& p) { s.freePos = p.matrix(); },
          "World poses of the free frames, (F, 7): x y z (m) qw qx qy qz.")
      .def_prop_rw(
          "freeVel", [](const State& s) { return velocityArray(s.freeVel); },
          [](State& s, const Numbers& v) { s.freeVel = velocityMatrix(v, "freeVel"); },
          "Velocities of the free frames, (F, 2, 3): linear (m/s) and angular (rad/s), world.")
      .def(
          "__eq__",
          [](const State& a, nb::handle b) { return nb::isinstance<State>(b) && a == nb::cast<const State&>(b); },
          "other"_a)
      .def("__repr__",
           [](const State& s) {
             return cat("<SimulationState at ", s.time, " s: ", s.q.size(), " joint values, ", s.freePos.rows(),
                        " free frames>");
           })
      .def("__getstate__",
           [](const State& s) {
             return nb::make_tuple(s.time, toNumpy(s.q), toNumpy(s.qDot), toNumpy(s.freePos), velocityArray(s.freeVel),
                                   nb::bytes(s.remainder.data(), s.remainder.size()));
           })
      .def("__setstate__", [](State& s, const nb::tuple& parts) {
        const auto rest = nb::cast<nb::bytes>(parts[5]);
        const auto poses = nb::cast<Numbers>(parts[3]);
        new (&s) State{nb::cast<double>(parts[0]),
                       nb::cast<Numbers>(parts[1]).values,
                       nb::cast<Numbers>(parts[2]).values,
                       poses.values.size() ? poses.matrix() : MatrixXd(0, 7),
                       velocityMatrix(nb::cast<Numbers>(parts[4]), "freeVel"),
                       std::string(rest.c_str(), rest.size())};
      });
}

void bindMeasuring(nb::class_<PySimulation>& simulation) {
  using S = PySimulation;
  simulation.def("getContacts", contacts, docs::simulation::getContacts)
      .def(
          "getJointTorques", [](const S& s) { return toNumpy(s.simulation.getJointTorques()); },
          docs::simulation::getJointTorques)
      .def(
          "getExternalTorques", [](const S& s) { return toNumpy(s.simulation.getExternalTorques()); },
          docs::simulation::getExternalTorques)
      .def(
          "addForceTorqueSensor",
          [](S& s, const FrameArgument& frame) { s.simulation.addForceTorqueSensor(name(s, frame)); }, "frame"_a,
          docs::simulation::addForceTorqueSensor)
      .def(
          "getForceTorque",
          [](const S& s, const FrameArgument& f) { return toNumpy(VectorXd(s.simulation.getForceTorque(name(s, f)))); },
          "frame"_a, docs::simulation::getForceTorque)
      .def(
          "addAccelerometer", [](S& s, const FrameArgument& f) { s.simulation.addAccelerometer(name(s, f)); },
          "frame"_a, docs::simulation::addAccelerometer)
      .def(
          "getAcceleration",
          [](const S& s, const FrameArgument& f) {
            return toNumpy(VectorXd(s.simulation.getAcceleration(name(s, f))));
          },
          "frame"_a, docs::simulation::getAcceleration)
      .def(
          "applyForce",
          [](S& s, const FrameArgument& frame, const Numbers& force, const Numbers& torque, const Numbers& point) {
            std::optional<Vector3d> at;
            if (point.values.size() > 0) at = vector3(point, "Simulation.applyForce: point");
            s.simulation.applyForce(
                name(s, frame), vector3(force, "Simulation.applyForce: force"),
                torque.values.size() ? vector3(torque, "Simulation.applyForce: torque") : Vector3d::Zero(), at);
          },
          "frame"_a, "force"_a, "torque"_a = nb::list(), "point"_a = nb::list(), docs::simulation::applyForce)
      .def(
          "perturb",
          [](S& s, const FrameArgument& frame, const Numbers& point, const Numbers& target) {
            s.simulation.perturb(name(s, frame), vector3(point, "Simulation.perturb: point"),
                                 vector3(target, "Simulation.perturb: target"));
          },
          "frame"_a, "point"_a, "target"_a, docs::simulation::perturb)
      .def(
          "endPerturbation", [](S& s) { s.simulation.endPerturbation(); }, docs::simulation::endPerturbation)
      .def("getPerturbation", getPerturbation, nb::sig("def getPerturbation(self) -> dict | None"),
           docs::simulation::getPerturbation)
      .def(
          "clearForces", [](S& s) { s.simulation.clearForces(); }, docs::simulation::clearForces);
}

void bindGrippers(nb::class_<PySimulation>& simulation) {
  using S = PySimulation;
  simulation
      .def(
          "moveGripper",
          [](S& s, const FrameArgument& f, double width, double speed) {
            s.simulation.moveGripper(name(s, f), width, speed);
          },
          "gripperFrameName"_a, "width"_a, "speed"_a = .3, docs::simulation::moveGripper)
      .def(
          "closeGripper",
          [](S& s, const FrameArgument& f, double width, double speed, double force) {
            s.simulation.closeGripper(name(s, f), width, speed, force);
          },
          "gripperFrameName"_a, "width"_a = 0., "speed"_a = .3, "force"_a = 20., docs::simulation::closeGripper)
      .def(
          "gripperIsDone", [](const S& s, const FrameArgument& f) { return s.simulation.gripperIsDone(name(s, f)); },
          "gripperFrameName"_a, docs::simulation::gripperIsDone)
      .def(
          "getGripperWidth",
          [](const S& s, const FrameArgument& f) { return s.simulation.getGripperWidth(name(s, f)); },
          "gripperFrameName"_a, docs::simulation::getGripperWidth)
      .def(
          "attach",
          [](S& s, const FrameArgument& a, const FrameArgument& b) { s.simulation.attach(name(s, a), name(s, b)); },
          "frm"_a, "to"_a, docs::simulation::attach)
      .def(
          "detach",
          [](S& s, const FrameArgument& a, const FrameArgument& b) { s.simulation.detach(name(s, a), name(s, b)); },
          "frm"_a, "to"_a, docs::simulation::detach);
}

nb::typed<nb::tuple, ByteArray, FloatArray> getImageAndDepth(PySimulation& s) {
  const DepthNoise noise = depthNoise();
  CameraImage image;
  {
    const nb::gil_scoped_release unlock;
    image = s.simulation.getImageAndDepth(noise);
  }
  return nb::make_tuple(rgbOf(image), depthOf(image));
}

void bindCameras(nb::class_<PySimulation>& simulation) {
  using S = PySimulation;
  simulation
      .def(
          "addSensor",
          [](S& s, const std::string& sensor, const std::string& frame) { s.simulation.addSensor(sensor, frame); },
          "sensorName"_a, "frameAttached"_a = "", docs::simulation::addSensor)
      .def(
          "selectSensor", [](S& s, const std::string& sensor) { s.simulation.selectSensor(sensor); }, "sensorName"_a,
          docs::simulation::selectSensor)
      .def(
          "setCamera",
          [](S& s, const FrameArgument& frame) {
            s.simulation.setCamera(name(s, frame));
            return s.simulation.camera();
          },
          "sensorName"_a, docs::simulation::setCamera)
      .def(
          "getFxycxy", [](const S& s) { return fxycxyOf(s.simulation.camera()); },
          "fx, fy, cx, cy of the selected camera in pixels, shape (4,).")
      .def("getImageAndDepth", getImageAndDepth, docs::simulation::getImageAndDepth)
      .def(
          "setSimulateDepthNoise", [](S& s, bool noisy) { s.simulation.setSimulateDepthNoise(noisy); },
          "_setSimulateDepthNoise"_a, docs::simulation::setSimulateDepthNoise)
      .def_static(
          "depthData2pointCloud",
          [](const nb::ndarray<const float, nb::ndim<2>, nb::c_contig, nb::device::cpu>& depth, const Numbers& fxycxy) {
            if (fxycxy.values.size() != 4)
              throw ValueError(cat("depthData2pointCloud: fxycxy has ", fxycxy.values.size(), " entries; expected 4"));
            const std::size_t height = depth.shape(0), width = depth.shape(1);
            return toImage<Array>(depthToPoints(depth.data(), int(height), int(width), Vector4d(fxycxy.values)),
                                  {height, width, 3});
          },
          "depth"_a, "fxycxy"_a, docs::simulation::depthData2pointCloud);
}

void bindSplines(nb::class_<PySimulation>& simulation) {
  using S = PySimulation;
  simulation
      .def(
          "setSplineRef",
          [](S& s, const Numbers& path, const Numbers& times, bool append) {
            s.simulation.setSplineRef(path.matrix(), times.values, append);
          },
          "path"_a, "times"_a, "append"_a = true, docs::simulation::setSplineRef)
      .def(
          "getTimeToSplineEnd", [](const S& s) { return s.simulation.getTimeToSplineEnd(); },
          docs::simulation::getTimeToSplineEnd)
      .def(
          "resetSplineRef", [](S& s, double time) { s.simulation.resetSplineRef(time); }, "ctrl_time"_a = -1.,
          docs::simulation::resetSplineRef)
      .def("multi_step", multiStep, "tau_step"_a, "tau_sim"_a = .01, docs::simulation::multi_step);
}

}  // namespace

SimulationOptions optionsFrom(nb::handle given) {
  if (nb::isinstance<SimulationOptions>(given)) return nb::cast<const SimulationOptions&>(given);
  SimulationOptions chosen = startOptions();
  if (nb::isinstance<nb::dict>(given)) {
    simulationOptions().setFields(chosen, nb::cast<nb::dict>(given));
  } else if (!given.is_none()) {
    throw nb::type_error("Simulation: options: expected SimulationOptions or a dict");
  }
  return chosen;
}

void bindSimulation(nb::module_& m) {
  using S = PySimulation;
  nb::enum_<SimulationEngine>(m, "SimulationEngine", nb::is_arithmetic(), "The engine of a Simulation.")
      .value("physx", SimulationEngine::physx,
             "Rigid bodies with contacts: MuJoCo, under the name in reference scripts.")
      .value("bullet", SimulationEngine::bullet, "Refused.")
      .value("kinematic", SimulationEngine::kinematic, "Joints follow their references exactly; nothing else moves.");
  nb::enum_<ControlMode>(m, "ControlMode", nb::is_arithmetic(), "The meaning of commands of Simulation and BotOp.")
      .value("none", ControlMode::none, "No vector: motors keep their targets.")
      .value("position", ControlMode::position, "q at the end of the step.")
      .value("velocity", ControlMode::velocity, "dq/dt.")
      .value("acceleration", ControlMode::acceleration, "Acceleration of the reference.")
      .value("positionVelocity", ControlMode::positionVelocity, "q and dq/dt at the end of the step, (2n,).")
      .value("spline", ControlMode::spline, "No vector: along the spline.")
      .value("torque", ControlMode::torque, "Joint torques, N m or N.");
  nb::class_<SimulationOptions> options(m, "SimulationOptions",
                                        "Settings of a Simulation; every field can be given by name.");
  simulationOptions().bind(options, "SimulationOptions", startOptions);
  bindState(m);

  nb::class_<PySimulation> simulation(m, "Simulation", docs::simulation::type);
  simulation
      .def("__init__", makeSimulation, "C"_a, "engine"_a = SimulationEngine::physx, "verbose"_a = nb::none(),
           "options"_a = nb::none(),
           nb::sig("def __init__(self, C: Config, engine: SimulationEngine = ..., verbose: int | None = "
                   "None, options: SimulationOptions | dict | None = None) -> None"),
           docs::simulation::make)
      .def("step", stepSimulation, "u_control"_a = nb::list(), "tau"_a = .01, "u_mode"_a = ControlMode::none,
           docs::simulation::step)
      .def(
          "get_t", [](const S& s) { return s.simulation.get_t(); }, "Simulated time, s.")
      .def(
          "get_q", [](const S& s) { return toNumpy(s.simulation.get_q()); }, "Joint state, (n,).")
      .def(
          "get_qDot", [](const S& s) { return toNumpy(s.simulation.get_qDot()); }, "Velocity of the joint state, (n,).")
      .def(
          "get_qRef", [](const S& s) { return toNumpy(s.simulation.getReference()); },
          "The joint state that the motors track, (n,).")
      .def(
          "resetTime", [](S& s, double time) { s.simulation.resetTime(time); }, "time"_a = 0.,
          docs::simulation::resetTime)
      .def(
          "getFreeFrames", [](const S& s) { return s.simulation.getFreeFrames(); }, docs::simulation::getFreeFrames)
      .def(
          "get_frameVelocities", [](const S& s) { return velocityArray(s.simulation.get_frameVelocities()); },
          docs::simulation::get_frameVelocities)
      .def(
          "getState", [](const S& s) { return s.simulation.getState(); }, docs::simulation::getState)
      .def("setState", setState, "state"_a, "jointState"_a = nb::list(), "frameVelocities"_a = nb::list(),
           "jointVelocities"_a = nb::list(),
           nb::sig(
               "def setState(self, state: SimulationState | numpy.typing.ArrayLike, "
               "jointState: numpy.typing.ArrayLike = [], "
               "frameVelocities: numpy.typing.ArrayLike = [], jointVelocities: numpy.typing.ArrayLike = []) -> None"),
           docs::simulation::setState)
      .def("pushConfigToSim", pushConfig, "frameVelocities"_a = nb::list(), "jointVelocities"_a = nb::list(),
           docs::simulation::pushConfigToSim)
      .def(
          "setVerbose", [](S& s, int verbose) { applyVerbosity(s, verbose); }, "verbose"_a,
          docs::simulation::setVerbose)
      .def("__repr__", [](const S& s) {
        return cat("<Simulation at ", s.simulation.get_t(), " s: ", s.simulation.config().getFrameDimension(),
                   " frames, ", s.simulation.getFreeFrames().size(), " of them free>");
      });
  simulation.def_prop_ro(
      "options", [](const S& s) { return s.simulation.options(); }, "A copy of its settings.");
  bindSplines(simulation);
  bindGrippers(simulation);
  bindMeasuring(simulation);
  bindCameras(simulation);
  bindRecording(m, simulation);
  bindSimulationView(simulation);
  bindSimulationBatch(m);
}

}  // namespace kinegraph::python
