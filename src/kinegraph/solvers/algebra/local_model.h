#pragma once

#include <memory>
#include <vector>

#include "kinegraph/nlp/nlp.h"

namespace kinegraph::inline solvers_internal {

/// A local model of the augmented Lagrangian, with linearized residuals, as a function of a step d in a box:
///
///     m(d) = g^T d + 1/2 d^T (H + damping I) d + 1/(2 mu) sum_j t_j(d)^2,     t_j = lambda_j + mu (c_j + J_j d)
///
/// with t_j clipped at zero for inequalities. A semismooth Newton method minimizes this piecewise quadratic function.
/// It starts from the last step if only multipliers, weights or constraint values have changed. Minimization does not
/// allocate. One model serves many points, and several solves of a problem.
class LocalModel {
 public:
  virtual ~LocalModel() = default;

  /// Sets the Jacobian at a point. `J` must not change while the model is used.
  virtual void setJacobian(const Jacobian& J) = 0;

  /// Sets g and H = 2 Js^T Js from residuals at the same point. H also has the Hessian of the f terms, or `curvature`
  /// if the problem does not know it. False if that Hessian is needed and missing.
  virtual bool setCosts(Nlp& nlp, const VectorXd& x, const VectorXd& phi, const MatrixXd* curvature = nullptr) = 0;

  /// Adds the known second derivatives of the constraints times `multipliers` to H, at the point of the problem. The
  /// model omits them if it is not convex with them.
  virtual void addCurvature(Nlp& nlp, const VectorXd& multipliers) = 0;

  /// Sets costs of zero and H = weight I: a model of the violation only.
  virtual void setNoCosts(double weight) = 0;

  virtual double largestCurvature() const = 0;  ///< largest diagonal entry of H

  struct Problem {
    const VectorXd& c;       ///< per constraint
    const VectorXd& lambda;  ///< per constraint
    double mu;
    double damping;
    const VectorXd& low;  ///< box of d
    const VectorXd& high;
    int max_passes;
  };

  /// Estimates the length of the minimizing step from the factorization of the last model, for close points. Infinite
  /// if the active set differs or bounds are active.
  virtual double estimateStep(const Problem& problem) = 0;

  /// Computes the minimizing step. The methods below refer to it.
  virtual const VectorXd& minimize(const Problem& problem) = 0;
  virtual double decrease(const Problem& problem) const = 0;  ///< m(0) - m(d), without the damping
  const VectorXd& step() const { return step_; }
  const VectorXd& linearized() const { return linear_; }  ///< c + J d per constraint
  int factorizations() const { return factorizations_; }

 protected:
  VectorXd step_, linear_;
  int factorizations_ = 0;
};

/// Creates a model. `pattern` is that of the Jacobian; `costs` are the residuals in H, `constraints` those of the sum.
std::unique_ptr<LocalModel> makeLocalModel(const Nlp& nlp, const Jacobian& pattern, const std::vector<int>& costs,
                                           std::vector<int> constraints);

}  // namespace kinegraph::inline solvers_internal
