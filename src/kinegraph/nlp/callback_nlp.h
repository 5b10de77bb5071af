#pragma once

#include <functional>

#include "kinegraph/nlp/nlp.h"

namespace kinegraph {

/// A problem whose residuals are computed by a function of the user, with a dense J. The function may throw
/// EvaluationCancelled.
class CallbackNlp final : public Nlp {
 public:
  using Function = std::function<void(const VectorXd& x, VectorXd& phi, MatrixXd& J)>;

  /// `lower`, `upper`: bounds, shape (n,), or empty for none. Throws ValueError for other sizes.
  CallbackNlp(int dimension, std::vector<ObjectiveType> types, VectorXd lower, VectorXd upper, Function function);

  bool mayBeCancelled() const override { return true; }
  void evaluate(const VectorXd& x, VectorXd& phi, Jacobian* J) override;

 private:
  Function function_;
  MatrixXd dense_;
};

}  // namespace kinegraph
