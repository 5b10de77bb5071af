#pragma once

#include <vector>

#include "kinegraph/nlp/nlp.h"
#include "kinegraph/solvers/algebra/band_algebra.h"

namespace kinegraph::inline solvers_internal {

/// Computes the second derivatives of sum_i weights_i phi_i: those that the problem knows, and differences of its
/// Jacobian for the others. One evaluation moves all variables that have no residual in common.
/// Source: Curtis, Powell, Reid, On the estimation of sparse Jacobian matrices, 1974.
class LagrangianCurvature {
 public:
  explicit LagrangianCurvature(Nlp& nlp);

  /// Adds the derivatives to H at x, the last evaluated point, with Jacobian J. The problem may be at another point
  /// afterwards. With `knows_costs` the caller adds the Hessian of the f residuals.
  void addTo(BandAlgebra& H, const VectorXd& x, const VectorXd& weights, const Jacobian& J, bool knows_costs);

 private:
  void addKnown(BandAlgebra& H, const VectorXd& weights);
  void addDifferences(BandAlgebra& H, const VectorXd& x, const VectorXd& weights, const Jacobian& J);
  void color(const Jacobian& J);

  Nlp& nlp_;
  std::vector<char> is_known_;  ///< per residual: whether curvedRows contains it
  std::vector<int> unknown_;    ///< residuals with differences, ascending
  std::vector<int> color_;      ///< per variable; -1: in none of these residuals
  int colors_ = 0;
  Jacobian moved_J_;
  VectorXd moved_x_, moved_phi_, step_;
  MatrixXd block_;
};

}  // namespace kinegraph::inline solvers_internal
