#include <nanobind/stl/string.h>

#include <algorithm>
#include <functional>

#include "ik/ik_objects.h"
#include "kinegraph/api/solution_parameters.h"
#include "kinegraph/common/text.h"
#include "python_names.h"
#include "solvers/sensitivity.h"
#include "solvers/sensitivity_docs.h"

namespace kinegraph::python {

std::string resultText(const IkResult& result) { return cat("<IkResult ", inPython(result.str()), ">"); }

std::string resultsText(const IkResults& results) {
  const auto solved = std::ranges::count_if(results, &IkResult::feasible);
  return cat("<IkResults: ", solved, " of ", results.size(), " solved>");
}

namespace {

/// What the problems of a batch have in common, an entry each.
template <class NumberArray, class Read>
NumberArray column(const IkResults& results, const char* dtype, Read read) {
  NewArray array = newArray(results.size());
  for (std::size_t i = 0; i < results.size(); ++i) array.data[i] = double(std::invoke(read, results[i]));
  return NumberArray(array.array.attr("astype")(dtype));
}

Array allJoints(const IkResults& results) {
  const std::size_t n = results.empty() ? 0 : std::size_t(results[0].q.size());
  NewArray array = newArray(results.size(), n);
  for (std::size_t i = 0; i < results.size(); ++i) std::copy_n(results[i].q.data(), n, array.data + i * n);
  return array.array;
}

Array gradientsOf(const IkResults& results, const Numbers& v, int threads) {
  MatrixXd gradients;
  {
    const nb::gil_scoped_release unlock;
    gradients = ikGradients(results, v.matrix(), threads);
  }
  return toNumpy(gradients);
}

nb::tuple resultState(const IkResult& r) {
  return nb::make_tuple(toNumpy(r.q), int(r.status), r.position_error, r.rotation_error, r.feature_error, r.penetration,
                        r.attempts, r.evals, r.message);
}

IkResult resultFrom(nb::tuple state) {
  return {nb::cast<Numbers>(state[0]).values,
          IkStatus(nb::cast<int>(state[1])),
          nb::cast<double>(state[2]),
          nb::cast<double>(state[3]),
          nb::cast<double>(state[4]),
          nb::cast<double>(state[5]),
          nb::cast<int>(state[6]),
          nb::cast<int>(state[7]),
          nb::cast<std::string>(state[8])};
}

const IkResult& resultAt(const IkResults& results, std::ptrdiff_t index) {
  const std::ptrdiff_t at = index < 0 ? index + std::ptrdiff_t(results.size()) : index;
  if (at < 0 || at >= std::ptrdiff_t(results.size()))
    throw nb::index_error(cat("result ", index, " of ", results.size()).c_str());
  return results[at];
}

nb::class_<IkResult> bindResult(nb::module_& m) {
  nb::enum_<IkStatus>(m, "IkStatus", "How solveIk ended.")
      .value("solved", IkStatus::solved, "All targets within tolerance, no pair nearer than the margin.")
      .value("goal_unreachable", IkStatus::goal_unreachable, "The nearest attempt misses a target.")
      .value("in_collision", IkStatus::in_collision, "The nearest attempt meets its targets in collision.")
      .value("cancelled", IkStatus::cancelled, "Before there was an answer.");
  nb::class_<IkResult> bound(m, "IkResult", "What solveIk found.");
  bound
      .def_prop_ro(
          "q", [](const IkResult& r) { return toNumpy(r.q); },
          "The answer, shape (n,), rad or m, or the attempt that missed least; within the limits.")
      .def_prop_ro("feasible", &IkResult::feasible, "True if there is an answer.")
      .def_ro("status", &IkResult::status, "How it ended, an IkStatus.")
      .def_prop_ro(
          "message", [](const IkResult& r) { return inPython(r.message); },
          "\"\" if solved; else what misses its target by how much, and what is in the way.")
      .def_ro("position_error", &IkResult::position_error, "Position error of the worst target, m.")
      .def_ro("rotation_error", &IkResult::rotation_error, "Rotation error of the worst target, rad.")
      .def_ro("feature_error", &IkResult::feature_error,
              "Error of the worst row of a feature, in its units times its scale.")
      .def_ro("penetration", &IkResult::penetration, "How much nearer than the margin the worst pair is, m.")
      .def_ro("attempts", &IkResult::attempts, "Number of starting points that were used.")
      .def_ro("evals", &IkResult::evals, "Number of evaluations of the kinematics.")
      .def("__bool__", &IkResult::feasible)
      .def("__repr__", resultText)
      .def("__getstate__", resultState)
      .def(
          "__setstate__", [](IkResult& self, nb::tuple state) { new (&self) IkResult(resultFrom(state)); }, "state"_a);
  return bound;
}

nb::class_<IkResults> bindBatchResult(nb::module_& m) {
  nb::class_<IkResults> bound(m, "IkResults", "What solveIk found for N problems. results[i] is the i-th IkResult.");
  bound.def_prop_ro("q", allJoints, "The answers, shape (N, n), rad or m.")
      .def_prop_ro(
          "feasible", [](const IkResults& r) { return column<FlagArray>(r, "bool", &IkResult::feasible); },
          "True where there is an answer, shape (N,).")
      .def_prop_ro(
          "position_error", [](const IkResults& r) { return column<Array>(r, "float64", &IkResult::position_error); },
          "Position error of the worst target of each problem, shape (N,), m.")
      .def_prop_ro(
          "rotation_error", [](const IkResults& r) { return column<Array>(r, "float64", &IkResult::rotation_error); },
          "Rotation error of the worst target of each problem, shape (N,), rad.")
      .def_prop_ro(
          "feature_error", [](const IkResults& r) { return column<Array>(r, "float64", &IkResult::feature_error); },
          "Error of the worst row of a feature of each problem, shape (N,), in its units times its scale.")
      .def_prop_ro(
          "penetration", [](const IkResults& r) { return column<Array>(r, "float64", &IkResult::penetration); },
          "How much nearer than the margin the worst pair of each problem is, shape (N,), m.")
      .def_prop_ro(
          "attempts", [](const IkResults& r) { return column<CountArray>(r, "int64", &IkResult::attempts); },
          "Number of starting points that were used, shape (N,).")
      .def_prop_ro(
          "evals", [](const IkResults& r) { return column<CountArray>(r, "int64", &IkResult::evals); },
          "Number of evaluations of the kinematics, shape (N,).")
      .def_prop_ro(
          "message",
          [](const IkResults& r) {
            nb::typed<nb::list, nb::str> messages;
            for (const IkResult& result : r) messages.append(inPython(result.message));
            return messages;
          },
          "One line per problem; \"\" where it is solved.")
      .def("__len__", [](const IkResults& r) { return r.size(); })
      .def("__getitem__", resultAt, "index"_a, nb::rv_policy::copy)
      .def("__repr__", resultsText)
      .def("__getstate__",
           [](const IkResults& r) {
             nb::list states;
             for (const IkResult& result : r) states.append(resultState(result));
             return states;
           })
      .def(
          "__setstate__",
          [](IkResults& self, nb::list states) {
            new (&self) IkResults();
            for (nb::handle state : states) self.push_back(resultFrom(nb::cast<nb::tuple>(state)));
          },
          "state"_a);
  return bound;
}

}  // namespace

void bindIkResults(nb::module_& m) {
  nb::class_<IkResult> result = bindResult(m);
  bindSensitivity(result);
  bindBatchResult(m).def("gradients", gradientsOf, "v"_a, nb::kw_only(), "threads"_a = 1, docs::sensitivity::gradients);
}

}  // namespace kinegraph::python
