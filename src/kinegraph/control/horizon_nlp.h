#pragma once

#include <memory>
#include <vector>

#include "kinegraph/nlp/nlp.h"

namespace kinegraph::inline control_internal {

/// A motion problem with a moving present: past residuals and variables are removed, and offsets of the residuals move
/// their targets. Offsets and bounds may change between solves.
class HorizonNlp final : public Nlp {
 public:
  explicit HorizonNlp(std::shared_ptr<Nlp> problem);

  /// Sets a residual to zero from now on.
  void setPast(int residual) { past_[std::size_t(residual)] = true; }

  /// Sets the number that is added to a residual.
  void setOffset(int residual, double offset) { offset_[residual] = offset; }

  /// Makes a variable constant from now on.
  void fix(int variable, double value) { lower_[variable] = upper_[variable] = value; }

  /// Undoes all calls of setPast and fix.
  void free();

  Jacobian makeJacobian() const override { return problem_->makeJacobian(); }
  void evaluate(const VectorXd& x, VectorXd& phi, Jacobian* J) override;
  bool mayBeCancelled() const override { return problem_->mayBeCancelled(); }
  void leaveAt(const VectorXd& x) override { problem_->leaveAt(x); }
  bool addCostHessian(const VectorXd& x, MatrixXd& H) override { return problem_->addCostHessian(x, H); }
  std::span<const CurvedRows> curvedRows() const override { return problem_->curvedRows(); }
  void addCurvature(int k, std::span<const double> weights, Eigen::Ref<MatrixXd> H) override {
    problem_->addCurvature(k, weights, H);
  }
  std::string rowName(int row) const override { return problem_->rowName(row); }
  bool mayBeQuadratic() const override { return problem_->mayBeQuadratic(); }

 private:
  std::shared_ptr<Nlp> problem_;
  std::vector<char> past_;  ///< per residual
  VectorXd offset_;
};

}  // namespace kinegraph::inline control_internal
