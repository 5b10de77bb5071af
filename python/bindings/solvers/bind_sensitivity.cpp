#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include "kinegraph/api/solutions.h"
#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "python_names.h"
#include "solvers/sensitivity.h"
#include "solvers/sensitivity_docs.h"

namespace kinegraph::python {

namespace {

/// A sensitivity, with the columns of each parameter.
struct PySensitivity {
  Sensitivity of;
  std::vector<int> first;  ///< first column of each parameter, and the end
};

std::vector<int> readIndices(nb::handle given) {
  if (nb::isinstance<nb::int_>(given)) return {nb::cast<int>(given)};
  return nb::cast<std::vector<int>>(given);
}

std::shared_ptr<NlpParameter> readPair(const Nlp& nlp, nb::handle first, nb::handle second) {
  if (nb::isinstance<nb::str>(first)) {
    const std::string name = nb::cast<std::string>(first);
    if (!nb::isinstance<nb::str>(second)) {
      if (name == "residual") return residualTargets(nlp, readIndices(second));
      if (name == "lower" || name == "upper") return boundsOf(nlp, readIndices(second), name == "upper");
      throw ValueError(cat("sensitivity: indices belong to 'residual', 'lower' or 'upper', not to '", name, "'"));
    }
    return parameterOf(nlp, name, nb::cast<std::string>(second));
  }
  return parameterOf(nlp, nb::cast<int>(first), nb::cast<std::string>(second));
}

/// Reads a parameter: a number, a name, a Frame, or a tuple of one of them and a keyword.
std::shared_ptr<NlpParameter> readParameter(const Nlp& nlp, nb::handle given) {
  const auto named = [](nb::handle of) {
    return nb::isinstance<Frame>(of) ? nb::object(nb::str(nb::cast<Frame>(of).getName().c_str())) : nb::borrow(of);
  };
  if (nb::isinstance<nb::tuple>(given) && nb::len(given) == 2) return readPair(nlp, named(given[0]), given[1]);
  const nb::object one = named(given);
  for (const char* word : {"residual", "lower", "upper"})
    if (nb::isinstance<nb::str>(one) && nb::cast<std::string>(one) == word)
      throw ValueError(cat("sensitivity: '", word, "' needs indices in the same tuple: sensitivity((\"", word,
                           "\", 1)) or sensitivity((\"", word, "\", [0, 1]))"));
  if (nb::isinstance<nb::str>(one)) return parameterOf(nlp, nb::cast<std::string>(one));
  if (nb::isinstance<nb::int_>(one)) return parameterOf(nlp, nb::cast<int>(one));
  throw ValueError(
      cat("sensitivity: a parameter is of type ", nb::cast<std::string>(nb::str(given.type().attr("__name__"))),
          "; expected the number or name of an objective, a frame, or a tuple of one of them and a keyword"));
}

std::vector<int> columnsOf(const NlpParameters& parameters) {
  std::vector<int> first = {0};
  for (const auto& parameter : parameters) first.push_back(first.back() + parameter->size());
  return first;
}

PySensitivity ofResult(const SolverResult& result, nb::args given, bool hold_weak) {
  if (!result.problem) return {Sensitivity(result, {}), {}};  // throws
  NlpParameters parameters;
  for (nb::handle one : given) parameters.push_back(readParameter(*result.problem, one));
  if (parameters.empty())
    throw ValueError("sensitivity: got no parameters; expected objectives, frames, or others of the list in help()");
  std::vector<int> first = columnsOf(parameters);
  const nb::gil_scoped_release unlock;
  return {Sensitivity(result, std::move(parameters), {hold_weak}), std::move(first)};
}

PySensitivity ofIkResult(const IkResult& result, nb::args given, bool hold_weak) {
  const std::shared_ptr<Nlp> nlp = makeNlp(result);
  NlpParameters parameters;
  for (nb::handle one : given) parameters.push_back(readParameter(*nlp, one));
  if (parameters.empty()) parameters = ikTargets(*nlp);
  std::vector<int> first = columnsOf(parameters);
  const nb::gil_scoped_release unlock;
  return {Sensitivity(nlp, result.q, {}, std::move(parameters), {hold_weak}), std::move(first)};
}

const MatrixXd& jacobianOf(PySensitivity& s) {
  const nb::gil_scoped_release unlock;
  return s.of.jacobian();
}

Array gradientOf(PySensitivity& s, const Numbers& v) {
  VectorXd gradient;
  {
    const nb::gil_scoped_release unlock;
    gradient = s.of.gradient(v.values);
  }
  return toNumpy(gradient);
}

std::pair<int, int> columnsAt(const PySensitivity& s, std::ptrdiff_t index) {
  const auto count = std::ptrdiff_t(s.first.size()) - 1, at = index < 0 ? index + count : index;
  if (at < 0 || at >= count) throw nb::index_error(cat("parameter ", index, " of ", count).c_str());
  return {s.first[std::size_t(at)], s.first[std::size_t(at) + 1]};
}

Array blockOf(PySensitivity& s, std::ptrdiff_t index) {
  const auto [first, end] = columnsAt(s, index);
  return toNumpy(MatrixXd(jacobianOf(s).middleCols(first, end - first)));
}

std::vector<std::string> textsInPython(const std::vector<std::string>& texts) {
  std::vector<std::string> result;
  for (const std::string& text : texts) result.push_back(inPython(text));
  return result;
}

}  // namespace

void bindSensitivity(nb::module_& m, nb::class_<SolverResult>& result) {
  nb::class_<PySensitivity>(
      m, "Sensitivity",
      "The derivatives dx/dp of a solution x with respect to parameters p of its problem, and gradients through it.")
      .def_prop_ro(
          "x", [](const PySensitivity& s) { return toNumpy(s.of.x()); },
          "The solution, refined to rounding errors, shape (n,).")
      .def_prop_ro(
          "dual", [](const PySensitivity& s) { return toNumpy(s.of.dual()); },
          "One multiplier per residual, shape (d,).")
      .def_prop_ro(
          "jacobian", [](PySensitivity& s) { return toNumpy(jacobianOf(s)); },
          "dx/dp, shape (n, p). Computed at the first access.")
      .def("gradient", gradientOf, "v"_a, docs::sensitivity::gradient)
      .def("__len__", [](const PySensitivity& s) { return s.first.size() - 1; })
      .def("__getitem__", blockOf, "index"_a, docs::sensitivity::block)
      .def(
          "columns",
          [](const PySensitivity& s, int index) {
            const auto [first, end] = columnsAt(s, index);
            return nb::slice(first, end, 1);
          },
          "index"_a, docs::sensitivity::columns)
      .def_prop_ro(
          "names", [](const PySensitivity& s) { return textsInPython(s.of.names()); }, "Names of the p parameters.")
      .def_prop_ro(
          "active", [](const PySensitivity& s) { return textsInPython(s.of.active()); },
          "Names of the active inequalities and bounds.")
      .def_prop_ro(
          "weak", [](PySensitivity& s) { return textsInPython(s.of.weak()); },
          "Names of the weakly active ones, at which the solution is not differentiable and dx/dp is one-sided.")
      .def_prop_ro(
          "withoutEffect", [](PySensitivity& s) { return textsInPython(s.of.withoutEffect()); },
          "Names of parameters that neither costs nor active constraints depend on, so that dx/dp is zero.")
      .def_prop_ro(
          "freeDirections", [](const PySensitivity& s) { return s.of.freeDirections(); },
          "Estimated number of directions that costs and constraints leave free; dx/dp is orthogonal to them.")
      .def_prop_ro(
          "isRegular", [](PySensitivity& s) { return s.of.isRegular(); },
          "Whether dx/dp is the unique derivative of the solution, so that `message` is empty.")
      .def_prop_ro(
          "message", [](PySensitivity& s) { return inPython(s.of.message()); },
          "The reason why dx/dp is not unique: weakly active constraints, free directions, saddles; else \"\".")
      .def_prop_ro(
          "evals", [](const PySensitivity& s) { return s.of.evals(); }, "Number of evaluations of the refinement.")
      .def("__repr__", [](PySensitivity& s) {
        const std::string message = s.of.message();
        return cat("<Sensitivity of ", s.of.x().size(), " variables, ", s.of.size(), " parameters",
                   message.empty() ? "" : cat(": ", inPython(message)), ">");
      });
  result.def(
      "sensitivity", ofResult, "parameters"_a, nb::kw_only(), "holdWeak"_a = false,
      nb::sig("def sensitivity(self, *parameters: int | str | Frame | tuple[int | str | Frame, str] | tuple[str, "
              "int | collections.abc.Sequence[int]], holdWeak: bool = False) -> Sensitivity"),
      docs::sensitivity::ofResult);
}

void bindSensitivity(nb::class_<IkResult>& result) {
  result.def("sensitivity", ofIkResult, "targets"_a, nb::kw_only(), "holdWeak"_a = false,
             nb::sig("def sensitivity(self, *targets: int | str | Frame, holdWeak: bool = False) -> Sensitivity"),
             docs::sensitivity::ofIkResult);
}

}  // namespace kinegraph::python
