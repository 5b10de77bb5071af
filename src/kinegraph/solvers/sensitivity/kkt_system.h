#pragma once

#include <Eigen/QR>
#include <vector>

#include "kinegraph/nlp/nlp.h"
#include "kinegraph/solvers/algebra/band_algebra.h"

namespace kinegraph::inline solvers_internal {

/// The linearized optimality conditions (KKT system), for active rows A of the Jacobian and fixed variables:
///
///     [ H  A^T ] [dx]   [a]
///     [ A   0  ] [dl] = [b],     dx_i given for fixed i
///
/// The factor of H + mu A^T A, a band for paths, solves it with iterative refinement of both residuals, so that A may
/// have dependent rows. If H leaves directions free, the result is the shortest dx. If H is indefinite on the null
/// space of A, a dense factorization replaces the factor.
/// Source: Golub, Greif, On solving block-structured indefinite linear systems, 2003.
class KktSystem {
 public:
  KktSystem(const Nlp& nlp, const Jacobian& pattern, bool full);
  KktSystem(const KktSystem&) = delete;
  KktSystem& operator=(const KktSystem&) = delete;

  /// Starts a new H with 2 J_i^T J_i for the given residuals. The caller adds further entries to the result.
  BandAlgebra& begin(const Jacobian& J, const std::vector<int>& squared);

  double largestCurvature() const;                    ///< largest diagonal entry of H
  double norm(int row) const { return norms_[row]; }  ///< of a row of J; 0 for a zero row

  /// Factorizes the system. False if it is indefinite and too large for a dense factorization.
  bool factorize(const std::vector<int>& active, const std::vector<char>& fixed);

  /// Solves the system; `dx` contains the entries of fixed variables, `b` and `dl` have one entry per active row.
  /// Returns the relative residual, at best `accuracy`; a large one means that there is no solution.
  double solve(const VectorXd& a, const VectorXd& b, VectorXd& dx, VectorXd& dl, double accuracy = 1e-12);

  /// Returns v - H w - A^T u: the residual of a solution for (v, 0) at fixed variables.
  VectorXd leftBy(const VectorXd& v, const VectorXd& w, const VectorXd& u);

  int freeDirections() const { return free_; }  ///< estimated number of directions that neither H nor A determines
  bool isIndefinite() const { return is_indefinite_; }  ///< whether the point is a saddle and not a minimum

 private:
  bool factorizeDense();
  double refined(VectorXd& dx, VectorXd& dl, double accuracy);
  double setResiduals(const VectorXd& dx, const VectorXd& dl);
  void solveDense(VectorXd& dx, VectorXd& dl) const;
  int pivotsBelow(double least) const;

  int n_;
  std::vector<int> rows_;        ///< all rows, as constraints of the algebra
  std::vector<char> is_linear_;  ///< per row: whether it is constant
  std::vector<int> linear_costs_, linear_now_;
  BandAlgebra algebra_;
  Jacobian J_;      ///< active rows have norm one, except for small ones
  VectorXd norms_;  ///< per row of J
  VectorXd units_;  ///< per active row: its divisor
  std::vector<int> active_;
  std::vector<char> fixed_;
  double mu_ = 1., damping_ = 0., largest_ = 1.;  ///< largest_: curvature
  int free_ = 0;
  bool is_indefinite_ = false;
  VectorXd a_, b_, r1_, r2_, step_, product_;
  MatrixXd dense_H_, dense_A_;
  Eigen::CompleteOrthogonalDecomposition<MatrixXd> dense_;
};

}  // namespace kinegraph::inline solvers_internal
