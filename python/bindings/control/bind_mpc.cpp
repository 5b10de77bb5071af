#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>

#include <tuple>

#include "bindings.h"
#include "control/control.h"
#include "control/mpc_docs.h"
#include "kinegraph/control/mpc.h"
#include "komo/py_komo.h"
#include "python_names.h"

namespace kinegraph::python {

namespace {

void makeMpc(Mpc* self, const PyKomo& komo, int evaluations, double microseconds, int first_evaluations,
             double tolerance, double violation, double penalty, bool receding) {
  new (self) Mpc(komo, {.evaluations = evaluations,
                        .microseconds = microseconds,
                        .first_evaluations = first_evaluations,
                        .tolerance = tolerance,
                        .violation = violation,
                        .penalty = penalty,
                        .receding = receding});
}

void bindResult(nb::module_& m) {
  nb::class_<MpcResult>(m, "MpcResult", "Describes how a call of Mpc ended and the quality of its motion.")
      .def_ro("status", &MpcResult::status, "The reason why the call ended, a SolverStatus.")
      .def_ro("feasible", &MpcResult::feasible,
              "Whether no scaled constraint is violated by more than 1e-3, or ten tolerances.")
      .def_ro("violation", &MpcResult::violation, "Violation of the worst constraint, scaled.")
      .def_ro("cost", &MpcResult::cost, "Sum of the squares.")
      .def_ro("evals", &MpcResult::evals, "Number of evaluations.")
      .def_ro("time", &MpcResult::time, "Duration of the call, s.")
      .def_ro("was_cold", &MpcResult::was_cold, "Whether the call did not start from the result of the call before.")
      .def_prop_ro(
          "message", [](const MpcResult& r) { return inPython(r.message); }, "The reason why the call ended, as text.")
      .def("__repr__", [](const MpcResult& r) {
        return cat("<MpcResult ", solverStatusName(r.status), ", violation ", r.violation, ", cost ", r.cost, ", ",
                   r.evals, " evaluations>");
      });
}

}  // namespace

void bindMpc(nb::module_& m) {
  bindResult(m);
  nb::class_<Mpc>(
      m, "Mpc",
      "Model predictive control: solves a motion problem again and again while time goes on, each time from the "
      "path, multipliers and penalties of the last call.")
      .def("__init__", makeMpc, "komo"_a, nb::kw_only(), "evaluations"_a = 50, "microseconds"_a = 0.,
           "first_evaluations"_a = 500, "tolerance"_a = 1e-3, "violation"_a = 1e-4, "penalty"_a = 100.,
           "receding"_a = true, docs::mpc::make)
      .def(
          "setPoses",
          [](Mpc& mpc, const std::string& frame, const Numbers& poses) { mpc.setPoses(frame, poses.matrix()); },
          "frame"_a, "poses"_a, docs::mpc::setPoses)
      .def(
          "updateRootObjects", [](Mpc& mpc, const PyConfig& config) { mpc.updateRootObjects(config); }, "config"_a,
          docs::mpc::updateRootObjects)
      .def(
          "setTarget",
          [](Mpc& mpc, int objective, const Numbers& targets) { mpc.setTarget(objective, targets.matrix()); },
          "objective"_a, "targets"_a, docs::mpc::setTarget)
      .def(
          "step",
          [](Mpc& mpc, const Numbers& q, const Numbers& velocity, std::optional<double> dt) {
            return mpc.step(q.values, velocity.values, dt);
          },
          "q"_a, "velocity"_a, "dt"_a = nb::none(), docs::mpc::step)
      .def(
          "at",
          [](const Mpc& mpc, double time) {
            const MotionPoint point = mpc.at(time);
            return std::make_tuple(toNumpy(point.q), toNumpy(point.velocity));
          },
          "time"_a, docs::mpc::at)
      .def(
          "horizon",
          [](const Mpc& mpc, double rate) {
            const MotionStates states = mpc.horizon().sample(rate);
            return std::make_tuple(toNumpy(states.times), toNumpy(states.q), toNumpy(states.velocity));
          },
          "rate"_a = 100., docs::mpc::horizon)
      .def(
          "getPath", [](const Mpc& mpc) { return toNumpy(mpc.getPath()); },
          "Returns the motion in all slices, shape (T, n), rad or m.")
      .def("reset", &Mpc::reset, "Forgets all results: the next call is a first one.")
      .def_prop_ro("result", &Mpc::result, "The MpcResult of the last call.", nb::rv_policy::copy)
      .def_prop_ro("elapsed", &Mpc::elapsed, "Seconds since the first call.")
      .def_prop_rw(
          "evaluations", [](const Mpc& mpc) { return mpc.options.evaluations; },
          [](Mpc& mpc, int value) { mpc.options.evaluations = value; }, "Budget of a call.")
      .def_prop_rw(
          "microseconds", [](const Mpc& mpc) { return mpc.options.microseconds; },
          [](Mpc& mpc, double value) { mpc.options.microseconds = value; },
          "A call makes no further step after this time; 0: no limit.")
      .def("__repr__", [](const Mpc& mpc) {
        return cat("<Mpc of ", mpc.komo().slices(), " slices of ", mpc.komo().tau(), " s, ", mpc.elapsed(), " s on>");
      });
}

}  // namespace kinegraph::python
