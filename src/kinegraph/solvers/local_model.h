#pragma once

#include <algorithm>
#include <vector>

#include "kinegraph/math/banded_matrix.h"
#include "kinegraph/nlp/nlp.h"

namespace kinegraph {

/// The augmented Lagrangian around a point, with linearized residuals, as a function of a step d in a box:
///
///     m(d) = g^T d + 1/2 d^T (H + shift I) d + 1/(2 mu) sum_j t_j(d)^2,     t_j = lambda_j + mu (c_j + J_j d)
///
/// with t_j cut off at zero for inequalities. It is piecewise quadratic, and minimized by a semismooth Newton method,
/// which goes on from the last step where only multipliers, weights or constraints have changed since. Holds all its memory; minimizing requests none. It is of use at many points, and for several solutions of a problem.
class LocalModel {
 public:
  /// `pattern` is that of the problem's Jacobian, `costs` are the rows whose squares are in H, `constraints` those of the sum.
  LocalModel(const Nlp& nlp, const Jacobian& pattern, const std::vector<int>& costs, std::vector<int> constraints);
  LocalModel(const LocalModel&) = delete;

  /// Takes the rows of J at a point. `J` must stay as it is while this is used.
  void setJacobian(const Jacobian& J);

  /// Takes g and H = 2 Js^T Js (+ the Hessian of the f terms, or where the problem has none to offer `curvature`, if given)
  /// from residuals at the same point. False if the Hessian of the f terms would be needed and is missing.
  bool setCosts(Nlp& nlp, const VectorXd& x, const VectorXd& phi, const MatrixXd* curvature = nullptr);

  /// No costs, H = weight I: the model of the violation alone.
  void setNoCosts(double weight);

  double largestCurvature() const;  ///< of the costs: largest diagonal entry of H

  struct Problem {
    const VectorXd& c;       ///< per constraint
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
  double decrease(const Problem& problem) const;    ///< m(0) - m(d), without the shift
  int factorizations() const { return factorizations_; }

 private:
  double multiplier(int j, double value, const Problem& problem) const;
  double value(const VectorXd& d, const VectorXd& Hd, const VectorXd& linear, const Problem& problem) const;
  void linearize(const VectorXd& d, const Problem& problem, VectorXd& linear) const;
  void findWithinReach(const Problem& problem);
  void begin(const Problem& problem);
  void addRow(BandedMatrix& matrix, int row, double weight, int from = 0);
  void addHessianProduct(const VectorXd& d, VectorXd& sum);
  void solve(VectorXd& x);
  BandedMatrix& ownHessian();
  int firstChange(const Problem& problem) const;
  bool factorize(const Problem& problem, int first);
  bool newtonStep(const Problem& problem);
  void findChangesAlongStep(const Problem& problem);
  double roomAlong(const Problem& problem, double most) const;
  double lengthAlong(const Problem& problem, double most) const;
  void move(const Problem& problem, double alpha);
  bool moveIntoBox(const Problem& problem, double& moved);
  void putOnBounds(VectorXd& d, const Problem& problem) const;
  bool keepsActiveSet(const Problem& problem) const;
  bool isAnyFixed() const { return std::find(fixed_.begin(), fixed_.end(), true) != fixed_.end(); }

  /// Part of a row of J whose columns follow one another in the matrices.
  struct Run {
    const double* values;
    int place, width;
  };
  using Flags = std::vector<char>;

  const Jacobian* J_ = nullptr;
  std::vector<int> linear_costs_;   ///< rows whose squares are in H, of which J is the same everywhere
  std::vector<int> other_costs_;
  std::vector<int> constraints_;    ///< rows
  std::vector<int> place_;          ///< of each variable in H and K
  bool reordered_ = false, has_f_ = false, knows_linear_costs_ = false;
  std::vector<Run> runs_;
  VectorXd placed_, placed_sum_;
  std::vector<int> equalities_, inequalities_;  ///< constraints; of the latter those that depend on x here
  std::vector<int> within_reach_;   ///< constraints that can matter in the box
  std::vector<int> out_of_reach_;   ///< those that cannot, and change with d all the same
  Flags is_equality_, active_, factored_active_, fixed_, factored_fixed_;
  BandedMatrix H_linear_, H_own_, K_;  ///< of linear costs; of others as well, where there are some; the factor
  BandedMatrix* H_ = &H_linear_;
  VectorXd g_, d_, trial_, r_, s_, Hd_, Hs_, trial_Hd_, linear_, trial_linear_, step_linear_;
  bool is_new_ = true, factored_ = false, factored_as_is_ = true;  ///< without more on the diagonal than the shift
  double factored_mu_ = 0., factored_shift_ = 0.;
  int factorizations_ = 0;
};

}  // namespace kinegraph
