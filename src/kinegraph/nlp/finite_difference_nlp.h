#pragma once

#include "kinegraph/nlp/nlp.h"

namespace kinegraph::inline nlp_internal {

/// Replaces the Jacobian of a problem by central differences, and offers no Hessian. For problems without correct
/// derivatives.
class FiniteDifferenceNlp final : public Nlp {
 public:
  FiniteDifferenceNlp(Nlp& nlp, double step);

  void evaluate(const VectorXd& x, VectorXd& phi, Jacobian* J) override;  ///< 2n+1 evaluations with J
  std::string rowName(int row) const override { return nlp_.rowName(row); }

 private:
  Nlp& nlp_;
  double step_;
  VectorXd moved_, plus_, minus_;
};

}  // namespace kinegraph::inline nlp_internal
