#pragma once

#include "kinegraph/common/random.h"
#include "kinegraph/solvers/interface/evaluation_hook.h"
#include "kinegraph/solvers/interface/options.h"
#include "kinegraph/solvers/interface/result.h"
#include "kinegraph/solvers/sampling/sampler_options.h"

namespace kinegraph {

/// A point of a problem, as a sampler sees it.
struct SampledPoint {
  VectorXd x, phi;
  double slack = 0.;   ///< sum of all violations; infinite where a number is not finite, or outside of the bounds
  double energy = 0.;  ///< sum of f, sos and violated ineqP
};

/// Independent numbers, each of mean 0 and variance 1.
VectorXd normalVector(Eigen::Index n, Rng& rng);

/// A problem that is sampled: counts evaluations and finds the way to the constraints.
class SampledProblem {
 public:
  SampledProblem(Nlp& nlp, const SamplerOptions& options, const EvaluationHook& hook);

  Nlp& nlp() { return nlp_; }
  const SamplerOptions& options() const { return options_; }
  int evals() const { return evals_; }
  bool cancelled() const { return cancelled_; }  ///< by the hook
  bool good(const SampledPoint& point) const { return point.slack <= options_.tolerance; }
  bool hasEqualities() const { return !equalities_.empty(); }

  /// Throws ValueError for a first point with numbers that are not finite.
  SampledPoint at(const VectorXd& x);

  /// Rows of the Jacobian and values of the equalities at a point, and the gradient of its energy.
  MatrixXd equalityJacobian(const SampledPoint& point);
  VectorXd equalities(const SampledPoint& point) const;
  VectorXd energyGradient(const SampledPoint& point);

  /// Steps towards the constraints until the point is good. `noisy`: with the noise that the options ask for.
  bool goDownhill(SampledPoint& point, Rng& rng, bool noisy);

 private:
  void differentiate(const SampledPoint& point);
  VectorXd downhillStep(const SampledPoint& point, double alpha, Rng& rng, bool noisy, double& predicted);

  Nlp& nlp_;
  const SamplerOptions& options_;
  const EvaluationHook& hook_;
  std::vector<int> equalities_;
  Jacobian J_;
  VectorXd differentiated_;  ///< x of J_
  int evals_ = 0;
  bool cancelled_ = false;
};

}  // namespace kinegraph
