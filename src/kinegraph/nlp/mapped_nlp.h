#pragma once

#include <Eigen/SparseCore>
#include <memory>

#include "kinegraph/nlp/nlp.h"

namespace kinegraph {

/// x = M c + offset.
struct LinearMap {
  Eigen::SparseMatrix<double, Eigen::RowMajor> M;
  VectorXd offset;

  VectorXd at(const VectorXd& c) const { return M * c + offset; }

  /// The c whose M c + offset is nearest to x; M must have full column rank.
  VectorXd fit(const VectorXd& x) const;
};

/// A problem in fewer variables c, on which its own depend linearly: as of a path that is a spline, in control points.
/// Residuals, and what is said of them, are those of the problem behind, which is left at the x of the c last evaluated.
class MappedNlp final : public Nlp {
 public:
  /// Bounds are of c. Throws ValueError if the map or the bounds do not have the problem's size.
  MappedNlp(std::shared_ptr<Nlp> behind, std::shared_ptr<const LinearMap> map, const VectorXd& lower,
            const VectorXd& upper);

  Jacobian makeJacobian() const override;
  void evaluate(const VectorXd& c, VectorXd& phi, Jacobian* J) override;
  /// The same of sizes that fit; `J` may have further rows behind those of this problem, which stay as they are.
  void evaluateRows(const VectorXd& c, VectorXd& phi, Jacobian* J);
  /// The c whose x is nearest, within the bounds.
  VectorXd fitted(const VectorXd& x) const;
  bool mayBeCancelled() const override { return behind_->mayBeCancelled(); }
  void leaveAt(const VectorXd& c) override { behind_->leaveAt(map_->at(c)); }
  bool addCostHessian(const VectorXd& c, MatrixXd& H) override;
  std::span<const CurvedRows> curvedRows() const override { return curved_; }
  void addCurvature(int k, std::span<const double> weights, Eigen::Ref<MatrixXd> H) override;
  Separation separation() override;
  VectorXd initialPoint(Rng& rng) override;
  std::string rowName(int row) const override { return behind_->rowName(row); }
  RowDescription describeRow(int row) const override { return behind_->describeRow(row); }
  VariableDescription describeVariable(int variable) const override;
  std::vector<std::string> detailsOf(int row) const override { return behind_->detailsOf(row); }
  std::string report(int verbose) const override;
  bool mayBeQuadratic() const override { return behind_->mayBeQuadratic(); }

 private:
  void layOut();
  void transform(int row, const Jacobian& from, Jacobian& J) const;

  std::shared_ptr<Nlp> behind_;
  std::shared_ptr<const LinearMap> map_;
  Jacobian pattern_, behind_jacobian_;
  std::vector<CurvedRows> curved_;
  mutable std::vector<double> row_;  ///< of the Jacobian, all its columns
};

}  // namespace kinegraph
