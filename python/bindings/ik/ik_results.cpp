#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <functional>

#include "ik/ik_objects.h"
#include "kinegraph/api/solutions.h"
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

/// Collects one number per problem of a batch.
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
                        r.attempts, r.evals, r.message, r.warnings);
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
          nb::cast<std::string>(state[8]),
          nb::cast<std::vector<std::string>>(state[9])};
}

const IkResult& resultAt(const IkResults& results, std::ptrdiff_t index) {
  const std::ptrdiff_t at = index < 0 ? index + std::ptrdiff_t(results.size()) : index;
  if (at < 0 || at >= std::ptrdiff_t(results.size()))
    throw nb::index_error(cat("result ", index, " of ", results.size()).c_str());
  return results[at];
}

nb::class_<IkResult> bindResult(nb::module_& m) {
  nb::enum_<IkStatus>(m, "IkStatus", "Outcome of solveIk.")
      .value("solved", IkStatus::solved, "All targets are within tolerance, and no pair is closer than the margin.")
      .value("goal_unreachable", IkStatus::goal_unreachable, "The best attempt misses a target.")
      .value("in_collision", IkStatus::in_collision, "The best attempt meets its targets in collision.")
      .value("cancelled", IkStatus::cancelled, "Cancelled before a solution was found.");
  nb::class_<IkResult> bound(m, "IkResult", "Result of solveIk.");
  bound
      .def_prop_ro(
          "q", [](const IkResult& r) { return toNumpy(r.q); },
          "The solution, or the attempt with the least error, shape (n,), rad or m; within the limits.")
      .def_prop_ro("feasible", &IkResult::feasible, "True if there is a solution.")
      .def_ro("status", &IkResult::status, "Outcome, an IkStatus.")
      .def_prop_ro(
          "message", [](const IkResult& r) { return inPython(r.message); },
          "\"\" if solved; otherwise the missed targets with their errors, and colliding pairs.")
      .def_prop_ro(
          "warnings",
          [](const IkResult& r) {
            nb::typed<nb::list, nb::str> warnings;
            for (const std::string& warning : r.warnings) warnings.append(inPython(warning));
            return warnings;
          },
          "Caveats of the answer: pairs in slight contact that no joint of a target separates.")
      .def_ro("position_error", &IkResult::position_error, "Position error of the worst target, m.")
      .def_ro("rotation_error", &IkResult::rotation_error, "Rotation error of the worst target, rad.")
      .def_ro("feature_error", &IkResult::feature_error,
              "Largest component of a feature's error, in its units times its scale.")
      .def_ro("penetration", &IkResult::penetration, "How much closer than the margin the worst pair is, m.")
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
  nb::class_<IkResults> bound(m, "IkResults", "Results of solveIk for N problems. results[i] is the i-th IkResult.");
  bound.def_prop_ro("q", allJoints, "The solutions, shape (N, n), rad or m.")
      .def_prop_ro(
          "feasible", [](const IkResults& r) { return column<FlagArray>(r, "bool", &IkResult::feasible); },
          "True for solved problems, shape (N,).")
      .def_prop_ro(
          "position_error", [](const IkResults& r) { return column<Array>(r, "float64", &IkResult::position_error); },
          "Position error of the worst target of each problem, shape (N,), m.")
      .def_prop_ro(
          "rotation_error", [](const IkResults& r) { return column<Array>(r, "float64", &IkResult::rotation_error); },
          "Rotation error of the worst target of each problem, shape (N,), rad.")
      .def_prop_ro(
          "feature_error", [](const IkResults& r) { return column<Array>(r, "float64", &IkResult::feature_error); },
          "Largest component of a feature's error in each problem, shape (N,), in its units times its scale.")
      .def_prop_ro(
          "penetration", [](const IkResults& r) { return column<Array>(r, "float64", &IkResult::penetration); },
          "How much closer than the margin the worst pair of each problem is, shape (N,), m.")
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
          "One line per problem; \"\" if it is solved.")
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
