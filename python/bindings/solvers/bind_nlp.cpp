#include <nanobind/stl/function.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <cmath>
#include <limits>

#include "bindings.h"
#include "defaults.h"
#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/nlp/problems.h"
#include "kinegraph/solvers/nlp_solver.h"
#include "kinegraph/solvers/problems/penalty_nlp.h"
#include "komo/py_komo.h"
#include "solvers/explanation_dicts.h"
#include "solvers/nlp_docs.h"
#include "solvers/nlp_objects.h"
#include "solvers/solving.h"

namespace kinegraph::python {

namespace {

/// Returns x, or a random point within the bounds if x has another size.
VectorXd pointOrSample(Nlp& nlp, const Numbers& x) {
  return x.values.size() == nlp.dimension() ? x.values : nlp.uniformPoint(defaults().random);
}

void checkSize(const Nlp& nlp, const Numbers& x) {
  if (x.values.size() != nlp.dimension()) {
    throw ValueError(cat("x has ", x.values.size(), " entries; the problem has ", nlp.dimension(), " variables"));
  }
}

/// Returns (phi, J), with J dense, or (row, column, value) triplets for a motion problem.
nb::typed<nb::tuple, Array, Array> evaluate(Nlp& nlp, const Numbers& x) {
  checkSize(nlp, x);
  VectorXd phi(Eigen::Index(nlp.types().size()));
  Jacobian J = nlp.makeJacobian();
  nlp.evaluate(x.values, phi, &J);
  if (!komoOf(nlp)) return nb::make_tuple(toNumpy(phi), toNumpy(J.toDense()));
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

/// Returns bounds of shape (2, n); variables without bounds have lower 0 and upper -1.
Array bounds(const Nlp& nlp) {
  MatrixXd both(2, nlp.dimension());
  for (int i = 0; i < nlp.dimension(); ++i) {
    const bool bounded = std::isfinite(nlp.lower()[i]) || std::isfinite(nlp.upper()[i]);
    both(0, i) = bounded ? nlp.lower()[i] : 0.;
    both(1, i) = bounded ? nlp.upper()[i] : -1.;
  }
  return toNumpy(both);
}

IndexArray typeNumbers(const Nlp& nlp) {
  std::vector<int> numbers;
  for (ObjectiveType type : nlp.types()) numbers.push_back(int(type));
  return IndexArray(nb::module_::import_("numpy").attr("array")(numbers, "dtype"_a = "uint32"));
}

bool check(Nlp& nlp, const Numbers& given, double tolerance, const std::vector<std::string>& names) {
  const VectorXd x = pointOrSample(nlp, given);
  if (!names.empty() && names.size() != nlp.types().size()) {
    throw ValueError(
        cat("checkJacobian: got ", names.size(), " names; the problem has ", nlp.types().size(), " residuals"));
  }
  std::vector<JacobianCheck> worst;
  double largest = 0.;
  {
    const nb::gil_scoped_release unlock;
    worst = worstJacobianEntries(nlp, x, tolerance, 10, 1e-5, CheckInterrupts());
    if (worst.empty()) largest = checkJacobian(nlp, x, 1e-5, CheckInterrupts()).error;
  }
  if (worst.empty()) return nb::print(cat("checkJacobian -- SUCCESS (max diff error=", largest, ")").c_str()), true;
  std::string text = "checkJacobian -- FAILURE; the worst entries:";
  for (const JacobianCheck& entry : worst) {
    text += cat("\n  ", names.empty() ? nlp.rowName(entry.row) : names[std::size_t(entry.row)], ", ",
                nlp.describeVariable(entry.column).name, " (column ", entry.column, "): J is ", entry.analytic,
                ", differences give ", entry.numeric);
  }
  nb::print(text.c_str());
  return false;
}

bool checkSecond(Nlp& nlp, const Numbers& given, double tolerance) {
  const JacobianCheck result = checkHessian(nlp, pointOrSample(nlp, given), 1e-5, CheckInterrupts());
  if (result.error <= tolerance)
    return nb::print(cat("checkHessian -- SUCCESS (max diff error=", result.error, ")").c_str()), true;
  nb::print(cat("checkHessian -- FAILURE: entry (", result.row, ", ", result.column, ") is ", result.analytic,
                ", differences give ", result.numeric)
                .c_str());
  return false;
}

nb::typed<nb::tuple, double, Array, Array> evalScalar(Nlp& nlp, const Numbers& x) {
  checkSize(nlp, x);
  const ScalarEvaluation at = evaluateScalar(nlp, x.values);
  return nb::make_tuple(at.value, toNumpy(at.gradient), toNumpy(at.hessian));
}

Array costHessian(Nlp& nlp, const Numbers& x) {
  checkSize(nlp, x);
  MatrixXd H = MatrixXd::Zero(nlp.dimension(), nlp.dimension());
  return nlp.addCostHessian(x.values, H) ? toNumpy(H) : toNumpy(MatrixXd(0, 0));
}

/// Pickles a motion problem.
nb::object reduce(const Nlp& nlp) {
  const std::shared_ptr<PyKomo> komo = std::static_pointer_cast<PyKomo>(komoOf(nlp));
  if (!komo) throw nb::type_error("this NLP cannot be pickled; expected one of a KOMO");
  return nb::make_tuple(nb::module_::import_("operator").attr("methodcaller")("nlp"), nb::make_tuple(komo));
}

void bindObjectiveTypes(nb::module_& m) {
  nb::enum_<ObjectiveType>(m, "OT", nb::is_arithmetic(), "The type of a residual: cost or constraint.")
      .value("f", ObjectiveType::f, "cost: phi")
      .value("sos", ObjectiveType::sos, "cost: phi^2")
      .value("ineq", ObjectiveType::ineq, "constraint: phi <= 0")
      .value("eq", ObjectiveType::eq, "constraint: phi = 0")
      .value("ineqB", ObjectiveType::ineqB, "constraint: phi <= 0")
      .value("ineqP", ObjectiveType::ineqP, "cost: max(0, phi)^2")
      .value("none", ObjectiveType::none);
}

void bindProblemClass(nb::module_& m) {
  nb::class_<Nlp>(m, "NLP", "Minimize sum f + sum sos^2 subject to ineq <= 0, eq = 0 and bounds.")
      .def("getDimension", &Nlp::dimension, "The number n of variables.")
      .def_prop_ro("dimension", &Nlp::dimension, "The number n of variables.")
      .def(
          "getTypes", [](const Nlp& nlp) { return nlp.types(); }, "The OT of each residual.")
      .def_prop_ro("types", typeNumbers, "The OT of each residual, as numbers.")
      .def("getBounds", bounds, "Lower and upper bounds, shape (2, n); 0 and -1 where there is none.")
      .def_prop_ro("bounds", bounds, "Lower and upper bounds, shape (2, n); 0 and -1 where there is none.")
      .def("evaluate", evaluate, "x"_a, docs::nlp::evaluate)
      .def("eval_scalar", evalScalar, "x"_a, docs::nlp::eval_scalar)
      .def("getFHessian", costHessian, "x"_a, docs::nlp::getFHessian)
      .def(
          "getInitializationSample", [](Nlp& nlp, nb::handle) { return toNumpy(nlp.initialPoint(defaults().random)); },
          "previousOptima"_a = nb::none(),
          "Samples an initial point.\n\nArgs:\n    previousOptima: Not used; scripts of earlier versions pass "
          "it.\nReturns:\n    The point, shape (n,).")
      .def(
          "getUniformSample", [](Nlp& nlp) { return toNumpy(nlp.uniformPoint(defaults().random)); },
          "A random point, uniform within the bounds, shape (n,).")
      .def("checkJacobian", check, "x"_a, "tolerance"_a = 1e-4, "featureNames"_a = std::vector<std::string>(),
           docs::nlp::checkJacobian)
      .def("checkHessian", checkSecond, "x"_a, "tolerance"_a = 1e-4, docs::nlp::checkHessian)
      .def(
          "as_KOMO", [](const Nlp& nlp) { return std::static_pointer_cast<PyKomo>(komoOf(nlp)); },
          "The KOMO that this problem was made from, or None.")
      .def(
          "aug_lag",
          [](std::shared_ptr<Nlp> nlp, double mu, double barrier) {
            return std::shared_ptr<Nlp>(makePenalized(std::move(nlp), mu, barrier));
          },
          "muSquaredPenalty"_a = -1., "muLogBarrier"_a = -1., docs::nlp::aug_lag)
      .def("__reduce__", reduce)
      .def(
          "summarizeErrors",
          [](const Nlp& nlp, const Numbers& phi) {
            const ErrorSums s = sumErrors(nlp.types(), phi.values);
            return toNumpy(VectorXd(Vector4d(s.f, s.sos, s.ineq, s.eq)));
          },
          "phi"_a, docs::nlp::summarizeErrors)
      .def(
          "explain",
          [](Nlp& nlp, const Numbers& x, double tolerance) {
            return textOf(explainInterruptibly(nlp, x.values, tolerance));
          },
          "x"_a, "tolerance"_a = 1e-3, docs::nlp::explain)
      .def(
          "conflicts",
          [](Nlp& nlp, const Numbers& x, double tolerance) {
            return toDicts(explainInterruptibly(nlp, x.values, tolerance));
          },
          "x"_a, "tolerance"_a = 1e-3, docs::nlp::conflicts)
      .def("report", &Nlp::report, "verbose"_a = 1, docs::nlp::report);
}

void bindFactory(nb::module_& m) {
  nb::class_<PyNlpFactory, Nlp>(
      m, "NLP_Factory",
      "A problem whose residuals a Python function computes. It is an NLP once all setters were called.")
      .def(nb::init<>(), "Creates an empty problem.")
      .def("setDimension", &PyNlpFactory::setDimension, "dim"_a, docs::nlp::setDimension)
      .def("setTypes", &PyNlpFactory::setTypes, "featureTypes"_a, docs::nlp::setTypes)
      .def(
          "setBounds",
          [](PyNlpFactory& f, const Numbers& lower, const Numbers& upper) { f.setBounds(lower.values, upper.values); },
          "lower"_a, "upper"_a, docs::nlp::setBounds)
      .def("setEvalCallback", &PyNlpFactory::setFunction, "fct"_a, docs::nlp::setEvalCallback)
      .def(
          "testCallingEvalCallback", [](PyNlpFactory& f, const Numbers& x) { return evaluate(f, x); }, "x"_a,
          docs::nlp::testCallingEvalCallback);
}

}  // namespace

void bindNlp(nb::module_& m) {
  bindObjectiveTypes(m);
  bindProblemClass(m);
  bindFactory(m);
  m.def(
      "makeTestProblem",
      [](const std::string& name, int dimension, std::uint64_t seed) {
        return makeTestProblem(name, {dimension, seed});
      },
      "name"_a, "dimension"_a = -1, "seed"_a = 0, "Creates a test problem for solvers by name.");
  m.def("testProblemNames", testProblemNames, "Returns the names of all test problems.");
}

}  // namespace kinegraph::python
