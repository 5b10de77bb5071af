#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include "bindings.h"
#include "features/feature_arguments.h"
#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/komo/path/sub_problem.h"
#include "kinegraph/trajectory_optimization/motion_problems.h"
#include "komo/py_komo.h"
#include "trajectory_optimization/skeleton_docs.h"

namespace kinegraph::python {

namespace {

void addEntry(Skeleton& skeleton, nb::handle times, nb::handle symbol, nb::handle frames) {
  Numbers at;
  SwitchMode mode;
  std::vector<std::string> names;
  std::string one;
  const auto repr = [](nb::handle value) { return nb::cast<std::string>(nb::repr(value)); };
  if (!nb::try_cast(symbol, mode))
    throw ValueError(cat("Skeleton: ", repr(symbol), " is not a symbol; expected one of SY"));
  const std::string name = switchModeName(mode);
  if (!nb::try_cast(times, at)) {
    throw ValueError(cat("Skeleton: the times of ", name, " are ", repr(times), "; expected [at] or [from, to]"));
  }
  if (nb::try_cast(frames, one)) {
    names = {one};
  } else if (!nb::try_cast(frames, names)) {
    throw ValueError(cat("Skeleton: the frames of ", name, " are ", repr(frames), "; expected a list of names"));
  }
  skeleton.addEntry(at.list(), mode, names);
}

/// Adds a flat list of times, symbol, frames, times, symbol, frames ...
void addList(Skeleton& skeleton, const nb::list& list) {
  if (list.size() % 3 != 0) {
    throw ValueError(
        cat("Skeleton.add: the list has ", list.size(), " entries; expected three by three: times, symbol, frames"));
  }
  for (std::size_t i = 0; i + 2 < list.size(); i += 3) addEntry(skeleton, list[i], list[i + 1], list[i + 2]);
}

std::shared_ptr<PyKomo> wrapped(Komo komo) {
  for (const std::string& warning : komo.takeWarnings()) emitWarning(warning);
  return std::make_shared<PyKomo>(PyKomo{std::move(komo), nullptr});
}

void setSkeleton(PyKomo& komo, nb::handle source) {
  Skeleton made;
  const bool is_list = nb::isinstance<nb::list>(source);
  if (is_list) addList(made, nb::cast<nb::list>(source));
  const Skeleton& skeleton = is_list ? made : nb::cast<const Skeleton&>(source);
  for (const Skeleton::Entry& entry : skeleton.entries()) {
    if (entry.symbol != SwitchMode::makeFree) continue;
    throw ValueError("setSkeleton: makeFree changes the scene; give the frames free joints before making the KOMO");
  }
  skeleton.addTo(komo);
  for (const std::string& warning : komo.takeWarnings()) emitWarning(warning);
}

using Times = nb::typed<nb::tuple, nb::float_, nb::float_>;
using Entries = nb::typed<nb::list, nb::typed<nb::tuple, Times, SwitchMode, nb::typed<nb::list, nb::str>>>;

Entries entriesOf(const Skeleton& skeleton) {
  Entries list;
  for (const Skeleton::Entry& e : skeleton.entries())
    list.append(nb::make_tuple(nb::make_tuple(e.from, e.to), e.symbol, e.frames));
  return list;
}

void bindEntries(nb::class_<Skeleton>& skeleton) {
  skeleton.def(nb::init<>(), "Makes a skeleton without entries.")
      .def("addEntry", addEntry, "timeInterval"_a, "symbol"_a, "frames"_a,
           nb::sig("def addEntry(self, timeInterval: numpy.typing.ArrayLike, symbol: SY, frames: typing.Sequence[str] "
                   "| str) -> None"),
           docs::skeleton::addEntry)
      .def("add", addList, "entries"_a, docs::skeleton::add)
      .def("entries", entriesOf, "Returns a list of ((from, to), symbol, frames), times in phases.")
      .def("getMaxPhase", &Skeleton::maxPhase, "Returns the last phase of any entry.")
      .def("addExplicitCollisions", &Skeleton::addExplicitCollisions, "collisions"_a,
           docs::skeleton::addExplicitCollisions)
      .def("addLiftPriors", &Skeleton::addLiftPriors, "lift"_a, docs::skeleton::addLiftPriors)
      .def("useBroadCollisions", &Skeleton::useBroadCollisions, "enable"_a = true, docs::skeleton::useBroadCollisions)
      .def("__getstate__",
           [](const Skeleton& s) {
             nb::list list;
             for (const Skeleton::Entry& e : s.entries())
               list.append(nb::make_tuple(e.from, e.to, int(e.symbol), e.frames));
             return nb::make_tuple(list, s.explicitCollisions(), s.liftPriors(), s.usesBroadCollisions());
           })
      .def(
          "__setstate__",
          [](Skeleton& s, const nb::tuple& state) {
            new (&s) Skeleton();
            for (nb::handle e : nb::cast<nb::list>(state[0])) {
              s.addEntry({nb::cast<double>(e[0]), nb::cast<double>(e[1])}, SwitchMode(nb::cast<int>(e[2])),
                         nb::cast<std::vector<std::string>>(e[3]));
            }
            s.addExplicitCollisions(nb::cast<std::vector<std::string>>(state[1]));
            s.addLiftPriors(nb::cast<std::vector<std::string>>(state[2]));
            s.useBroadCollisions(nb::cast<bool>(state[3]));
          },
          "state"_a)
      .def("__repr__", [](const Skeleton& s) {
        return cat("<Skeleton: ", s.entries().size(), " entries, ", s.maxPhase(), " phases>");
      });
}

/// Binds the methods that make problems.
void bindProblems(nb::class_<Skeleton>& skeleton) {
  skeleton
      .def(
          "getKomo_path",
          [](const Skeleton& s, const PyConfig& config, int steps, double acceleration, double, double homing, double) {
            return wrapped(s.path(config, steps, acceleration, homing));
          },
          "Configuration"_a, "stepsPerPhase"_a = 30, "accScale"_a = 1., "lenScale"_a = 1e-2, "homingScale"_a = 1e-2,
          "collScale"_a = 1e1, docs::skeleton::getKomo_path)
      .def(
          "getKomo_waypoints",
          [](const Skeleton& s, const PyConfig& config, double length, double homing, double) {
            return wrapped(s.waypoints(config, length, homing));
          },
          "Configuration"_a, "lenScale"_a = 1e-2, "homingScale"_a = 1e-2, "collScale"_a = 1e1,
          docs::skeleton::getKomo_waypoints)
      .def(
          "getKomo_finalSlice",
          [](const Skeleton& s, const PyConfig& config, double length, double homing, double) {
            return wrapped(s.finalSlice(config, length, homing));
          },
          "Configuration"_a, "lenScale"_a = 1e-2, "homingScale"_a = 1e-2, "collScale"_a = 1e1,
          docs::skeleton::getKomo_finalSlice)
      .def(
          "getTwoWaypointProblem",
          [](const Skeleton&, int t2, const PyKomo& waypoints) {
            SubProblem sub = subProblem(waypoints.path(), t2);
            return nb::make_tuple(PyConfig{std::move(sub.config), nullptr}, toNumpy(sub.start), toNumpy(sub.end));
          },
          "t2"_a, "komoWays"_a,
          nb::sig("def getTwoWaypointProblem(self, t2: int, komoWays: KOMO) -> "
                  "tuple[Config, numpy.typing.NDArray[numpy.float64], numpy.typing.NDArray[numpy.float64]]"),
          docs::skeleton::getTwoWaypointProblem);
}

}  // namespace

void bindSkeleton(nb::module_& m) {
  nb::class_<Skeleton> skeleton(
      m, "Skeleton",
      "A schedule of modes and constraints: entries of phase times, a symbol of SY, and frames. Makes trajectory "
      "optimization problems from them.");
  bindEntries(skeleton);
  bindProblems(skeleton);
  nb::object komo = nb::borrow(nb::type<PyKomo>());
  nb::setattr(komo, "setSkeleton",
              nb::cpp_function(setSkeleton, nb::is_method(), nb::name("setSkeleton"), nb::scope(komo), "skeleton"_a,
                               nb::sig("def setSkeleton(self, skeleton: Skeleton | list[typing.Any]) -> None"),
                               docs::skeleton::setSkeleton));
}

}  // namespace kinegraph::python
