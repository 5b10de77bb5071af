#pragma once

#include <functional>

#include "kinegraph/nlp/nlp.h"

namespace kinegraph {

/// A problem whose residuals are computed by a function of the user, with a dense J. The function may throw
/// EvaluationCancelled.
class CallbackNlp final : public Nlp {
 public:
  using Function = std::function<void(const VectorXd& x, VectorXd& phi, MatrixXd& J)>;
  /// Sets H (n x n, zero before) to the Hessian of the sum of the cost terms f. It need not be positive definite.
  using CostHessian = std::function<void(const VectorXd& x, MatrixXd& H)>;

  /// `lower`, `upper`: bounds, shape (n,), or empty for none. Without `hessian`, solvers learn the curvature of terms f
  /// from gradients; sums of squares need none. Throws ValueError for other sizes.
  CallbackNlp(int dimension, std::vector<ObjectiveType> types, VectorXd lower, VectorXd upper, Function function,
              CostHessian hessian = {});

  bool mayBeCancelled() const override { return true; }
  void evaluate(const VectorXd& x, VectorXd& phi, Jacobian* J) override;
  bool addCostHessian(const VectorXd& x, MatrixXd& H) override;

 private:
  Function function_;
  CostHessian hessian_;
  MatrixXd dense_, hessian_values_;
};

}  // namespace kinegraph
