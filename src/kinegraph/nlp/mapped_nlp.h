#pragma once

#include <Eigen/SparseCore>
#include <memory>

#include "kinegraph/nlp/nlp.h"

namespace kinegraph::inline nlp_internal {

/// x = M c + offset.
struct LinearMap {
  Eigen::SparseMatrix<double, Eigen::RowMajor> M;
  VectorXd offset;

  VectorXd at(const VectorXd& c) const { return M * c + offset; }

  /// Returns the c whose M c + offset is nearest to x (least squares). M must have full column rank.
  VectorXd fit(const VectorXd& x) const;
};

/// A problem in fewer variables c, which determine the variables of an inner problem by a linear map, such as the
/// control points of a spline path. Residuals and their descriptions are those of the inner problem, which is left at
/// the x of the last evaluated c.
class MappedNlp final : public Nlp {
 public:
  /// `lower` and `upper` bound c. Throws ValueError if the sizes of the map or the bounds do not fit the problem.
  MappedNlp(std::shared_ptr<Nlp> inner, std::shared_ptr<const LinearMap> map, const VectorXd& lower,
            const VectorXd& upper);

  Jacobian makeJacobian() const override;
  void evaluate(const VectorXd& c, VectorXd& phi, Jacobian* J) override;
  /// Evaluates without checking sizes. `J` may have further rows after those of this problem, which stay unchanged.
  void evaluateRows(const VectorXd& c, VectorXd& phi, Jacobian* J);
  /// Returns the c of the nearest x, clipped to the bounds.
  VectorXd fitted(const VectorXd& x) const;
  bool mayBeCancelled() const override { return inner_->mayBeCancelled(); }
  void leaveAt(const VectorXd& c) override { inner_->leaveAt(map_->at(c)); }
  bool addCostHessian(const VectorXd& c, MatrixXd& H) override;
  std::span<const CurvedRows> curvedRows() const override { return curved_; }
  void addCurvature(int k, std::span<const double> weights, Eigen::Ref<MatrixXd> H) override;
  Separation separation() override;
  VectorXd initialPoint(Rng& rng) override;
  std::string rowName(int row) const override { return inner_->rowName(row); }
  RowDescription describeRow(int row) const override { return inner_->describeRow(row); }
  VariableDescription describeVariable(int variable) const override;
  std::vector<std::string> detailsOf(int row) const override { return inner_->detailsOf(row); }
  std::string report(int verbose) const override;
  bool mayBeQuadratic() const override { return inner_->mayBeQuadratic(); }

 private:
  void layOut();
  void transform(int row, const Jacobian& from, Jacobian& J) const;

  std::shared_ptr<Nlp> inner_;
  std::shared_ptr<const LinearMap> map_;
  Jacobian pattern_, inner_jacobian_;
  std::vector<CurvedRows> curved_;
  mutable std::vector<double> row_;  ///< workspace: one dense row of the Jacobian
};

}  // namespace kinegraph::inline nlp_internal
