#pragma once

#include <memory>
#include <vector>

#include "kinegraph/nlp/nlp.h"

namespace kinegraph {

/// The augmented Lagrangian around a point, with linearized residuals, as a function of a step d in a box:
///
///     m(d) = g^T d + 1/2 d^T (H + damping I) d + 1/(2 mu) sum_j t_j(d)^2,     t_j = lambda_j + mu (c_j + J_j d)
///
/// with t_j cut off at zero for inequalities. It is piecewise quadratic, and minimized by a semismooth Newton method,
/// which goes on from the last step where only multipliers, weights or constraints have changed since. Holds all its
/// memory; minimizing requests none. It is of use at many points, and for several solutions of a problem.
class LocalModel {
 public:
  virtual ~LocalModel() = default;

  /// Takes the rows of J at a point. `J` must stay as it is while this is used.
  virtual void setJacobian(const Jacobian& J) = 0;

  /// Takes g and H = 2 Js^T Js (+ the Hessian of the f terms, or where the problem has none to offer `curvature`, if
  /// given) from residuals at the same point. False if the Hessian of the f terms would be needed and is missing.
  virtual bool setCosts(Nlp& nlp, const VectorXd& x, const VectorXd& phi, const MatrixXd* curvature = nullptr) = 0;

  /// Adds the second derivatives of the constraints times `multipliers` to H, as far as the problem tells them at the
  /// point where it stands. They are left out where the model is not convex with them.
  virtual void addCurvature(Nlp& nlp, const VectorXd& multipliers) = 0;

  /// No costs, H = weight I: the model of the violation alone.
  virtual void setNoCosts(double weight) = 0;

  virtual double largestCurvature() const = 0;  ///< of the costs: largest diagonal entry of H

  struct Problem {
    const VectorXd& c;       ///< per constraint
    const VectorXd& lambda;  ///< per constraint
    double mu;
    double damping;
    const VectorXd& low;  ///< box of d
    const VectorXd& high;
    int max_passes;
  };

  /// About how long the minimizing step is, by the factor of the model before: for points next to each other. Infinite
  /// where other rows are active now, or bounds are touched.
  virtual double estimateStep(const Problem& problem) = 0;

  /// The minimizing step; its parts can be asked for then. Counts factorizations.
  virtual const VectorXd& minimize(const Problem& problem) = 0;
  virtual double decrease(const Problem& problem) const = 0;  ///< m(0) - m(d), without the damping
  const VectorXd& step() const { return step_; }
  const VectorXd& linearized() const { return linear_; }  ///< c + J d per constraint
  int factorizations() const { return factorizations_; }

 protected:
  VectorXd step_, linear_;
  int factorizations_ = 0;
};

/// `pattern` is that of the problem's Jacobian, `costs` are the rows whose squares are in H, `constraints` those of the
/// sum.
std::unique_ptr<LocalModel> makeLocalModel(const Nlp& nlp, const Jacobian& pattern, const std::vector<int>& costs,
                                           std::vector<int> constraints);

}  // namespace kinegraph
