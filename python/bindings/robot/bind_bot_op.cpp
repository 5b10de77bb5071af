#include <nanobind/stl/optional.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <set>

#include "arguments.h"
#include "bindings.h"
#include "kinegraph/api/bot_stage.h"
#include "kinegraph/common/interrupt_monitor.h"
#include "kinegraph/robot/bot_op.h"
#include "kinegraph/robot/drivers.h"
#include "kinegraph/trajectories/trajectory.h"
#include "parameters.h"
#include "rendering/images.h"
#include "robot/robot_docs.h"
#include "robot/robot_objects.h"
#include "scene/contact_dicts.h"
#include "viewer/py_viewer.h"

namespace kinegraph::python {

namespace {

BotOpOptions optionsOf(PyConfig& config, bool realtime) {
  BotOpOptions options;
  options.period = parameter("botsim/tau", options.period, "a time in s");
  options.hyper_speed = parameter("botsim/hyperSpeed", options.hyper_speed, "a number");
  options.realtime = realtime || parameter("botsim/realtime", false, "True or False");
  const auto stage = std::make_shared<BotStage>(config.viewer, interrupted);
  options.show = [stage](const BotOp& bot, Config& shown, const std::string& message) {
    return stage->show(bot, shown, static_cast<PyConfig&>(shown).viewer, message);
  };
  options.watched = [stage] { return stage->isWatched(); };
  options.cancellation = checkInterrupt;
  if (options.realtime)
    options.interrupted = [watch = std::make_shared<InterruptMonitor>()] { return watch->wasInterrupted(); };
  return options;
}

/// The robot in a copy of the scene, with the engine of parameter botsim/engine.
std::shared_ptr<RobotDriver> simulatedDriver(const PyConfig& config) {
  const auto engine = parameter<std::string>("botsim/engine", "physx", "'physx' or 'kinematic'");
  if (engine == "kinematic") return std::make_shared<KinematicDriver>(config);
  if (engine != "physx")
    throw ValueError(cat("parameter botsim/engine is '", engine, "'; expected 'physx' or 'kinematic'"));
  return std::make_shared<SimulatedDriver>(config);
}

void makeBot(PyBotOp* self, PyConfig& config, bool use_real_robot, bool, std::shared_ptr<RobotDriver> driver,
             bool realtime, bool strict) {
  if (parameter("bot/blockRealRobot", false, "True or False")) {
    use_real_robot = false;
    driver = nullptr;
  }
  if (use_real_robot && !driver)
    throw ValueError(
        "BotOp: useRealRobot needs a driver: BotOp(C, True, driver=...); kinegraph.robots has drivers, and subclasses "
        "of RobotDriver are drivers, too");
  const bool is_there = driver && !driver->world();
  BotOpOptions options = optionsOf(config, realtime || (is_there && use_real_robot));
  if (!driver) driver = simulatedDriver(config);
  options.safety.lag_stops = strict || is_there;
  std::unique_ptr<BotOp> bot;
  {
    const nb::gil_scoped_release unlock;
    bot = std::make_unique<BotOp>(config, std::move(driver), std::move(options));
  }
  new (self) PyBotOp(std::move(bot));
}

/// Calls a method without array arguments, without the interpreter lock.
template <class Result, class... Args>
auto call(Result (BotOp::*method)(Args...)) {
  return [method](PyBotOp& self, Args... args) -> Result {
    const nb::gil_scoped_release unlock;
    return (*self.*method)(std::forward<Args>(args)...);
  };
}

template <class Result, class... Args>
auto call(Result (BotOp::*method)(Args...) const) {
  return [method](const PyBotOp& self, Args... args) -> Result {
    const nb::gil_scoped_release unlock;
    return (*self.*method)(std::forward<Args>(args)...);
  };
}

template <auto method>
Array vectorOf(PyBotOp& self) {
  VectorXd numbers;
  {
    const nb::gil_scoped_release unlock;
    numbers = (*self.*method)();
  }
  return toNumpy(numbers);
}

void bindState(nb::class_<PyBotOp>& bot) {
  bot.def("get_t", call(&BotOp::get_t),
          "Returns the control time, s. A repeated query at the same time advances it by one period.")
      .def("get_q", vectorOf<&BotOp::get_q>, "Returns the robot's joint values, (n,) rad or m.")
      .def("get_qDot", vectorOf<&BotOp::get_qDot>, "Returns the robot's joint velocities, (n,) rad/s or m/s.")
      .def("get_qHome", vectorOf<&BotOp::get_qHome>,
           "Returns the initial joint values of the configuration, (n,) rad or m.")
      .def("get_tauExternal", vectorOf<&BotOp::get_tauExternal>, docs::robot::get_tauExternal)
      .def("getTimeToEnd", call(&BotOp::getTimeToEnd), docs::robot::getTimeToEnd)
      .def(
          "getKeyPressed", [](const PyBotOp& b) { return b->getKeyPressed(); },
          "Returns the key of the last sync, or 0.")
      .def(
          "getInfo", [](const PyBotOp& b) { return RobotInfo(b->getInfo()); },
          "Returns the RobotInfo of the robot, with its limits.")
      .def("getFault", call(&BotOp::getFault), "Returns the cause of the fault; empty without one.")
      .def("takeWarning", call(&BotOp::takeWarning),
           "Returns and clears the warnings so far, joined; empty without one. With strict=False, a joint that came "
           "too far "
           "from its command is one.")
      .def("getMode", call(&BotOp::getMode), "Returns the present control mode.");
}

void bindMotions(nb::class_<PyBotOp>& bot) {
  bot.def(
         "moveTo",
         [](PyBotOp& b, const Numbers& q, double cost, bool overwrite) {
           const nb::gil_scoped_release unlock;
           b->moveTo(q.values, cost, overwrite);
         },
         "q_target"_a, "timeCost"_a = 1., "overwrite"_a = false, docs::robot::moveTo)
      .def(
          "move",
          [](PyBotOp& b, const Numbers& path, const Numbers& times, bool overwrite, double cut) {
            const MatrixXd points = path.matrix();
            const nb::gil_scoped_release unlock;
            b->move(points, times.values, overwrite, cut);
          },
          "path"_a, "times"_a, "overwrite"_a = false, "overwriteCtrlTime"_a = -1., docs::robot::move)
      .def(
          "moveAutoTimed",
          [](PyBotOp& b, const Numbers& path, double velocity, double acceleration) {
            const MatrixXd points = path.matrix();
            const nb::gil_scoped_release unlock;
            b->moveAutoTimed(points, velocity, acceleration);
          },
          "path"_a, "maxVel"_a = 1., "maxAcc"_a = 1., docs::robot::moveAutoTimed)
      .def(
          "follow",
          [](PyBotOp& b, const Trajectory& motion, double tolerance, double velocity_tolerance, bool overwrite,
             double start_time) {
            const nb::gil_scoped_release unlock;
            b->follow(motion, {tolerance, velocity_tolerance, overwrite, start_time});
          },
          "motion"_a, nb::kw_only(), "tolerance"_a = FollowOptions().tolerance,
          "velocity_tolerance"_a = FollowOptions().velocity_tolerance, "overwrite"_a = false,
          "start_time"_a = FollowOptions().start_time, docs::robot::follow)
      .def(
          "follow",
          [](PyBotOp& b, const BSpline& motion, double tolerance, double velocity_tolerance, bool overwrite,
             double start_time) {
            const nb::gil_scoped_release unlock;
            b->follow(SplineTrajectory(motion), {tolerance, velocity_tolerance, overwrite, start_time});
          },
          "motion"_a, nb::kw_only(), "tolerance"_a = FollowOptions().tolerance,
          "velocity_tolerance"_a = FollowOptions().velocity_tolerance, "overwrite"_a = false,
          "start_time"_a = FollowOptions().start_time, docs::robot::follow)
      .def("hold", call(&BotOp::hold), "Stops at once and stays, at full stiffness.")
      .def("floating", call(&BotOp::floating), "damping"_a = 0., docs::robot::floating)
      .def(
          "setCompliance",
          [](PyBotOp& b, const Numbers& J, double compliance) {
            const MatrixXd rows = J.matrix();
            const nb::gil_scoped_release unlock;
            b->setCompliance(rows, compliance);
          },
          "J"_a, "compliance"_a = .5, docs::robot::setCompliance)
      .def("stepObservation", call(&BotOp::stepObservation), "Returns the present state and reference of the robot.")
      .def(
          "stepAction",
          [](PyBotOp& b, const Numbers& delta, const StepObservation& observation, double lambda,
             double max_acceleration, double xi) {
            const nb::gil_scoped_release unlock;
            b->stepAction(delta.values, observation, lambda, max_acceleration, xi);
          },
          "delta"_a, "obs"_a, "lmbda"_a, "maxAccel"_a = 5., "xi"_a = 1., docs::robot::stepAction)
      .def(
          "home",
          [](PyBotOp& b, PyConfig& c) {
            const nb::gil_scoped_release unlock;
            b->home(c);
          },
          "C"_a, docs::robot::home)
      .def(
          "stop",
          [](PyBotOp& b, PyConfig& c) {
            const nb::gil_scoped_release unlock;
            b->stop(c);
          },
          "C"_a, docs::robot::stop)
      .def("recover", call(&BotOp::recover), "Clears a fault, and holds the robot at its present q.")
      .def(
          "setLimits",
          [](PyBotOp& b, const Numbers& velocity, const Numbers& acceleration, const Numbers& effort) {
            const nb::gil_scoped_release unlock;
            b->setLimits(velocity.values, acceleration.values, effort.values);
          },
          "velocity"_a = nb::list(), "acceleration"_a = nb::list(), "effort"_a = nb::list(), docs::robot::setLimits);
}

/// Calls a function of Python from waiting calls; it is stored where Python's garbage collector finds it.
void watch(PyBotOp& self, const nb::callable& function, double period) {
  const long number = self.next_watch++;
  const auto call = [&self, number](double time) {
    const nb::gil_scoped_acquire lock;
    const auto found = self.watched.find(number);
    if (found == self.watched.end()) return false;
    try {
      if (nb::object(found->second)(time).ptr() != Py_False) return true;
    } catch (...) {
      self.watched.erase(number);
      throw;
    }
    self.watched.erase(number);
    return false;
  };
  self.watched.emplace(number, function);
  try {
    const nb::gil_scoped_release unlock;  // the robot's thread may hold the robot, and wait for the interpreter
    self->watch(period, call);
  } catch (...) {
    self.watched.erase(number);
    throw;
  }
}

int traverseBot(PyObject* self, visitproc visit, void* arg) {
  Py_VISIT(Py_TYPE(self));
  if (!nb::inst_ready(self)) return 0;
  Py_VISIT(nb::inst_ptr<PyBotOp>(self)->recorder.ptr());
  for (const auto& [number, function] : nb::inst_ptr<PyBotOp>(self)->watched) Py_VISIT(function.ptr());
  return 0;
}

int clearBot(PyObject* self) {
  nb::inst_ptr<PyBotOp>(self)->watched.clear();
  nb::inst_ptr<PyBotOp>(self)->recorder.reset();
  return 0;
}

PyType_Slot bot_slots[] = {{Py_tp_traverse, reinterpret_cast<void*>(traverseBot)},
                           {Py_tp_clear, reinterpret_cast<void*>(clearBot)},
                           {0, nullptr}};

void bindTime(nb::class_<PyBotOp>& bot) {
  bot.def(
      "watch", [](PyBotOp& b, double period, const nb::callable& function) { watch(b, function, period); }, "period"_a,
      "function"_a,
      nb::sig("def watch(self, period: float, function: collections.abc.Callable[[float], object]) -> None"),
      docs::robot::watch);
  bot.def(
         "sync",
         [](PyBotOp& b, PyConfig& c, double seconds, const std::string& message) {
           const nb::gil_scoped_release unlock;
           return b->sync(c, seconds, message);
         },
         "C"_a, "waitTime"_a = .1, "viewMsg"_a = "", docs::robot::sync)
      .def(
          "wait",
          [](PyBotOp& b, PyConfig& c, bool key, bool end, bool gripper, double period) {
            const nb::gil_scoped_release unlock;
            return b->wait(c, key, end, gripper, period);
          },
          "C"_a, "forKeyPressed"_a = true, "forTimeToEnd"_a = true, "forGripper"_a = false, "syncFrequency"_a = .05,
          docs::robot::wait);
}

/// Emits the warning of a call; the robot's thread may hold the robot, and wait for the interpreter.
void emitWarnings(PyBotOp& bot) {
  if (const std::string warning = call(&BotOp::takeWarning)(bot); !warning.empty()) emitWarning(warning);
}

void bindGrippers(nb::class_<PyBotOp>& bot) {
  bot.def(
         "gripperMove",
         [](PyBotOp& b, int id, double width, double speed) {
           call (&BotOp::gripperMove)(b, id, width, speed);
           emitWarnings(b);
         },
         "id"_a, "width"_a = .075, "speed"_a = .2, docs::robot::gripperMove)
      .def("gripperClose", call(&BotOp::gripperClose), "id"_a, "force"_a = 10., "width"_a = .05, "speed"_a = .1,
           docs::robot::gripperClose)
      .def(
          "gripperCloseGrasp",
          [](PyBotOp& b, int id, const std::string& object, double force, double width, double speed) {
            call (&BotOp::gripperCloseGrasp)(b, id, object, force, width, speed);
            emitWarnings(b);
          },
          "id"_a, "objName"_a, "force"_a = 10., "width"_a = .05, "speed"_a = .1, docs::robot::gripperCloseGrasp)
      .def("getGripperPos", call(&BotOp::getGripperPos), "id"_a, docs::robot::getGripperPos)
      .def("getGripperTarget", call(&BotOp::getGripperTarget), "id"_a, docs::robot::getGripperTarget)
      .def("gripperDone", call(&BotOp::gripperDone), "id"_a, docs::robot::gripperDone);
}

void bindWorld(nb::class_<PyBotOp>& bot) {
  bot.def(
         "attach",
         [](PyBotOp& b, const std::string& from, const std::string& to) {
           const nb::gil_scoped_release unlock;
           b->attach(from, to);
         },
         "from_"_a, "to"_a, docs::robot::attach)
      .def(
          "detach",
          [](PyBotOp& b, const std::string& from, const std::string& to) {
            const nb::gil_scoped_release unlock;
            b->detach(from, to);
          },
          "from_"_a, "to"_a, docs::robot::detach)
      .def(
          "setFramePose",
          [](PyBotOp& b, const std::string& frame, const Numbers& pose) {
            const Pose X = Pose::fromNumbers(pose.values);
            const nb::gil_scoped_release unlock;
            b->setFramePose(frame, X);
          },
          "frame"_a, "pose"_a, docs::robot::setFramePose)
      .def(
          "getWorld", [](PyBotOp& b) { return PyConfig{call(&BotOp::getWorld)(b)}; }, docs::robot::getWorld)
      .def("isSimulated", call(&BotOp::isSimulated), "Tells whether the robot moves in a simulated world.")
      .def(
          "getContacts", [](PyBotOp& b) { return contactDicts(call(&BotOp::getContacts)(b)); },
          docs::robot::getContacts);
}

void bindCameras(nb::class_<PyBotOp>& bot) {
  const auto image = [](PyBotOp& b, const std::string& camera) {
    const nb::gil_scoped_release unlock;
    return b->getImageAndDepth(camera);
  };
  bot.def(
         "getImageAndDepth",
         [image](PyBotOp& b, const std::string& camera) -> nb::typed<nb::tuple, ByteArray, FloatArray> {
           CameraImage rendered = image(b, camera);
           return nb::make_tuple(rgbOf(rendered), depthOf(rendered));
         },
         "sensorName"_a, docs::robot::getImageAndDepth)
      .def(
          "getImage",
          [image](PyBotOp& b, const std::string& camera) {
            CameraImage rendered = image(b, camera);
            return rgbOf(rendered);
          },
          "sensorName"_a, docs::robot::getImage)
      .def(
          "getImageDepthPcl",
          [](PyBotOp& b, const std::string& camera, bool global) -> nb::typed<nb::tuple, ByteArray, FloatArray, Array> {
            std::pair<CameraImage, std::vector<double>> rendered;
            {
              const nb::gil_scoped_release unlock;
              rendered = b->getImageDepthPcl(camera, global);
            }
            const auto height = std::size_t(rendered.first.height), width = std::size_t(rendered.first.width);
            return nb::make_tuple(rgbOf(rendered.first), depthOf(rendered.first),
                                  toImage<Array>(std::move(rendered.second), {height, width, 3}));
          },
          "sensorName"_a, "globalCoordinates"_a = false, docs::robot::getImageDepthPcl)
      .def(
          "getCameraFxycxy",
          [](PyBotOp& b, const std::string& camera) {
            VectorXd numbers;
            {
              const nb::gil_scoped_release unlock;
              numbers = b->getCameraFxycxy(camera);
            }
            return toNumpy(numbers);
          },
          "sensorName"_a, docs::robot::getCameraFxycxy);
}

void bindRecords(nb::module_& m, nb::class_<PyBotOp>& bot) {
  nb::class_<CommandLog>(m, "CommandLog", docs::robot::CommandLog)
      .def(nb::init<>(), "An empty log.")
      .def_ro("period", &CommandLog::period, "Control period, s.")
      .def_ro("ticks", &CommandLog::ticks, "Number of control periods.")
      .def("__len__", [](const CommandLog& log) { return log.entries.size(); })
      .def("text", &CommandLog::text, "Returns the log as text: one command per line, with all digits of its numbers.")
      .def(
          "save", [](const CommandLog& log, const PathText& path) { log.save(path.text); }, "path"_a,
          docs::robot::saveLog)
      .def_static(
          "load", [](const PathText& path) { return CommandLog::load(path.text); }, "path"_a, docs::robot::loadLog)
      .def_static(
          "fromText", [](const std::string& text) { return CommandLog::fromText(text); }, "text"_a,
          docs::robot::logFromText)
      .def(
          "__eq__", [](const CommandLog& a, const CommandLog& b) { return a.text() == b.text(); }, nb::is_operator());
  bot.def("getLog", call(&BotOp::getLog), "Returns all commands so far, a CommandLog.")
      .def(
          "replay",
          [](PyBotOp& b, const CommandLog& log) {
            const nb::gil_scoped_release unlock;
            b->replay(log);
          },
          "log"_a, docs::robot::replay)
      .def(
          "recordTo",
          [](nb::handle self, const PathText& path, double rate, nb::handle cameras, double camera_rate, double start) {
            nb::cast<PyBotOp&>(self).recordTo(self, path.text, rate, cameras, camera_rate, start);
          },
          "path"_a, nb::kw_only(), "rate"_a = 100., "cameras"_a = nb::make_tuple(), "camera_rate"_a = 20.,
          "start"_a = 0.,
          nb::sig(
              "def recordTo(self, path: str | os.PathLike[str], *, rate: float = 100.0, "
              "cameras: collections.abc.Sequence[str] = (), camera_rate: float = 20.0, start: float = 0.0) -> None"),
          docs::robot::recordTo)
      .def("close", &PyBotOp::close, "Disconnects the driver. Later calls raise an error.");
}

}  // namespace

void bindRobot(nb::module_& m) {
  bindRobotDriver(m);
  nb::enum_<LoopMode>(m, "LoopMode", "The control mode of a robot.")
      .value("follow", LoopMode::follow, "Follows its reference motion, and rests at the end.")
      .value("hold", LoopMode::hold, "Rests.")
      .value("floating", LoopMode::floating, "Has no stiffness.")
      .value("fault", LoopMode::fault, "Was stopped by a safety limit or by an error of the robot.");
  nb::class_<StepObservation>(m, "StepObservation", "State and reference of a robot at one time.")
      .def_ro("ctrlTime", &StepObservation::ctrl_time, "Control time, s.")
      .def_prop_ro(
          "qpos", [](const StepObservation& o) { return toNumpy(o.qpos); }, "Joint values, (n,) rad or m.")
      .def_prop_ro(
          "qvel", [](const StepObservation& o) { return toNumpy(o.qvel); }, "Joint velocities, (n,).")
      .def_prop_ro(
          "qref", [](const StepObservation& o) { return toNumpy(o.qref); },
          "Reference of the joint values, (n,) rad or m.")
      .def_prop_ro(
          "qvel_ref", [](const StepObservation& o) { return toNumpy(o.qvel_ref); },
          "Reference of the joint velocities, (n,).");
  nb::class_<PyBotOp> bot(m, "BotOp", nb::type_slots(bot_slots), nb::is_weak_referenceable(), docs::robot::BotOp);
  bot.def("__init__", makeBot, "C"_a, "useRealRobot"_a = false, "auto_launch"_a = true, "driver"_a.none() = nb::none(),
          "realtime"_a = false, "strict"_a = true, docs::robot::BotOp_make);
  bindState(bot);
  bindMotions(bot);
  bindToolMoves(bot);
  bindTime(bot);
  bindGrippers(bot);
  bindWorld(bot);
  bindCameras(bot);
  bindRecords(m, bot);
  nb::module_::import_("atexit").attr("register")(nb::cpp_function([] {
    for (PyBotOp* open : PyBotOp::open()) open->close();
  }));
}

}  // namespace kinegraph::python
