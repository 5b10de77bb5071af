#include <nanobind/stl/array.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>

#include "arguments.h"
#include "bindings.h"
#include "control/control.h"
#include "control/streams_docs.h"
#include "kinegraph/api/robot_motion.h"
#include "kinegraph/common/text.h"

namespace kinegraph::python {

namespace {

/// Returns a function of time that computes a pose, with the interpreter lock.
TargetSource sourceOf(nb::handle given) {
  if (nb::isinstance<TargetFile>(given)) return nb::cast<const TargetFile&>(given);
  if (!nb::hasattr(given, "__call__"))
    throw nb::type_error("servo: expected a TargetFile, a Gamepad, a function of the time, or None as source");
  return [function = nb::borrow<nb::object>(given)](double t) -> VectorXd {
    const nb::gil_scoped_acquire lock;
    return nb::cast<Numbers>(function(t)).values;
  };
}

void servoFromPython(DiffIk& ik, const nb::object& config, const std::string& target, const nb::object& source,
                     double seconds, double dt, const std::optional<bool>& show, bool realtime) {
  ServoOptions options;
  options.seconds = seconds, options.dt = dt;
  options.show = show, options.realtime = realtime;
  options.view = [&](Config&) {
    const nb::gil_scoped_acquire lock;
    config.attr("view")();
  };
  options.cancellation = [check = CheckInterrupts()]() mutable { check(); };
  PyConfig& scene = nb::cast<PyConfig&>(config);
  if (source.is_none()) {
    const nb::gil_scoped_release unlock;
    return servo(ik, scene, target, options);
  }
  if (nb::isinstance<Gamepad>(source)) {
    Gamepad& gamepad = nb::cast<Gamepad&>(source);
    const nb::gil_scoped_release unlock;
    return servo(ik, scene, target, gamepad, options);
  }
  const TargetSource poses = sourceOf(source);
  const nb::gil_scoped_release unlock;
  servo(ik, scene, target, poses, options);
}

}  // namespace

void bindStreams(nb::module_& m) {
  nb::class_<TargetFile>(m, "TargetFile", docs::streams::target_file)
      .def(
          "__init__", [](TargetFile* self, const PathText& path) { new (self) TargetFile(path.text); }, "path"_a,
          docs::streams::read)
      .def_prop_ro("duration", &TargetFile::duration, "Time of the last line, s.")
      .def(
          "__call__", [](const TargetFile& targets, double t) { return toNumpy(targets(t)); }, "t"_a,
          docs::streams::pose);
  nb::class_<Gamepad>(
      m, "Gamepad", "Reads the sticks of a gamepad as velocity of a position, through the joystick interface of Linux.")
      .def(
          "__init__",
          [](Gamepad* self, const PathText& device, double speed, const std::array<int, 3>& axes) {
            new (self) Gamepad(device.text, speed, axes);
          },
          "device"_a = "/dev/input/js0", "speed"_a = .2, "axes"_a = std::array<int, 3>{0, 1, 4}, docs::streams::open)
      .def(
          "velocity", [](Gamepad& gamepad) { return toNumpy(VectorXd(gamepad.velocity())); }, docs::streams::velocity)
      .def("close", &Gamepad::close, "Closes the device; the velocity keeps its last value.");
  m.def("servo", servoFromPython, "ik"_a, "config"_a, "target"_a, "source"_a = nb::none(), nb::kw_only(), "seconds"_a,
        "dt"_a = .005, "show"_a = nb::none(), "realtime"_a = true, docs::streams::servo,
        nb::sig("def servo(ik: DiffIk, config: Config, target: str, source: "
                "collections.abc.Callable[[float], numpy.typing.ArrayLike] | Gamepad | None = None, *, seconds: float, "
                "dt: float = 0.005, show: bool | None = None, realtime: bool = True) -> None"));
}

}  // namespace kinegraph::python
