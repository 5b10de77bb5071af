#pragma once

#include <memory>

#include "kinegraph/nlp/nlp.h"

namespace kinegraph::inline solvers_internal {

/// Replaces the constraints of a problem by costs: eq -> mu phi^2, ineq -> mu max(0, phi)^2.
class PenaltyNlp final : public Nlp {
 public:
  explicit PenaltyNlp(Nlp& nlp);
  void setWeight(double mu);

  Jacobian makeJacobian() const override { return nlp_.makeJacobian(); }
  void evaluate(const VectorXd& x, VectorXd& phi, Jacobian* J) override;
  bool addCostHessian(const VectorXd& x, MatrixXd& H) override { return nlp_.addCostHessian(x, H); }
  bool mayBeQuadratic() const override { return false; }
  bool mayBeCancelled() const override { return nlp_.mayBeCancelled(); }
  void leaveAt(const VectorXd& x) override { nlp_.leaveAt(x); }
  std::string rowName(int row) const override { return nlp_.rowName(row); }

 private:
  Nlp& nlp_;
  Jacobian inner_;
  double root_ = 1.;  ///< of mu
};

/// Replaces the inequalities of a problem by costs -mu log(-phi), which are NaN outside of the interior. Equalities
/// stay.
class BarrierNlp final : public Nlp {
 public:
  explicit BarrierNlp(Nlp& nlp);
  void setWeight(double mu) { mu_ = mu; }

  Jacobian makeJacobian() const override { return nlp_.makeJacobian(); }
  void evaluate(const VectorXd& x, VectorXd& phi, Jacobian* J) override;

  /// Adds the Hessian of the costs, and mu / phi^2 J^T J for each inequality.
  bool addCostHessian(const VectorXd& x, MatrixXd& H) override;
  bool mayBeQuadratic() const override { return false; }
  bool mayBeCancelled() const override { return nlp_.mayBeCancelled(); }
  void leaveAt(const VectorXd& x) override { nlp_.leaveAt(x); }
  std::string rowName(int row) const override { return nlp_.rowName(row); }

 private:
  Nlp& nlp_;
  Jacobian inner_;
  VectorXd inner_phi_;
  double mu_ = 1.;
};

bool isInequality(ObjectiveType type);

/// Returns `nlp` with barriers of weight `barrier` instead of inequalities, and penalties of weight `mu` instead of the
/// remaining constraints. A negative weight leaves the constraints unchanged. The result keeps `nlp` alive.
std::shared_ptr<Nlp> makePenalized(std::shared_ptr<Nlp> nlp, double mu, double barrier);

}  // namespace kinegraph::inline solvers_internal
