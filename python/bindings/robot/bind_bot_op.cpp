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
#include "kinegraph/robot/kinematic_driver.h"
#include "kinegraph/robot/simulated_driver.h"
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

/// The robot in a copy of the scene, as parameter botsim/engine says.
std::shared_ptr<RobotDriver> simulatedDriver(const PyConfig& config) {
  const auto engine = parameter<std::string>("botsim/engine", "physx", "'physx' or 'kinematic'");
  if (engine == "kinematic") return std::make_shared<KinematicDriver>(config);
  if (engine != "physx")
    throw ValueError(cat("parameter botsim/engine is '", engine, "'; expected 'physx' or 'kinematic'"));
  return std::make_shared<SimulatedDriver>(config);
}

void makeBot(PyBotOp* self, PyConfig& config, bool use_real_robot, bool, std::shared_ptr<RobotDriver> driver,
             bool realtime) {
  if (parameter("bot/blockRealRobot", false, "True or False")) {
    use_real_robot = false;
    driver = nullptr;
  }
  if (use_real_robot && !driver)
    throw ValueError(
        "BotOp: useRealRobot needs a driver of the robot: BotOp(C, True, driver=...); kinegraph.robots has some, and "
        "subclasses of RobotDriver are others");
  const bool is_there = driver && !driver->world();
  BotOpOptions options = optionsOf(config, realtime || (is_there && use_real_robot));
  if (!driver) driver = simulatedDriver(config);
  std::unique_ptr<BotOp> bot;
  {
    const nb::gil_scoped_release unlock;
    bot = std::make_unique<BotOp>(config, std::move(driver), std::move(options));
  }
  new (self) PyBotOp(std::move(bot));
}

/// A call of BotOp without arguments that are arrays, made without the interpreter lock.
template <class Result, class... Args>
auto call(Result (BotOp::*method)(Args...)) {
  return [method](PyBotOp& self, Args... args) -> Result {
    const nb::gil_scoped_release unlock;
    return (*self.*method)(std::forward<Args>(args)...);
  };
}

template <class Result>
auto call(Result (BotOp::*method)() const) {
  return [method](const PyBotOp& self) -> Result {
    const nb::gil_scoped_release unlock;
    return (*self.*method)();
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
  bot.def("get_t", call(&BotOp::get_t), "Control time, s. See there: asked again at the same time, it goes on.")
      .def("get_q", vectorOf<&BotOp::get_q>, "Joint values of the robot, (n,) rad or m.")
      .def("get_qDot", vectorOf<&BotOp::get_qDot>, "Joint velocities of the robot, (n,) rad/s or m/s.")
      .def("get_qHome", vectorOf<&BotOp::get_qHome>, "Joint values that the configuration had at first, (n,) rad or m.")
      .def("get_tauExternal", vectorOf<&BotOp::get_tauExternal>, docs::operation::get_tauExternal)
      .def("getTimeToEnd", call(&BotOp::getTimeToEnd), docs::operation::getTimeToEnd)
      .def(
          "getKeyPressed", [](const PyBotOp& b) { return b->getKeyPressed(); }, "The key of the last sync, or 0.")
      .def(
          "getInfo", [](const PyBotOp& b) { return RobotInfo(b->getInfo()); }, "What robot it is, with its limits.")
      .def("getFault", call(&BotOp::getFault), "Why it was stopped; empty if it was not.")
      .def("getMode", call(&BotOp::getMode), "How the robot is moved at present.");
}

void bindMotions(nb::class_<PyBotOp>& bot) {
  bot.def(
         "moveTo",
         [](PyBotOp& b, const Numbers& q, double cost, bool overwrite) {
           const nb::gil_scoped_release unlock;
           b->moveTo(q.values, cost, overwrite);
         },
         "q_target"_a, "timeCost"_a = 1., "overwrite"_a = false, docs::operation::moveTo)
      .def(
          "move",
          [](PyBotOp& b, const Numbers& path, const Numbers& times, bool overwrite, double cut) {
            const MatrixXd points = path.matrix();
            const nb::gil_scoped_release unlock;
            b->move(points, times.values, overwrite, cut);
          },
          "path"_a, "times"_a, "overwrite"_a = false, "overwriteCtrlTime"_a = -1., docs::operation::move)
      .def(
          "moveAutoTimed",
          [](PyBotOp& b, const Numbers& path, double velocity, double acceleration) {
            const MatrixXd points = path.matrix();
            const nb::gil_scoped_release unlock;
            b->moveAutoTimed(points, velocity, acceleration);
          },
          "path"_a, "maxVel"_a = 1., "maxAcc"_a = 1., docs::operation::moveAutoTimed)
      .def(
          "follow",
          [](PyBotOp& b, const BSpline& motion) {
            const nb::gil_scoped_release unlock;
            b->follow(motion);
          },
          "motion"_a, docs::operation::follow)
      .def("hold", call(&BotOp::hold), "Comes to rest at once and stays, stiff. Makes a compliant robot stiff again.")
      .def("floating", call(&BotOp::floating), "damping"_a = 0., docs::operation::floating)
      .def(
          "setCompliance",
          [](PyBotOp& b, const Numbers& J, double compliance) {
            const MatrixXd rows = J.matrix();
            const nb::gil_scoped_release unlock;
            b->setCompliance(rows, compliance);
          },
          "J"_a, "compliance"_a = .5, docs::operation::setCompliance)
      .def("stepObservation", call(&BotOp::stepObservation), "What the robot does and shall do now.")
      .def(
          "stepAction",
          [](PyBotOp& b, const Numbers& delta, const StepObservation& observation, double lambda, double most,
             double xi) {
            const nb::gil_scoped_release unlock;
            b->stepAction(delta.values, observation, lambda, most, xi);
          },
          "delta"_a, "obs"_a, "lmbda"_a, "maxAccel"_a = 5., "xi"_a = 1., docs::operation::stepAction)
      .def(
          "home",
          [](PyBotOp& b, PyConfig& c) {
            const nb::gil_scoped_release unlock;
            b->home(c);
          },
          "C"_a, docs::operation::home)
      .def(
          "stop",
          [](PyBotOp& b, PyConfig& c) {
            const nb::gil_scoped_release unlock;
            b->stop(c);
          },
          "C"_a, docs::operation::stop)
      .def("recover", call(&BotOp::recover), "Goes on after a fault: clears it, and holds the robot where it is.")
      .def(
          "setLimits",
          [](PyBotOp& b, const Numbers& velocity, const Numbers& acceleration, const Numbers& effort) {
            const nb::gil_scoped_release unlock;
            b->setLimits(velocity.values, acceleration.values, effort.values);
          },
          "velocity"_a = nb::list(), "acceleration"_a = nb::list(), "effort"_a = nb::list(),
          docs::operation::setLimits);
}

void bindTime(nb::class_<PyBotOp>& bot) {
  bot.def(
         "sync",
         [](PyBotOp& b, PyConfig& c, double seconds, const std::string& message) {
           const nb::gil_scoped_release unlock;
           return b->sync(c, seconds, message);
         },
         "C"_a, "waitTime"_a = .1, "viewMsg"_a = "", docs::operation::sync)
      .def(
          "wait",
          [](PyBotOp& b, PyConfig& c, bool key, bool end, bool gripper, double period) {
            const nb::gil_scoped_release unlock;
            return b->wait(c, key, end, gripper, period);
          },
          "C"_a, "forKeyPressed"_a = true, "forTimeToEnd"_a = true, "forGripper"_a = false, "syncFrequency"_a = .05,
          docs::operation::wait);
}

void bindGrippers(nb::class_<PyBotOp>& bot) {
  bot.def("gripperMove", call(&BotOp::gripperMove), "id"_a, "width"_a = .075, "speed"_a = .2,
          docs::operation::gripperMove)
      .def("gripperClose", call(&BotOp::gripperClose), "id"_a, "force"_a = 10., "width"_a = .05, "speed"_a = .1,
           docs::operation::gripperClose)
      .def(
          "gripperCloseGrasp",
          [](PyBotOp& b, int id, const std::string& object, double force, double width, double speed) {
            const nb::gil_scoped_release unlock;
            b->gripperCloseGrasp(id, object, force, width, speed);
          },
          "id"_a, "objName"_a, "force"_a = 10., "width"_a = .05, "speed"_a = .1, docs::operation::gripperCloseGrasp)
      .def("getGripperPos", call(&BotOp::getGripperPos), "id"_a, docs::operation::getGripperPos)
      .def("gripperDone", call(&BotOp::gripperDone), "id"_a, docs::operation::gripperDone);
}

void bindWorld(nb::class_<PyBotOp>& bot) {
  bot.def(
         "attach",
         [](PyBotOp& b, const std::string& from, const std::string& to) {
           const nb::gil_scoped_release unlock;
           b->attach(from, to);
         },
         "from_"_a, "to"_a, docs::operation::attach)
      .def(
          "detach",
          [](PyBotOp& b, const std::string& from, const std::string& to) {
            const nb::gil_scoped_release unlock;
            b->detach(from, to);
          },
          "from_"_a, "to"_a, docs::operation::detach)
      .def(
          "setFramePose",
          [](PyBotOp& b, const std::string& frame, const Numbers& pose) {
            const Pose where = Pose::fromNumbers(pose.values);
            const nb::gil_scoped_release unlock;
            b->setFramePose(frame, where);
          },
          "frame"_a, "pose"_a, docs::operation::setFramePose)
      .def(
          "getWorld", [](PyBotOp& b) { return PyConfig{call(&BotOp::getWorld)(b)}; },
          "A copy of the simulated world as it is now: a Config.")
      .def(
          "getContacts", [](PyBotOp& b) { return contactDicts(call(&BotOp::getContacts)(b)); },
          docs::operation::getContacts);
}

void bindCameras(nb::class_<PyBotOp>& bot) {
  const auto image = [](PyBotOp& b, const std::string& camera) {
    const nb::gil_scoped_release unlock;
    return b->getImageAndDepth(camera);
  };
  bot.def(
         "getImageAndDepth",
         [image](PyBotOp& b, const std::string& camera) -> nb::typed<nb::tuple, ByteArray, FloatArray> {
           CameraImage seen = image(b, camera);
           return nb::make_tuple(rgbOf(seen), depthOf(seen));
         },
         "sensorName"_a, docs::operation::getImageAndDepth)
      .def(
          "getImage",
          [image](PyBotOp& b, const std::string& camera) {
            CameraImage seen = image(b, camera);
            return rgbOf(seen);
          },
          "sensorName"_a, docs::operation::getImage)
      .def(
          "getImageDepthPcl",
          [](PyBotOp& b, const std::string& camera, bool global) -> nb::typed<nb::tuple, ByteArray, FloatArray, Array> {
            std::pair<CameraImage, std::vector<double>> seen;
            {
              const nb::gil_scoped_release unlock;
              seen = b->getImageDepthPcl(camera, global);
            }
            const auto height = std::size_t(seen.first.height), width = std::size_t(seen.first.width);
            return nb::make_tuple(rgbOf(seen.first), depthOf(seen.first),
                                  toImage<Array>(std::move(seen.second), {height, width, 3}));
          },
          "sensorName"_a, "globalCoordinates"_a = false, docs::operation::getImageDepthPcl)
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
          "sensorName"_a, docs::operation::getCameraFxycxy);
}

void bindRecords(nb::module_& m, nb::class_<PyBotOp>& bot) {
  nb::class_<CommandLog>(m, "CommandLog", docs::operation::CommandLog)
      .def(nb::init<>(), "An empty log.")
      .def_ro("period", &CommandLog::period, "Period of control, s.")
      .def_ro("ticks", &CommandLog::ticks, "How many periods it is long.")
      .def("__len__", [](const CommandLog& log) { return log.entries.size(); })
      .def("text", &CommandLog::text, "The log as text: a command a line, with numbers that read back as they are.")
      .def(
          "save", [](const CommandLog& log, const PathText& path) { log.save(path.text); }, "path"_a,
          docs::operation::saveLog)
      .def_static(
          "load", [](const PathText& path) { return CommandLog::load(path.text); }, "path"_a, docs::operation::loadLog)
      .def_static(
          "fromText", [](const std::string& text) { return CommandLog::fromText(text); }, "text"_a,
          docs::operation::logFromText)
      .def(
          "__eq__", [](const CommandLog& a, const CommandLog& b) { return a.text() == b.text(); }, nb::is_operator());
  bot.def("getLog", call(&BotOp::getLog), "All that the robot was told so far: a CommandLog.")
      .def(
          "replay",
          [](PyBotOp& b, const CommandLog& log) {
            const nb::gil_scoped_release unlock;
            b->replay(log);
          },
          "log"_a, docs::operation::replay)
      .def(
          "recordTo",
          [](PyBotOp& b, const PathText& path) {
            const nb::gil_scoped_release unlock;
            b->recordTo(path.text);
          },
          "path"_a, docs::operation::recordTo)
      .def("close", &PyBotOp::close, "Ends it: the driver is disconnected. What is called later is an error.");
}

}  // namespace

void bindOperation(nb::module_& m) {
  bindRobotDriver(m);
  nb::enum_<LoopMode>(m, "LoopMode", "How a robot is moved.")
      .value("follow", LoopMode::follow, "Along a motion, and at rest at its end.")
      .value("hold", LoopMode::hold, "At rest.")
      .value("floating", LoopMode::floating, "Without stiffness.")
      .value("fault", LoopMode::fault, "Stopped by a guard or by an error of the robot.");
  nb::class_<StepObservation>(m, "StepObservation", "What a robot does and shall do at one time.")
      .def_ro("ctrlTime", &StepObservation::ctrl_time, "s.")
      .def_prop_ro(
          "qpos", [](const StepObservation& o) { return toNumpy(o.qpos); }, "Joint values as read, (n,) rad or m.")
      .def_prop_ro(
          "qvel", [](const StepObservation& o) { return toNumpy(o.qvel); }, "Joint velocities as read, (n,).")
      .def_prop_ro(
          "qref", [](const StepObservation& o) { return toNumpy(o.qref); }, "Where it shall be, (n,) rad or m.")
      .def_prop_ro(
          "qvel_ref", [](const StepObservation& o) { return toNumpy(o.qvel_ref); }, "How fast it shall be, (n,).");
  nb::class_<PyBotOp> bot(m, "BotOp", nb::is_weak_referenceable(), docs::operation::BotOp);
  bot.def("__init__", makeBot, "C"_a, "useRealRobot"_a = false, "auto_launch"_a = true, "driver"_a.none() = nb::none(),
          "realtime"_a = false, docs::operation::BotOp_make);
  bindState(bot);
  bindMotions(bot);
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
