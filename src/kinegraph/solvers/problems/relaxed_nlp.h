#pragma once

#include "kinegraph/nlp/nlp.h"

namespace kinegraph {

/// Another problem's constraints without its costs, some of them as penalties: what is relaxed becomes the cost,
/// squared. With everything relaxed, its solution is the point of least violation.
class RelaxedNlp final : public Nlp {
 public:
  /// `relaxed` has an entry per residual. `variable`: its bounds are relaxed too, to a penalty; -1: none.
  RelaxedNlp(Nlp& nlp, const std::vector<bool>& relaxed, int variable = -1);

  /// Relaxed inequalities count as violated from -padding on.
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

}  // namespace kinegraph
