#pragma once

#include "kinegraph/nlp/nlp.h"

namespace kinegraph::inline solvers_internal {

/// The constraints of a problem without its costs; squared penalties replace the relaxed ones. If all are relaxed, the
/// solution is the point of least violation.
class RelaxedNlp final : public Nlp {
 public:
  /// `relaxed` has one entry per residual. The bounds of `variable` are also relaxed; -1: none.
  RelaxedNlp(Nlp& nlp, const std::vector<bool>& relaxed, int variable = -1);

  /// Sets the value -padding above which relaxed inequalities count as violated.
  void setPadding(double padding) { padding_ = padding; }

  Jacobian makeJacobian() const override;
  void evaluate(const VectorXd& x, VectorXd& phi, Jacobian* J) override;
  bool mayBeQuadratic() const override { return false; }
  std::string rowName(int row) const override { return row < int(nlp_.types().size()) ? nlp_.rowName(row) : "bound"; }

 private:
  Nlp& nlp_;
  int variable_;
  double padding_ = 0.;
  VectorXd inner_phi_;
  Jacobian inner_;
};

}  // namespace kinegraph::inline solvers_internal
