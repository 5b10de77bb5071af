#include <nanobind/stl/function.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <cmath>
#include <limits>

#include "bindings.h"
#include "defaults.h"
#include "kinegraph/base/errors.h"
#include "kinegraph/base/text.h"
#include "kinegraph/nlp/callback_nlp.h"
#include "explanation_dicts.h"
#include "kinegraph/solvers/explanation.h"
#include "nlp_objects.h"
#include "solving.h"

namespace kinegraph::python {

namespace {

void checkSize(const Nlp& nlp, const Numbers& x) {
  if (x.values.size() != nlp.dimension()) {
    throw ValueError(cat("x has ", x.values.size(), " numbers; the problem has ", nlp.dimension(), " variables"));
  }
}

/// (phi, J): J dense for a user's problem, (row, column, value) triplets for a motion problem.
nb::typed<nb::tuple, Array, Array> evaluate(Nlp& nlp, const Numbers& x) {
  checkSize(nlp, x);
  VectorXd phi(Eigen::Index(nlp.types().size()));
  Jacobian J = nlp.makeJacobian();
  nlp.evaluate(x.values, phi, &J);
  if (dynamic_cast<CallbackNlp*>(&nlp)) return nb::make_tuple(toNumpy(phi), toNumpy(J.toDense()));
  std::vector<double> triplets;
  for (int row = 0; row < J.rows(); ++row) {
    for (const Jacobian::Segment& segment : J.row_segments(row)) {
      for (int i = 0; i < segment.width; ++i) {
        const double value = J.values[segment.offset + i];
        if (value != 0.) triplets.insert(triplets.end(), {double(row), double(segment.column + i), value});
      }
    }
  }
  NewArray array = newArray(triplets.size() / 3, 3);
  std::copy(triplets.begin(), triplets.end(), array.data);
  return nb::make_tuple(toNumpy(phi), array.array);
}

/// (2, n), where a variable without bounds has lower 0 and upper -1.
Array bounds(const Nlp& nlp) {
  MatrixXd both(2, nlp.dimension());
  for (int i = 0; i < nlp.dimension(); ++i) {
    const bool bounded = std::isfinite(nlp.lower()[i]) || std::isfinite(nlp.upper()[i]);
    both(0, i) = bounded ? nlp.lower()[i] : 0.;
    both(1, i) = bounded ? nlp.upper()[i] : -1.;
  }
  return toNumpy(both);
}

bool check(Nlp& nlp, const Numbers& x, double tolerance) {
  checkSize(nlp, x);
  const JacobianCheck result = checkJacobian(nlp, x.values);
  if (result.error <= tolerance) return nb::print(cat("checkJacobian -- SUCCESS (max diff error=", result.error, ")").c_str()), true;
  nb::print(cat("checkJacobian -- FAILURE: ", nlp.rowName(result.row), ", variable ", result.column, ": J is ", result.analytic,
                ", differences give ", result.numeric).c_str());
  return false;
}

}  // namespace

void readPythonEvaluation(nb::handle returned, int dimension, VectorXd& phi, MatrixXd& J) {
  const nb::tuple pair = nb::cast<nb::tuple>(nb::module_::import_("builtins").attr("tuple")(returned));
  if (pair.size() != 2) throw ValueError(cat("the problem's function returned ", pair.size(), " values; expected (phi, J)"));
  const Numbers values = nb::cast<Numbers>(pair[0]), jacobian = nb::cast<Numbers>(pair[1]);
  phi = values.values;
  const int rows = int(phi.size());
  const bool triplets = jacobian.rank == 2 && jacobian.columns() == 3 && int(jacobian.rows) != rows;
  if (!triplets && jacobian.values.size() != Eigen::Index(rows) * dimension) {
    throw ValueError(cat("the problem's function returned a Jacobian with ", jacobian.values.size(), " entries; expected ", rows, " x ", dimension));
  }
  J.setZero(rows, dimension);
  if (!triplets) {
    J = Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(jacobian.values.data(), rows, dimension);
    return;
  }
  for (Eigen::Index i = 0; i < jacobian.values.size(); i += 3) {
    const double row = jacobian.values[i], column = jacobian.values[i + 1];
    if (!(row >= 0. && row < rows && column >= 0. && column < dimension)) throw ValueError("a Jacobian triplet lies outside of the matrix");
    J(Eigen::Index(row), Eigen::Index(column)) += jacobian.values[i + 2];
  }
}

void bindNlp(nb::module_& m) {
  nb::enum_<ObjectiveType>(m, "OT", nb::is_arithmetic(), "What a residual means: cost or constraint.")
      .value("f", ObjectiveType::f, "cost: phi")
      .value("sos", ObjectiveType::sos, "cost: phi^2")
      .value("ineq", ObjectiveType::ineq, "constraint: phi <= 0")
      .value("eq", ObjectiveType::eq, "constraint: phi = 0")
      .value("ineqB", ObjectiveType::ineqB, "constraint: phi <= 0")
      .value("ineqP", ObjectiveType::ineqP, "cost: max(0, phi)^2")
      .value("none", ObjectiveType::none);

  nb::class_<Nlp>(m, "NLP", "Minimize sum f + sum sos^2 subject to ineq <= 0, eq = 0 and bounds.")
      .def("getDimension", &Nlp::dimension, "Number of variables.")
      .def_prop_ro("dimension", &Nlp::dimension, "Number of variables.")
      .def("getTypes", [](const Nlp& nlp) { return nlp.types(); }, "The OT of each residual.")
      .def("getFeatureTypes", [](const Nlp& nlp) { return nlp.types(); }, "The same as getTypes.")
      .def("getBounds", bounds, "(2, n): lower and upper bounds; 0 and -1 where there is none.")
      .def_prop_ro("bounds", bounds, "(2, n): lower and upper bounds; 0 and -1 where there is none.")
      .def("evaluate", evaluate, "x"_a, "phi (d,) and J: dense (d, n), or for motion problems triplets (row, column, value).")
      .def("getInitializationSample", [](Nlp& nlp) { Rng rng(defaults().seed); return toNumpy(nlp.initialPoint(rng)); },
           "A point to start from.")
      .def("getUniformSample", [](Nlp& nlp) { Rng rng(defaults().seed); return toNumpy(nlp.uniformPoint(rng)); },
           "A point uniform in the bounds.")
      .def("checkJacobian", [](Nlp& nlp, const Numbers& x, double tolerance, nb::object) { return check(nlp, x, tolerance); },
           "x"_a, "tolerance"_a = 1e-4, "featureNames"_a = nb::none(), "Compares J with central differences; prints the worst entry.")
      .def("summarizeErrors", [](const Nlp& nlp, const Numbers& phi) {
             const ErrorSums s = sumErrors(nlp.types(), phi.values);
             return toNumpy(VectorXd(Vector4d(s.f, s.sos, s.ineq, s.eq)));
           }, "phi"_a, "Sums over residuals: f, sos, ineq, eq.")
      .def("explain", [](Nlp& nlp, const Numbers& x, double tolerance) { return explain(nlp, x.values, tolerance).str(); }, "x"_a,
           "tolerance"_a = 1e-3, "In words: which constraints contradict each other around x, by how much, and what helps.")
      .def("conflicts", [](Nlp& nlp, const Numbers& x, double tolerance) { return toDicts(explain(nlp, x.values, tolerance)); }, "x"_a,
           "tolerance"_a = 1e-3, "What explain says, as a list of dicts.")
      .def("report", &Nlp::report, "verbose"_a = 1, "A line about the problem.");

  nb::class_<PyNlpFactory>(m, "NLP_Factory", "A problem whose residuals a Python function computes.")
      .def(nb::init<>())
      .def("setDimension", [](PyNlpFactory& f, int n) { f.dimension = n; }, "dim"_a, "Number of variables.")
      .def("setTypes", [](PyNlpFactory& f, std::vector<ObjectiveType> types) { f.types = std::move(types); }, "featureTypes"_a,
           "The OT of each residual.")
      .def("setFeatureTypes", [](PyNlpFactory& f, std::vector<ObjectiveType> types) { f.types = std::move(types); }, "featureTypes"_a,
           "The same as setTypes.")
      .def("setBounds", [](PyNlpFactory& f, const Numbers& lower, const Numbers& upper) { f.lower = lower.values; f.upper = upper.values; },
           "lower"_a, "upper"_a, "Bounds of the variables.")
      .def("setEvalCallback", [](PyNlpFactory& f, nb::object function) { f.function = std::move(function); }, "fct"_a,
           "function(x) -> (phi, J), with J dense.")
      .def("testCallingEvalCallback", [](PyNlpFactory& f, const Numbers& x) { return evaluate(*f.make(), x); }, "x"_a,
           "Evaluates the function once.");
}

std::shared_ptr<Nlp> PyNlpFactory::make() const {
  if (!function.is_valid()) throw Error("NLP_Factory: there is no function; call setEvalCallback first");
  const int n = dimension;
  return std::make_shared<CallbackNlp>(n, types, lower, upper, [function = function, n](const VectorXd& x, VectorXd& phi, MatrixXd& J) {
    if (!callUser([&] { readPythonEvaluation(function(toNumpy(x)), n, phi, J); })) phi.setConstant(J.rows(), std::nan(""));
  });
}

}  // namespace kinegraph::python
