#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <limits>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/nlp/evaluation_sizes.h"
#include "solvers/nlp_objects.h"
#include "solvers/solving.h"

namespace kinegraph::python {

namespace {

using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Reads the result of a function of the user: (phi, J), with J dense or as triplets.
void readEvaluation(nb::handle returned, int rows, int dimension, VectorXd& phi, MatrixXd& J) {
  const nb::tuple pair = nb::cast<nb::tuple>(nb::module_::import_("builtins").attr("tuple")(returned));
  if (pair.size() != 2)
    throw ValueError(cat("the problem's function returned ", pair.size(), " values; expected (phi, J)"));
  const Numbers values = nb::cast<Numbers>(pair[0]), jacobian = nb::cast<Numbers>(pair[1]);
  phi = values.values;
  if (phi.size() != rows)
    throw ValueError(
        cat("the problem's function returned phi of size ", phi.size(), "; expected ", rows, ", one per type"));
  const bool triplets = jacobian.rank == 2 && jacobian.columns() == 3 && int(jacobian.rows) != rows;
  if (!triplets && jacobian.values.size() != Eigen::Index(rows) * dimension) {
    throw ValueError(cat("the problem's function returned a Jacobian with ", jacobian.values.size(),
                         " entries; expected ", rows, " x ", dimension));
  }
  J.setZero(rows, dimension);
  if (!triplets) {
    J = Eigen::Map<const Rows>(jacobian.values.data(), rows, dimension);
    return;
  }
  for (Eigen::Index i = 0; i < jacobian.values.size(); i += 3) {
    const double row = jacobian.values[i], column = jacobian.values[i + 1];
    if (!(row >= 0. && row < rows && column >= 0. && column < dimension))
      throw ValueError("a triplet of the Jacobian is outside of the matrix");
    J(Eigen::Index(row), Eigen::Index(column)) += jacobian.values[i + 2];
  }
}

/// Calls a function of the user. Throws EvaluationCancelled if Ctrl-C ended it.
void callForValue(const std::function<void()>& call) {
  if (!callUser(call)) throw EvaluationCancelled();
}

/// Evaluates phi and J by function(x).
void evaluateFunction(const nb::object& function, const VectorXd& x, int rows, VectorXd& phi, MatrixXd& dense,
                      Jacobian* J) {
  const int n = int(x.size());
  callForValue([&] { readEvaluation(function(toNumpy(x)), rows, n, phi, dense); });
  if (J) Eigen::Map<Rows>(J->values.data(), rows, n) = dense;
}

/// Reads an OT, its number, or its name.
ObjectiveType readType(nb::handle given) {
  if (nb::isinstance<ObjectiveType>(given)) return nb::cast<ObjectiveType>(given);
  std::vector<std::string> names;
  for (int k = 0; k <= int(ObjectiveType::none); ++k) names.push_back(objectiveTypeName(ObjectiveType(k)));
  if (nb::isinstance<nb::str>(given)) {
    const std::string name = nb::cast<std::string>(given);
    const auto found = std::ranges::find(names, name);
    if (found != names.end()) return ObjectiveType(found - names.begin());
    throw ValueError(cat("a type of the problem is '", name, "'; expected one of OT: ", join(names)));
  }
  const int number = nb::cast<int>(nb::int_(nb::borrow(given)));
  if (number >= 0 && number <= int(ObjectiveType::none)) return ObjectiveType(number);
  throw ValueError(cat("a type of the problem is ", number, "; expected one of OT: ", join(names)));
}

/// Whether bounds of two variables make sense only as rows [lower, upper]: as given, they cross, or fix all variables.
bool looksTransposed(const VectorXd& lower, const VectorXd& upper) {
  if (lower.size() != 2 || lower[0] >= lower[1] || upper[0] >= upper[1]) return false;
  return lower == upper || (lower.array() > upper.array()).any();
}

/// Removes bounds whose upper value is below the lower one.
void openBounds(VectorXd& lower, VectorXd& upper) {
  for (Eigen::Index i = 0; i < lower.size(); ++i) {
    if (lower[i] <= upper[i]) continue;
    lower[i] = -kInfinity;
    upper[i] = kInfinity;
  }
}

class PythonProblem final : public Nlp {
 public:
  explicit PythonProblem(nb::object problem) : problem_(std::move(problem)), evaluate_(problem_.attr("evaluate")) {
    const int n = nb::cast<int>(problem_.attr("dimension"));
    if (n < 0) throw ValueError(cat("the dimension of the problem is ", n, "; expected a number >= 0"));
    const char* types_name = nb::hasattr(problem_, "types") ? "types" : "featureTypes";
    for (nb::handle type : problem_.attr(types_name)) {
      types_.push_back(readType(type));
    }
    lower_ = VectorXd::Constant(n, -kInfinity);
    upper_ = VectorXd::Constant(n, kInfinity);
    Numbers bounds;
    if (!nb::hasattr(problem_, "bounds") || !readNumbers(problem_.attr("bounds"), bounds) || bounds.values.size() == 0)
      return;
    if (bounds.rows != 2 || bounds.values.size() != 2 * n) {
      throw ValueError(cat("the bounds of the problem are ", bounds.rows, " x ", bounds.columns(),
                           " numbers; expected 2 x ", n, ", lower and upper",
                           int(bounds.rows) == n && bounds.columns() == 2 ? "; pass the transposed" : ""));
    }
    lower_ = bounds.values.head(n);
    upper_ = bounds.values.tail(n);
    if (looksTransposed(lower_, upper_))
      emitWarning(cat("the bounds of the problem are read as all lower, then all upper: variable 0 is between ",
                      lower_[0], " and ", upper_[0], ", variable 1 between ", lower_[1], " and ", upper_[1],
                      "; did you mean the transposed, one row [lower, upper] per variable?"));
    openBounds(lower_, upper_);
  }

  ~PythonProblem() override {
    const nb::gil_scoped_acquire lock;
    problem_.reset();
    evaluate_.reset();
  }

  bool mayBeCancelled() const override { return true; }

  void evaluate(const VectorXd& x, VectorXd& phi, Jacobian* J) override {
    prepareEvaluation(*this, x, phi, J);
    evaluateFunction(evaluate_, x, int(types_.size()), phi, dense_, J);
  }

  bool addCostHessian(const VectorXd& x, MatrixXd& H) override {
    bool has_one = false;
    callForValue([&] {
      Numbers given;
      if (!nb::hasattr(problem_, "getFHessian") || !readNumbers(problem_.attr("getFHessian")(toNumpy(x)), given) ||
          given.values.size() == 0)
        return;
      if (given.values.size() != H.size()) {
        throw ValueError(cat("getFHessian returned ", given.values.size(), " numbers; expected ", H.rows(), " x ",
                             H.cols(), ", or none"));
      }
      H += Eigen::Map<const Rows>(given.values.data(), H.rows(), H.cols());
      has_one = true;
    });
    return has_one;
  }

  VectorXd initialPoint(Rng& rng) override {
    Numbers given;
    callForValue([&] {
      if (nb::hasattr(problem_, "getInitializationSample"))
        readNumbers(problem_.attr("getInitializationSample")(), given);
    });
    if (given.values.size() == 0 && dimension() > 0) return Nlp::initialPoint(rng);
    if (given.values.size() != dimension()) {
      throw ValueError(
          cat("getInitializationSample returned ", given.values.size(), " numbers; expected ", dimension()));
    }
    return given.values;
  }

  std::string report(int verbose) const override {
    std::string text;
    callUser([&] {
      if (!nb::hasattr(problem_, "report")) return;
      const nb::object answer = problem_.attr("report")(verbose);
      if (!answer.is_none()) text = nb::cast<std::string>(nb::str(answer));
    });
    return text.empty() ? Nlp::report(verbose) : text;
  }

 private:
  nb::object problem_, evaluate_;
  MatrixXd dense_;
};

}  // namespace

void PyNlpFactory::setDimension(int n) {
  if (n < 0) throw ValueError(cat("NLP_Factory: the dimension is ", n, "; expected a number >= 0"));
  lower_ = VectorXd::Constant(n, -kInfinity);
  upper_ = VectorXd::Constant(n, kInfinity);
}

void PyNlpFactory::setBounds(const VectorXd& lower, const VectorXd& upper) {
  const Eigen::Index n = lower_.size() > 0 ? lower_.size() : lower.size();
  if (lower.size() == 0 && upper.size() == 0) return setDimension(int(n));
  if (lower.size() != n || upper.size() != n) {
    throw ValueError(
        cat("NLP_Factory: got ", lower.size(), " lower and ", upper.size(), " upper bounds; expected ", n, " of each"));
  }
  lower_ = lower;
  upper_ = upper;
  openBounds(lower_, upper_);
}

void PyNlpFactory::evaluate(const VectorXd& x, VectorXd& phi, Jacobian* J) {
  prepareEvaluation(*this, x, phi, J);
  if (!function_.is_valid()) throw Error("NLP_Factory: there is no function; call setEvalCallback first");
  evaluateFunction(function_, x, int(types_.size()), phi, J_, J);
}

std::string PyNlpFactory::report(int) const {
  return cat("NLP_Factory: ", dimension(), " variables, ", types_.size(), " residuals");
}

std::shared_ptr<Nlp> fromPythonProblem(nb::object problem) {
  for (const char* name : {"dimension", "evaluate"}) {
    if (nb::hasattr(problem, name)) continue;
    throw ValueError(cat("the problem, a ", nb::cast<std::string>(problem.type().attr("__name__")), ", has no '", name,
                         "'; expected dimension, types, bounds and evaluate(x) -> (phi, J)"));
  }
  if (!nb::hasattr(problem, "types") && !nb::hasattr(problem, "featureTypes")) {
    throw ValueError("the problem has no 'types'; expected a list of OT, one per entry of phi");
  }
  return std::make_shared<PythonProblem>(std::move(problem));
}

}  // namespace kinegraph::python
