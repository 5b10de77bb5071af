#pragma once

#include "kinegraph/nlp/nlp.h"

namespace kinegraph {

/// Another problem with its Jacobian by central differences, and no Hessian. For problems whose own is missing or
/// wrong.
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

}  // namespace kinegraph
