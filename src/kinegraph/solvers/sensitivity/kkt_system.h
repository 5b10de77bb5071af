#pragma once

#include <Eigen/QR>
#include <vector>

#include "kinegraph/nlp/nlp.h"
#include "kinegraph/solvers/algebra/band_algebra.h"

namespace kinegraph {

/// The conditions of a solution, linearized: for rows A of the Jacobian that are active and variables that are fixed,
///
///     [ H  A^T ] [dx]   [a]
///     [ A   0  ] [dl] = [b],     dx_i given for fixed i
///
/// It is solved by the factor of H + mu A^T A, which is a band for paths, and refined until both residuals vanish:
/// rows that say the same do no harm. Where H leaves directions free, the shortest dx is found; where it is indefinite
/// there, a dense factorization takes over.
/// Source: Golub, Greif, On solving block-structured indefinite linear systems, 2003.
class KktSystem {
 public:
  KktSystem(const Nlp& nlp, const Jacobian& pattern, bool full);
  KktSystem(const KktSystem&) = delete;
  KktSystem& operator=(const KktSystem&) = delete;

  /// Begins a new H, with 2 J_i^T J_i for these rows; what it gives takes further entries.
  BandAlgebra& begin(const Jacobian& J, const std::vector<int>& squared);

  double largestCurvature() const;                    ///< largest diagonal entry of H
  double norm(int row) const { return norms_[row]; }  ///< of a row of J; 0 of one that is known to be zero

  /// False where the problem is too large to be treated as indefinite.
  bool factorize(const std::vector<int>& active, const std::vector<char>& fixed);

  /// `dx` comes with the entries of fixed variables; `b` and `dl` have an entry per active row. Ends at a
  /// relative residual of `accuracy`, and returns it: much more than rounding where there is no solution.
  double solve(const VectorXd& a, const VectorXd& b, VectorXd& dx, VectorXd& dl, double accuracy = 1e-12);

  /// v - H w - A^T u: what a solution for (v, 0) leaves at fixed variables.
  VectorXd leftBy(const VectorXd& v, const VectorXd& w, const VectorXd& u);

  int freeDirections() const { return free_; }          ///< about how many are determined neither by H nor by A
  bool isIndefinite() const { return is_indefinite_; }  ///< is it no minimum, but a saddle?

 private:
  bool factorizeDense();
  double refined(VectorXd& dx, VectorXd& dl, double accuracy);
  double setResiduals(const VectorXd& dx, const VectorXd& dl);
  void solveDense(VectorXd& dx, VectorXd& dl) const;
  int pivotsBelow(double least) const;

  int n_;
  std::vector<int> rows_;        ///< all, as the algebra's constraints
  std::vector<char> is_linear_;  ///< per row: is its J always the same?
  std::vector<int> linear_costs_, linear_now_;
  BandAlgebra algebra_;
  Jacobian J_;      ///< active rows have norm one, unless they are flat
  VectorXd norms_;  ///< per row of J
  VectorXd units_;  ///< per active row: what it was divided by
  std::vector<int> active_;
  std::vector<char> fixed_;
  double mu_ = 1., damping_ = 0., largest_ = 1.;  ///< the last: curvature
  int free_ = 0;
  bool is_indefinite_ = false;
  VectorXd a_, b_, r1_, r2_, step_, product_;
  MatrixXd dense_H_, dense_A_;
  Eigen::CompleteOrthogonalDecomposition<MatrixXd> dense_;
};

}  // namespace kinegraph
