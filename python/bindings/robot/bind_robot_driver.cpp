#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>
#include <nanobind/trampoline.h>

#include "arguments.h"
#include "bindings.h"
#include "kinegraph/common/text.h"
#include "kinegraph/robot/drivers.h"
#include "robot/driver_docs.h"
#include "robot/robot_objects.h"

namespace kinegraph::python {

namespace {

/// Translates an exception of a driver in Python into a RobotFault, which stops the robot. An interrupt of the program
/// (Ctrl-C) passes.
template <class Call>
auto fromPython(const char* name, const Call& call) {
  try {
    return call();
  } catch (nb::python_error& error) {
    const nb::gil_scoped_acquire lock;
    if (!error.matches(PyExc_Exception)) throw;
    throw RobotFault(cat("the driver's ", name, "() raised ",
                         nb::cast<std::string>(nb::str(error.type().attr("__name__"))), ": ",
                         nb::cast<std::string>(nb::str(error.value()))));
  } catch (const nb::cast_error&) {
    throw RobotFault(cat("the driver's ", name, "() returned an object of a wrong type"));
  } catch (const Error&) {
    throw;
  } catch (const std::runtime_error&) {  // by nanobind, for a method without override
    throw RobotFault(cat("the driver has no ", name, "(); subclasses of RobotDriver define it"));
  }
}

struct PyRobotDriver : RobotDriver {
  NB_TRAMPOLINE(RobotDriver, 9);

  RobotInfo info() override {
    return fromPython("info", [&]() -> RobotInfo { NB_OVERRIDE_PURE(info); });
  }
  void connect() override {
    fromPython("connect", [&] { NB_OVERRIDE(connect); });
  }
  void disconnect() override {
    fromPython("disconnect", [&] { NB_OVERRIDE(disconnect); });
  }
  RobotState read() override {
    return fromPython("read", [&]() -> RobotState { NB_OVERRIDE_PURE(read); });
  }
  void write(const RobotCommand& command) override {
    fromPython("write", [&] { NB_OVERRIDE_PURE(write, RobotCommand(command)); });
  }
  void stop(const std::string& reason) override {
    fromPython("stop", [&] { NB_OVERRIDE_PURE(stop, reason); });
  }
  void recover() override {
    fromPython("recover", [&] { NB_OVERRIDE(recover); });
  }
  void moveGripper(const GripperCommand& command) override {
    fromPython("moveGripper", [&] { NB_OVERRIDE(moveGripper, GripperCommand(command)); });
  }
  void step(double period) override {
    fromPython("step", [&] { NB_OVERRIDE(step, period); });
  }
};

template <class T>
void vectorField(nb::class_<T>& c, const char* name, VectorXd T::*field, const char* doc) {
  c.def_prop_rw(
      name, [field](const T& self) { return toNumpy(self.*field); },
      [field](T& self, const Numbers& numbers) { self.*field = numbers.values; }, doc);
}

template <class T>
void matrixField(nb::class_<T>& c, const char* name, MatrixXd T::*field, const char* doc) {
  c.def_prop_rw(
      name, [field](const T& self) { return toNumpy(self.*field); },
      [field](T& self, const Numbers& numbers) { self.*field = numbers.values.size() ? numbers.matrix() : MatrixXd(); },
      doc);
}

VectorXd orInfinite(const Numbers& given, std::size_t n, double otherwise) {
  return given.values.size() ? given.values : VectorXd(VectorXd::Constant(Eigen::Index(n), otherwise));
}

void bindGrippers(nb::module_& m) {
  nb::class_<GripperInfo>(m, "GripperInfo",
                          "Name and limits of a gripper. Widths are of the opening between its fingers.")
      .def(nb::init<std::string, double, double, double, double>(), "name"_a, "min_width"_a = 0., "max_width"_a = .08,
           "max_speed"_a = .2, "max_force"_a = 70., docs::robot::GripperInfo)
      .def_rw("name", &GripperInfo::name, "Name of the gripper.")
      .def_rw("min_width", &GripperInfo::min_width, "Smallest width, m.")
      .def_rw("max_width", &GripperInfo::max_width, "Largest width, m.")
      .def_rw("max_speed", &GripperInfo::max_speed, "Largest speed of the width, m/s.")
      .def_rw("max_force", &GripperInfo::max_force, "Largest force, N.");
  nb::class_<GripperState>(m, "GripperState", "The state of a gripper.")
      .def(nb::init<double, bool>(), "width"_a = 0., "is_done"_a = true, docs::robot::GripperState)
      .def_rw("width", &GripperState::width, "Width of the opening, m.")
      .def_rw("is_done", &GripperState::is_done, "It has reached its target width, or an object stops it.");
  nb::class_<GripperCommand>(m, "GripperCommand", "A command to a gripper.")
      .def_ro("gripper", &GripperCommand::gripper, "Number of the gripper, from 0.")
      .def_ro("grasp", &GripperCommand::grasp, "Close until an object stops the fingers, and hold it with `force`.")
      .def_ro("width", &GripperCommand::width, "Target width, or the width of the grasped object, m.")
      .def_ro("speed", &GripperCommand::speed, "Speed of the width, m/s.")
      .def_ro("force", &GripperCommand::force, "Largest force, N.")
      .def_ro("object", &GripperCommand::object, "Frame of the grasped object, if it is known.");
}

void bindInfo(nb::module_& m) {
  nb::class_<RobotInfo> info(
      m, "RobotInfo", "Name, joints, limits and grippers of a robot. Limits are per joint, infinite if there is none.");
  info.def(
          "__init__",
          [](RobotInfo* self, std::string name, std::vector<std::string> joints, const Numbers& lower,
             const Numbers& upper, const Numbers& velocity, const Numbers& acceleration, const Numbers& effort,
             double rate, bool compliant, std::vector<GripperInfo> grippers) {
            const std::size_t n = joints.size();
            const double all = std::numeric_limits<double>::infinity();
            RobotInfo made{std::move(name),
                           std::move(joints),
                           orInfinite(lower, n, -all),
                           orInfinite(upper, n, all),
                           orInfinite(velocity, n, all),
                           orInfinite(acceleration, n, all),
                           orInfinite(effort, n, all),
                           rate,
                           compliant,
                           std::move(grippers)};
            made.validate();
            new (self) RobotInfo(std::move(made));
          },
          "name"_a, "joints"_a, "lower"_a = nb::list(), "upper"_a = nb::list(), "velocity"_a = nb::list(),
          "acceleration"_a = nb::list(), "effort"_a = nb::list(), "rate"_a = 100., "compliant"_a = false,
          "grippers"_a = nb::list(), docs::robot::RobotInfo)
      .def_static(
          "of", [](const PyConfig& config, std::string name) { return RobotInfo::of(config, std::move(name)); },
          "config"_a, "name"_a, docs::robot::RobotInfo_of)
      .def_rw("name", &RobotInfo::name, "Name of the robot, for messages.")
      .def_rw("joints", &RobotInfo::joints, "One name per entry of q.")
      .def_rw("rate", &RobotInfo::rate, "Preferred rate of commands, Hz.")
      .def_rw("compliant", &RobotInfo::compliant, "True if it supports a reduced stiffness.")
      .def_rw("grippers", &RobotInfo::grippers, "List of GripperInfo.");
  vectorField(info, "lower", &RobotInfo::lower, "(n,) lower limits of q, rad or m.");
  vectorField(info, "upper", &RobotInfo::upper, "(n,) upper limits of q, rad or m.");
  vectorField(info, "velocity", &RobotInfo::velocity, "(n,) velocity limits, rad/s or m/s.");
  vectorField(info, "acceleration", &RobotInfo::acceleration, "(n,) acceleration limits, rad/s^2 or m/s^2.");
  vectorField(info, "effort", &RobotInfo::effort, "(n,) effort limits, N m or N.");
}

void bindStates(nb::module_& m) {
  nb::class_<RobotState> state(m, "RobotState", "The state of a robot.");
  state
      .def(
          "__init__",
          [](RobotState* self, double time, const Numbers& q, const Numbers& velocity, const Numbers& effort,
             const Numbers& external, std::vector<GripperState> grippers, std::string error) {
            new (self) RobotState{
                time, q.values, velocity.values, effort.values, external.values, std::move(grippers), std::move(error)};
          },
          "time"_a, "q"_a, "velocity"_a, "effort"_a = nb::list(), "external_effort"_a = nb::list(),
          "grippers"_a = nb::list(), "error"_a = "", docs::robot::RobotState)
      .def_rw("time", &RobotState::time, "Robot's clock, s.")
      .def_rw("grippers", &RobotState::grippers, "List of GripperState.")
      .def_rw("error", &RobotState::error, "Error that the robot reports; empty without one.");
  vectorField(state, "q", &RobotState::q, "(n,) joint values, rad or m.");
  vectorField(state, "velocity", &RobotState::velocity, "(n,) joint velocities, rad/s or m/s.");
  vectorField(state, "effort", &RobotState::effort, "(n,) efforts of the motors, N m or N; empty if unknown.");
  vectorField(state, "external_effort", &RobotState::external_effort,
              "(n,) efforts by contacts, N m or N; empty if unknown.");

  nb::class_<RobotCommand> command(m, "RobotCommand", "The target of a robot at the end of a control period.");
  command.def_ro("period", &RobotCommand::period, "Length of the control period, s.")
      .def_ro("damping", &RobotCommand::damping, "Factor on the robot's damping, if the stiffness is not full.")
      .def("isStiff", &RobotCommand::isStiff, "Tells whether the stiffness is full.");
  vectorField(command, "q", &RobotCommand::q, "(n,) joint values, rad or m.");
  vectorField(command, "velocity", &RobotCommand::velocity, "(n,) joint velocities, rad/s or m/s.");
  vectorField(command, "acceleration", &RobotCommand::acceleration,
              "(n,) accelerations of the reference, rad/s^2 or m/s^2.");
  matrixField(command, "stiffness", &RobotCommand::stiffness,
              "(n, n) factor on the robot's stiffness: identity is full, 0 is none; empty: full.");
}

}  // namespace

void bindRobotDriver(nb::module_& m) {
  bindGrippers(m);
  bindInfo(m);
  bindStates(m);
  nb::class_<RobotDriver, PyRobotDriver>(m, "RobotDriver", docs::robot::RobotDriver)
      .def(nb::init<>(), "For subclasses, which call it in their __init__.")
      .def("info", &RobotDriver::info, "Returns the RobotInfo, which is constant after connect().")
      .def("connect", &RobotDriver::connect, "Connects to the robot. Called once, first.")
      .def("disconnect", &RobotDriver::disconnect, "Disconnects. Called once, last.")
      .def("read", &RobotDriver::read, "Returns the RobotState.")
      .def("write", &RobotDriver::write, "command"_a, docs::robot::write)
      .def("stop", &RobotDriver::stop, "reason"_a, docs::robot::stopRobot)
      .def("recover", &RobotDriver::recover, "Clears errors, so that the robot can move again.")
      .def("moveGripper", &RobotDriver::moveGripper, "command"_a, docs::robot::moveGripper)
      .def("step", &RobotDriver::step, "period"_a, docs::robot::step);
  nb::class_<KinematicDriver, RobotDriver>(m, "KinematicDriver", docs::robot::KinematicDriver)
      .def(
          "__init__", [](KinematicDriver* self, const PyConfig& config) { new (self) KinematicDriver(config); },
          "config"_a, docs::robot::KinematicDriver_make);
  nb::class_<SimulatedDriver, RobotDriver>(m, "SimulatedDriver", docs::robot::SimulatedDriver)
      .def(
          "__init__",
          [](SimulatedDriver* self, const PyConfig& config, const SimulationOptions& options) {
            new (self) SimulatedDriver(config, options);
          },
          "config"_a, "options"_a = SimulationOptions(), docs::robot::SimulatedDriver_make);
  nb::class_<RecordedDriver, RobotDriver>(m, "RecordedDriver", docs::robot::RecordedDriver)
      .def(
          "__init__",
          [](RecordedDriver* self, RobotInfo info, std::vector<RobotState> states, const Numbers& start) {
            new (self) RecordedDriver(std::move(info), std::move(states), start.values);
          },
          "info"_a, "states"_a = nb::list(), "start"_a = nb::list(), docs::robot::RecordedDriver_make)
      .def("commands", &RecordedDriver::commands, "Returns all RobotCommands so far.")
      .def("gripperCommands", &RecordedDriver::gripperCommands, "Returns all GripperCommands so far.")
      .def("stops", &RecordedDriver::stops, "Returns the reasons of all stops.")
      .def("recoveries", &RecordedDriver::recoveries, "Returns the number of recover calls.");
}

}  // namespace kinegraph::python
