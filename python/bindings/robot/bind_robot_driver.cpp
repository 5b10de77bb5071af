#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>
#include <nanobind/trampoline.h>

#include "arguments.h"
#include "bindings.h"
#include "kinegraph/common/text.h"
#include "kinegraph/robot/kinematic_driver.h"
#include "kinegraph/robot/recorded_driver.h"
#include "kinegraph/robot/simulated_driver.h"
#include "robot/robot_docs.h"
#include "robot/robot_objects.h"

namespace kinegraph::python {

namespace {

/// What a driver that is written in Python throws stops the robot, as an error of a driver in C++ does. Who ends the
/// program (Ctrl-C) is passed on.
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
    throw RobotFault(cat("the driver's ", name, "() returned something else than it should"));
  } catch (const Error&) {
    throw;
  } catch (const std::runtime_error&) {  // of nanobind
    throw RobotFault(cat("the driver has no ", name, "(); subclasses of RobotDriver write it"));
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
                          "What a gripper of a robot is. Widths are of the opening between its fingers.")
      .def(nb::init<std::string, double, double, double, double>(), "name"_a, "min_width"_a = 0., "max_width"_a = .08,
           "max_speed"_a = .2, "max_force"_a = 70., docs::operation::GripperInfo)
      .def_rw("name", &GripperInfo::name, "Its name.")
      .def_rw("min_width", &GripperInfo::min_width, "m.")
      .def_rw("max_width", &GripperInfo::max_width, "m.")
      .def_rw("max_speed", &GripperInfo::max_speed, "m/s of the width.")
      .def_rw("max_force", &GripperInfo::max_force, "N.");
  nb::class_<GripperState>(m, "GripperState", "A gripper as it is.")
      .def(nb::init<double, bool>(), "width"_a = 0., "is_done"_a = true, docs::operation::GripperState)
      .def_rw("width", &GripperState::width, "m.")
      .def_rw("is_done", &GripperState::is_done, "It has reached the width it was told, or something holds it up.");
  nb::class_<GripperCommand>(m, "GripperCommand", "What a gripper shall do.")
      .def_ro("gripper", &GripperCommand::gripper, "Which one, from 0.")
      .def_ro("grasp", &GripperCommand::grasp,
              "Close until something is between the fingers, and hold it with `force`.")
      .def_ro("width", &GripperCommand::width, "Where to go, or how wide that is which is grasped, m.")
      .def_ro("speed", &GripperCommand::speed, "m/s of the width.")
      .def_ro("force", &GripperCommand::force, "N, at most.")
      .def_ro("object", &GripperCommand::object, "The name of what is grasped, if that is known.");
}

void bindInfo(nb::module_& m) {
  nb::class_<RobotInfo> info(m, "RobotInfo", "What a robot is. Limits are per joint, infinite where there is none.");
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
          "grippers"_a = nb::list(), docs::operation::RobotInfo)
      .def_static(
          "of", [](const PyConfig& config, std::string name) { return RobotInfo::of(config, std::move(name)); },
          "config"_a, "name"_a, docs::operation::RobotInfo_of)
      .def_rw("name", &RobotInfo::name, "Its name, for messages.")
      .def_rw("joints", &RobotInfo::joints, "One name per entry of q.")
      .def_rw("rate", &RobotInfo::rate, "Commands per second that it wants, Hz.")
      .def_rw("compliant", &RobotInfo::compliant, "Can it be less stiff than fully?")
      .def_rw("grippers", &RobotInfo::grippers, "Its grippers.");
  vectorField(info, "lower", &RobotInfo::lower, "(n,) rad or m.");
  vectorField(info, "upper", &RobotInfo::upper, "(n,) rad or m.");
  vectorField(info, "velocity", &RobotInfo::velocity, "(n,) rad/s or m/s.");
  vectorField(info, "acceleration", &RobotInfo::acceleration, "(n,) rad/s^2 or m/s^2.");
  vectorField(info, "effort", &RobotInfo::effort, "(n,) N m or N.");
}

void bindReadings(nb::module_& m) {
  nb::class_<RobotState> state(m, "RobotState", "A robot as it is.");
  state
      .def(
          "__init__",
          [](RobotState* self, double time, const Numbers& q, const Numbers& velocity, const Numbers& effort,
             const Numbers& external, std::vector<GripperState> grippers, std::string error) {
            new (self) RobotState{
                time, q.values, velocity.values, effort.values, external.values, std::move(grippers), std::move(error)};
          },
          "time"_a, "q"_a, "velocity"_a, "effort"_a = nb::list(), "external_effort"_a = nb::list(),
          "grippers"_a = nb::list(), "error"_a = "", docs::operation::RobotState)
      .def_rw("time", &RobotState::time, "Of the robot's clock, s.")
      .def_rw("grippers", &RobotState::grippers, "A GripperState for each of its grippers.")
      .def_rw("error", &RobotState::error, "What the robot says is wrong; empty if nothing is.");
  vectorField(state, "q", &RobotState::q, "(n,) rad or m.");
  vectorField(state, "velocity", &RobotState::velocity, "(n,) rad/s or m/s.");
  vectorField(state, "effort", &RobotState::effort, "(n,) of its motors, N m or N; empty if unknown.");
  vectorField(state, "external_effort", &RobotState::external_effort,
              "(n,) by what it touches, N m or N; empty if unknown.");

  nb::class_<RobotCommand> command(m, "RobotCommand", "Where a robot shall be at the end of a period.");
  command.def_ro("period", &RobotCommand::period, "s from now.")
      .def_ro("damping", &RobotCommand::damping, "Share of the robot's damping where the stiffness is not full.")
      .def("isStiff", &RobotCommand::isStiff, "True if its stiffness is full.");
  vectorField(command, "q", &RobotCommand::q, "(n,) at its end, rad or m.");
  vectorField(command, "velocity", &RobotCommand::velocity, "(n,) at its end, rad/s or m/s.");
  vectorField(command, "acceleration", &RobotCommand::acceleration, "(n,) wanted at its end.");
  matrixField(command, "stiffness", &RobotCommand::stiffness,
              "(n, n) share of the robot's stiffness: identity is full, 0 is none; empty: full.");
}

}  // namespace

void bindRobotDriver(nb::module_& m) {
  bindGrippers(m);
  bindInfo(m);
  bindReadings(m);
  nb::class_<RobotDriver, PyRobotDriver>(m, "RobotDriver", docs::operation::RobotDriver)
      .def(nb::init<>(), "For subclasses.")
      .def("info", &RobotDriver::info, "What robot it is: a RobotInfo, the same at all times after connect().")
      .def("connect", &RobotDriver::connect, "Called once, before all else.")
      .def("disconnect", &RobotDriver::disconnect, "Called once, at the end.")
      .def("read", &RobotDriver::read, "The robot as it is: a RobotState.")
      .def("write", &RobotDriver::write, "command"_a, docs::operation::write)
      .def("stop", &RobotDriver::stop, "reason"_a, docs::operation::stopRobot)
      .def("recover", &RobotDriver::recover, "Clears errors, so that it can be moved again.")
      .def("moveGripper", &RobotDriver::moveGripper, "command"_a, docs::operation::moveGripper)
      .def("step", &RobotDriver::step, "period"_a, docs::operation::step);
  nb::class_<KinematicDriver, RobotDriver>(m, "KinematicDriver", docs::operation::KinematicDriver)
      .def(
          "__init__", [](KinematicDriver* self, const PyConfig& config) { new (self) KinematicDriver(config); },
          "config"_a, docs::operation::KinematicDriver_make);
  nb::class_<SimulatedDriver, RobotDriver>(m, "SimulatedDriver", docs::operation::SimulatedDriver)
      .def(
          "__init__",
          [](SimulatedDriver* self, const PyConfig& config, const SimulationOptions& options) {
            new (self) SimulatedDriver(config, options);
          },
          "config"_a, "options"_a = SimulationOptions(), docs::operation::SimulatedDriver_make);
  nb::class_<RecordedDriver, RobotDriver>(m, "RecordedDriver", docs::operation::RecordedDriver)
      .def(
          "__init__",
          [](RecordedDriver* self, RobotInfo info, std::vector<RobotState> states, const Numbers& start) {
            new (self) RecordedDriver(std::move(info), std::move(states), start.values);
          },
          "info"_a, "states"_a = nb::list(), "start"_a = nb::list(), docs::operation::RecordedDriver_make)
      .def("commands", &RecordedDriver::commands, "All RobotCommands so far.")
      .def("gripperCommands", &RecordedDriver::gripperCommands, "All GripperCommands so far.")
      .def("stops", &RecordedDriver::stops, "The reasons for which it was stopped.")
      .def("recoveries", &RecordedDriver::recoveries, "How often it was told to recover.");
}

}  // namespace kinegraph::python
