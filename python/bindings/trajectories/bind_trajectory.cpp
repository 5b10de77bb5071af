#include <nanobind/trampoline.h>

#include <algorithm>

#include "arguments.h"
#include "bindings.h"
#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/trajectories/trajectory.h"
#include "trajectories/trajectory_docs.h"

namespace kinegraph::python {

namespace {

using States = nb::typed<nb::tuple, Array, Array, Array>;
using TimedStates = nb::typed<nb::tuple, Array, Array, Array, Array>;

/// A subclass written in Python, with `duration` and `eval(t)`.
struct PyTrajectory : Trajectory {
  NB_TRAMPOLINE(Trajectory, 3);

  int dimension() const override {
    if (dimension_ < 0) stateAt(0.);
    return dimension_;
  }

  double duration() const override {
    const nb::gil_scoped_acquire lock;
    const nb::object value = overridden("duration");
    double seconds = 0.;
    if (!nb::try_cast(value, seconds))
      throw ValueError(cat(className(), ".duration is ", nb::cast<std::string>(nb::repr(value)),
                           "; expected a number of seconds (a property or an attribute)"));
    return seconds;
  }

  void evalTo(double t, double* q, double* velocity, double* acceleration) const override {
    const MotionState state = stateAt(t);
    Eigen::Map<VectorXd>(q, dimension_) = state.q;
    Eigen::Map<VectorXd>(velocity, dimension_) = state.velocity;
    Eigen::Map<VectorXd>(acceleration, dimension_) = state.acceleration;
  }

 private:
  std::string className() const { return nb::cast<std::string>(nb_trampoline.base().type().attr("__name__")); }

  /// The attribute of the subclass; the base class would call this object again.
  nb::object overridden(const char* name) const {
    const nb::handle self = nb_trampoline.base();
    if (self.type().attr(name).is(nb::type<Trajectory>().attr(name)))
      throw ValueError(
          cat("class ", className(), " has no ", name, "; subclasses of Trajectory define duration and eval"));
    return self.attr(name);
  }

  MotionState stateAt(double t) const {
    const nb::gil_scoped_acquire lock;
    const nb::object answer = overridden("eval")(std::clamp(t, 0., duration()));
    MotionState state;
    Numbers parts[3];
    bool fits = nb::isinstance<nb::sequence>(answer) && nb::len(answer) == 3;
    for (int k = 0; fits && k < 3; ++k) fits = nb::try_cast(nb::object(answer[k]), parts[k]);
    if (!fits)
      throw ValueError(cat(className(), ".eval(", t, ") returned ", nb::cast<std::string>(nb::repr(answer)),
                           "; expected q, velocity and acceleration, shape (n,) each"));
    if (dimension_ < 0) dimension_ = int(parts[0].values.size());
    for (const Numbers& part : parts) {
      if (part.rank == 1 && part.values.size() == dimension_) continue;
      throw ValueError(cat(className(), ".eval(", t, ") returned an array of rank ", part.rank, " with ",
                           part.values.size(), " numbers; expected shape (", dimension_, ",)"));
    }
    return {parts[0].values, parts[1].values, parts[2].values};
  }

  mutable int dimension_ = -1;  // n of the first state
};

States eval(const Trajectory& trajectory, const Numbers& t) {
  if (t.rank > 1) throw ValueError(cat("Trajectory.eval: t has rank ", t.rank, "; expected a number or shape (T,)"));
  const auto n = std::size_t(trajectory.dimension()), count = std::size_t(t.values.size());
  const auto make = [&] { return t.rank == 0 ? newArray(n) : newArray(count, n); };
  NewArray q = make(), velocity = make(), acceleration = make();
  for (std::size_t i = 0; i < count; ++i)
    trajectory.evalTo(t.values[Eigen::Index(i)], q.data + i * n, velocity.data + i * n, acceleration.data + i * n);
  return States(nb::make_tuple(q.array, velocity.array, acceleration.array));
}

TimedStates sample(const Trajectory& trajectory, double rate) {
  const MotionStates s = trajectory.sample(rate);
  return TimedStates(nb::make_tuple(toNumpy(s.times), toNumpy(s.q), toNumpy(s.velocity), toNumpy(s.acceleration)));
}

MatrixXd rowsOf(const char* name, const Numbers& numbers) {
  if (numbers.rank != 2)
    throw ValueError(cat("SampledTrajectory: ", name, " has rank ", numbers.rank, "; expected shape (T, n)"));
  return numbers.matrix();
}

}  // namespace

void bindTrajectory(nb::module_& m) {
  namespace docs = docs::trajectory;
  nb::class_<Trajectory, PyTrajectory>(m, "Trajectory", docs::Trajectory)
      .def(nb::init<>(), docs::make)
      .def_prop_ro("duration", &Trajectory::duration, docs::duration)
      .def("eval", eval, "t"_a, docs::eval)
      .def("sample", sample, "rate"_a, docs::sample)
      .def(
          "writeCsv",
          [](const Trajectory& t, const PathText& file, double rate,
             const std::optional<std::vector<std::string>>& names) {
            t.writeCsv(file.text, rate, names.value_or(std::vector<std::string>{}));
          },
          "file"_a, "rate"_a = 100., "names"_a = nb::none(), docs::writeCsv);
  nb::class_<SampledTrajectory, Trajectory>(m, "SampledTrajectory", docs::SampledTrajectory)
      .def(
          "__init__",
          [](SampledTrajectory* self, const Numbers& times, const Numbers& q, const Numbers& velocity,
             const Numbers& acceleration) {
            new (self) SampledTrajectory(
                {times.values, rowsOf("q", q), rowsOf("velocity", velocity), rowsOf("acceleration", acceleration)});
          },
          "times"_a, "q"_a, "velocity"_a, "acceleration"_a, docs::SampledTrajectory_make)
      .def_static(
          "read", [](const PathText& file) { return SampledTrajectory::read(file.text); }, "file"_a, docs::read)
      .def("__getstate__",
           [](const SampledTrajectory& t) {
             const MotionStates& s = t.samples();
             return TimedStates(
                 nb::make_tuple(toNumpy(s.times), toNumpy(s.q), toNumpy(s.velocity), toNumpy(s.acceleration)));
           })
      .def("__setstate__", [](SampledTrajectory& t, const TimedStates& s) {
        new (&t) SampledTrajectory({nb::cast<Numbers>(s[0]).values, nb::cast<Numbers>(s[1]).matrix(),
                                    nb::cast<Numbers>(s[2]).matrix(), nb::cast<Numbers>(s[3]).matrix()});
      });
}

}  // namespace kinegraph::python
