#pragma once

#include "kinegraph/common/random.h"
#include "kinegraph/solvers/interface/options.h"
#include "kinegraph/solvers/interface/result.h"
#include "kinegraph/solvers/sampling/sampler.h"

namespace kinegraph::inline solvers_internal {

/// A point with its violation and energy.
struct SampledPoint {
  VectorXd x, phi;
  double slack = 0.;   ///< sum of all violations; infinite outside of the bounds or if a number is not finite
  double energy = 0.;  ///< sum of f, sos and violated ineqP
};

/// Samples independent numbers of mean 0 and variance 1.
VectorXd normalVector(Eigen::Index n, Rng& rng);

/// A problem for sampling: counts evaluations and moves points to the constraints.
class SampledProblem {
 public:
  SampledProblem(Nlp& nlp, const SamplerOptions& options, const EvaluationCallback& callback);

  Nlp& nlp() { return nlp_; }
  const SamplerOptions& options() const { return options_; }
  int evals() const { return evals_; }
  bool cancelled() const { return cancelled_; }  ///< whether the callback cancelled it
  bool isFeasible(const SampledPoint& point) const { return point.slack <= options_.tolerance; }
  bool hasEqualities() const { return !equalities_.empty(); }

  /// Evaluates a point. Throws ValueError if numbers of the first point are not finite.
  SampledPoint at(const VectorXd& x);

  /// Return the Jacobian and values of the equalities at a point, and the gradient of its energy.
  MatrixXd equalityJacobian(const SampledPoint& point);
  VectorXd equalities(const SampledPoint& point) const;
  VectorXd energyGradient(const SampledPoint& point);

  /// Moves a point to the constraints; true if it is feasible at the end. `noisy` adds the noise of the options.
  bool goDownhill(SampledPoint& point, Rng& rng, bool noisy);

 private:
  void differentiate(const SampledPoint& point);
  VectorXd downhillStep(const SampledPoint& point, double alpha, Rng& rng, bool noisy, double& predicted);

  Nlp& nlp_;
  const SamplerOptions& options_;
  const EvaluationCallback& callback_;
  std::vector<int> equalities_;
  Jacobian J_;
  VectorXd differentiated_;  ///< x of J_
  int evals_ = 0;
  bool cancelled_ = false;
};

}  // namespace kinegraph::inline solvers_internal
