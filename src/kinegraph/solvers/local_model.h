#pragma once

#include <vector>

#include "kinegraph/math/skyline.h"
#include "kinegraph/nlp/nlp.h"

namespace kinegraph {

/// The augmented Lagrangian around a point, with linearized residuals, as a function of a step d in a box:
///
///     m(d) = g^T d + 1/2 d^T (H + shift I) d + 1/(2 mu) sum_j t_j(d)^2,     t_j = lambda_j + mu (c_j + J_j d)
///
/// with t_j cut off at zero for inequalities. It is piecewise quadratic, and minimized by a semismooth Newton method.
/// Holds all its memory; minimizing requests none.
class LocalModel {
 public:
  /// `costs` are the rows whose squares are in H, `constraints` those of the sum.
  LocalModel(const Nlp& nlp, std::vector<int> costs, std::vector<int> constraints);

  /// Takes g and H = 2 Js^T Js (+ the Hessian of the f terms, or where the problem has none to offer `curvature`, if given)
  /// from residuals at a point. False if the Hessian of the f terms would be needed and is missing.
  bool setCosts(Nlp& nlp, const VectorXd& x, const VectorXd& phi, const Jacobian& J, const MatrixXd* curvature = nullptr);

  /// No costs, H = weight I: the model of the violation alone.
  void setNoCosts(double weight);

  double largestCurvature() const;  ///< of the costs: largest diagonal entry of H

  struct Problem {
    const VectorXd& phi;
    const Jacobian& J;
    const VectorXd& lambda;  ///< per constraint
    double mu;
    double shift;
    const VectorXd& low;     ///< box of d
    const VectorXd& high;
    int max_passes;
  };

  /// The minimizing step; its parts can be asked for then. Counts factorizations.
  const VectorXd& minimize(const Problem& problem);
  const VectorXd& step() const { return d_; }
  const VectorXd& linearized() const { return linear_; }  ///< c + J d per constraint
  double costChange() const;                        ///< g^T d + 1/2 d^T H d, without the shift
  int factorizations() const { return factorizations_; }

  const std::vector<int>& constraints() const { return constraints_; }
  bool isEquality(int constraint) const { return equality_[constraint]; }

 private:
  double multiplier(int j, double value, const Problem& problem) const;
  double value(const VectorXd& d, const VectorXd& Hd, const VectorXd& linear, const Problem& problem) const;
  void linearize(const VectorXd& d, const Problem& problem, VectorXd& linear) const;
  void findWithinReach(const Problem& problem);
  void addRow(SkylineMatrix& matrix, const Jacobian& J, int row, double weight);
  void addHessianProduct(const VectorXd& d, VectorXd& sum);
  void solve(VectorXd& x);
  bool factorize(const Problem& problem);
  bool newtonStep(const Problem& problem);
  double roomAlong(const Problem& problem) const;

  /// Part of a row of J whose columns follow one another in the matrices.
  struct Run {
    const double* values;
    int place, width;
  };

  std::vector<int> costs_, constraints_;
  std::vector<int> place_;  ///< of each variable in H and K: those that couple to far ones come last, which keeps the rest a band
  bool reordered_ = false;
  std::vector<Run> runs_;
  VectorXd placed_, placed_sum_;
  std::vector<int> within_reach_;  ///< constraints that can matter in the box
  std::vector<int> out_of_reach_;  ///< those that cannot, and change with d all the same
  std::vector<bool> equality_, active_, factored_active_, fixed_, factored_fixed_, fixed_place_;
  SkylineMatrix H_, K_;
  VectorXd g_, d_, trial_, r_, s_, Hd_, trial_Hd_, linear_, trial_linear_;
  bool factored_ = false;
  int factorizations_ = 0;
};

}  // namespace kinegraph
