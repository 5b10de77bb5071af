#include "kinegraph/nlp/problems.h"

#include <limits>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/nlp/evaluation_sizes.h"

namespace kinegraph {

CallbackNlp::CallbackNlp(int dimension, std::vector<ObjectiveType> types, VectorXd lower, VectorXd upper,
                         Function function, CostHessian hessian)
    : function_(std::move(function)), hessian_(std::move(hessian)) {
  if (dimension < 0) throw ValueError(cat("NLP: the dimension is ", dimension, "; expected a number >= 0"));
  const double inf = std::numeric_limits<double>::infinity();
  if (lower.size() == 0) lower = VectorXd::Constant(dimension, -inf);
  if (upper.size() == 0) upper = VectorXd::Constant(dimension, inf);
  if (lower.size() != dimension || upper.size() != dimension) {
    throw ValueError(
        cat("NLP: got ", lower.size(), " lower and ", upper.size(), " upper bounds; expected ", dimension, " of each"));
  }
  types_ = std::move(types);
  lower_ = std::move(lower);
  upper_ = std::move(upper);
}

void CallbackNlp::evaluate(const VectorXd& x, VectorXd& phi, Jacobian* J) {
  const int rows = int(types_.size());
  prepareEvaluation(*this, x, phi, J);
  dense_.setZero(rows, dimension());
  function_(x, phi, dense_);
  if (phi.size() != rows || dense_.rows() != rows || dense_.cols() != dimension()) {
    throw ValueError(cat("the problem's function returned phi of size ", phi.size(), " and J of shape ", dense_.rows(),
                         " x ", dense_.cols(), "; expected ", rows, " and ", rows, " x ", dimension()));
  }
  if (!J) return;
  for (int row = 0; row < rows; ++row) {
    for (int i = 0; i < dimension(); ++i) J->values[std::size_t(row) * dimension() + i] = dense_(row, i);
  }
}

bool CallbackNlp::addCostHessian(const VectorXd& x, MatrixXd& H) {
  if (!hessian_) return false;
  const int n = dimension();
  hessian_values_.setZero(n, n);
  hessian_(x, hessian_values_);
  if (hessian_values_.rows() != n || hessian_values_.cols() != n) {
    throw ValueError(cat("the problem's Hessian has shape ", hessian_values_.rows(), " x ", hessian_values_.cols(),
                         "; expected ", n, " x ", n));
  }
  H += hessian_values_;
  return true;
}

}  // namespace kinegraph
