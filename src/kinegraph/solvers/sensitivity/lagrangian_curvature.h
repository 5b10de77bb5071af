#pragma once

#include <vector>

#include "kinegraph/nlp/nlp.h"
#include "kinegraph/solvers/algebra/band_algebra.h"

namespace kinegraph {

/// The second derivatives of sum_i weights_i phi_i: as the problem tells them, else as differences of its Jacobian, in
/// which one evaluation moves all variables that no row has in common.
/// Source: Curtis, Powell, Reid, On the estimation of sparse Jacobian matrices, 1974.
class LagrangianCurvature {
 public:
  explicit LagrangianCurvature(Nlp& nlp);

  /// Adds them at x, at which the problem was evaluated last, with Jacobian J. It may stand elsewhere then. With
  /// `tells_costs` the Hessian of the f residuals is the problem's.
  void addTo(BandAlgebra& H, const VectorXd& x, const VectorXd& weights, const Jacobian& J, bool tells_costs);

 private:
  void addTold(BandAlgebra& H, const VectorXd& weights);
  void addDifferences(BandAlgebra& H, const VectorXd& x, const VectorXd& weights, const Jacobian& J);
  void color(const Jacobian& J);

  Nlp& nlp_;
  std::vector<char> is_told_;  ///< per row, by curvedRows
  std::vector<int> unknown_;   ///< rows that are differenced, ascending
  std::vector<int> color_;     ///< per variable; -1: in none of these rows
  int colors_ = 0;
  Jacobian moved_J_;
  VectorXd moved_x_, moved_phi_, step_;
  MatrixXd block_;
};

}  // namespace kinegraph
