#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include "arguments.h"
#include "bindings.h"
#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/simulation/simulation.h"
#include "simulation/simulation_batch_docs.h"
#include "simulation/simulation_objects.h"

namespace kinegraph::python {

namespace {

using Batch = SimulationBatch;

/// Indices; a mask of booleans is refused, as its numbers would be indices.
std::vector<int> environmentList(const nb::handle given, const char* call) {
  const std::string what = "expected indices of environments, or None for all";
  if (nb::hasattr(given, "dtype") && nb::cast<std::string>(given.attr("dtype").attr("kind")) == "b")
    throw ValueError(cat(call, ": environments is a mask; ", what, ": np.flatnonzero(mask)"));
  Numbers numbers;
  if (!readNumbers(given, numbers)) throw nb::type_error(cat(call, ": environments has no numbers; ", what).c_str());
  for (const double number : numbers.values) {
    if (number != std::floor(number)) throw ValueError(cat(call, ": environments has ", number, "; ", what));
  }
  return {numbers.values.begin(), numbers.values.end()};
}

/// Expands one number to all environments, or checks one per environment.
VectorXd forEach(const Batch& batch, const Numbers& given) {
  return given.rank == 0 ? VectorXd::Constant(batch.size(), given.values[0]) : given.values;
}

void stepBatch(Batch& batch, const Numbers& u, double tau, ControlMode mode, int repeat) {
  const MatrixXd rows = u.values.size() ? u.matrix() : MatrixXd();
  const nb::gil_scoped_release unlock;
  CheckInterrupts check;
  batch.step(rows, tau, mode, repeat, [&] { check(); });
}

/// Reshapes rows of F blocks of `width` numbers to (n, F, width).
Array blocks(const MatrixXd& rows, long width) {
  const NewArray made = newArray(std::size_t(rows.rows()), std::size_t(rows.cols() / width), std::size_t(width));
  for (long i = 0; i < rows.rows(); ++i) {
    for (long k = 0; k < rows.cols(); ++k) made.data[i * rows.cols() + k] = rows(i, k);
  }
  return made.array;
}

MatrixXd posesOf(const Batch& batch, const Numbers& given, std::size_t rows) {
  const std::size_t columns = 7 * batch.freeFrames().size();
  if (given.values.size() == 0) return {};
  if (std::size_t(given.values.size()) != rows * columns)
    throw ValueError(cat("SimulationBatch.place: freePos has ", given.values.size(), " entries; expected (", rows, ", ",
                         columns / 7, ", 7)"));
  return Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
      given.values.data(), long(rows), long(columns));
}

void reset(Batch& batch, const nb::object& environments) {
  if (environments.is_none()) return batch.reset();
  batch.reset(environmentList(environments, "SimulationBatch.reset"));
}

void place(Batch& batch, const nb::object& environments, const Numbers& q, const Numbers& poses) {
  if (environments.is_none())
    return batch.place(std::nullopt, q.matrix(), posesOf(batch, poses, std::size_t(batch.size())));
  const std::vector<int> list = environmentList(environments, "SimulationBatch.place");
  batch.place(list, q.matrix(), posesOf(batch, poses, list.size()));
}

}  // namespace

void bindSimulationBatch(nb::module_& m) {
  nb::class_<Batch>(m, "SimulationBatch", docs::simulation_batch::type)
      .def(
          "__init__",
          [](Batch* self, nb::handle config, int n, int threads, SimulationEngine engine, nb::handle options) {
            if (!nb::isinstance<PyConfig>(config)) throw nb::next_overload();
            new (self) Batch(nb::cast<PyConfig&>(config), n, threads, engine, optionsFrom(options));
          },
          "C"_a, "n"_a, "threads"_a = 1, "engine"_a = SimulationEngine::physx, "options"_a = nb::none(),
          nb::sig("def __init__(self, C: Config, n: int, threads: int = 1, engine: SimulationEngine = ..., "
                  "options: SimulationOptions | dict | None = None) -> None"),
          docs::simulation_batch::make)
      .def("__len__", &Batch::size)
      .def("step", stepBatch, "u"_a = nb::list(), "tau"_a = .01, "u_mode"_a = ControlMode::none, "repeat"_a = 1,
           docs::simulation_batch::step)
      .def(
          "times", [](const Batch& b) { return toNumpy(b.times()); }, "Time of each environment, (N,), s.")
      .def(
          "q", [](const Batch& b) { return toNumpy(b.q()); }, "Joint states, (N, n).")
      .def(
          "qDot", [](const Batch& b) { return toNumpy(b.qDot()); }, "Joint velocities, (N, n).")
      .def(
          "freePos", [](const Batch& b) { return blocks(b.freePoses(), 7); },
          "World poses of the free frames, (N, F, 7): x y z (m) qw qx qy qz.")
      .def(
          "freeVel", [](const Batch& b) { return blocks(b.freeVelocities(), 6); },
          "Velocities of the free frames, (N, F, 6): linear (m/s) and angular (rad/s), world.")
      .def("freeFrames", &Batch::freeFrames, "Names of the free frames.")
      .def("getState", &Batch::getState, "environment"_a, docs::simulation_batch::getState)
      .def("setState", &Batch::setState, "environment"_a, "state"_a, docs::simulation_batch::setState)
      .def("reset", reset, "environments"_a = nb::none(),
           nb::sig("def reset(self, environments: numpy.typing.ArrayLike | None = None) -> None"),
           docs::simulation_batch::reset)
      .def("place", place, "environments"_a.none(), "q"_a, "freePos"_a = nb::list(),
           nb::sig("def place(self, environments: numpy.typing.ArrayLike | None, q: numpy.typing.ArrayLike, "
                   "freePos: numpy.typing.ArrayLike = ...) -> None"),
           docs::simulation_batch::place)
      .def(
          "closeGrippers",
          [](Batch& b, const std::string& frame, const Numbers& widths, double speed, double force) {
            b.closeGrippers(frame, forEach(b, widths), speed, force);
          },
          "gripperFrameName"_a, "widths"_a = 0., "speed"_a = .3, "force"_a = 20., docs::simulation_batch::closeGrippers)
      .def(
          "setMasses",
          [](Batch& b, const std::string& frame, const Numbers& masses) { b.setMasses(frame, forEach(b, masses)); },
          "frame"_a, "masses"_a, docs::simulation_batch::setMasses)
      .def(
          "setFrictions",
          [](Batch& b, const std::string& frame, const Numbers& values) { b.setFrictions(frame, forEach(b, values)); },
          "frame"_a, "frictions"_a, docs::simulation_batch::setFrictions)
      .def("__repr__", [](const Batch& b) { return cat("<SimulationBatch of ", b.size(), " environments>"); });
}

}  // namespace kinegraph::python
