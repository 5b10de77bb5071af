#pragma once

#include <memory>

#include "kinegraph/solvers/sampling/sampled_problem.h"

namespace kinegraph {

/// Draws points that satisfy the constraints of a problem: from a seed downhill to the constraints, and then some steps
/// within them. What the steps converge to with their number, whatever the seed:
///
///   HR           hit-and-run: the uniform distribution on the feasible set (equalities as thin shells, projected at
///                the end)
///   MCMC         Metropolis steps: exp(-costs), on the surface of the equalities where there are any
///   Langevin     the same, with steps that follow the gradient of the costs
///   manifoldRRT  spreads over the surface like a tree that grows towards random points; no distribution is promised
///
/// costs = sum f + sum sos. The same random numbers give the same samples.
/// Source: Toussaint, Braun & Ortiz-Haro, NLP Sampling, 2024; Neal, Slice sampling, 2003 (HR along a line);
/// Zappa, Holmes-Cerfon & Goodman, Monte Carlo on manifolds, 2018.
class NlpSampler {
 public:
  explicit NlpSampler(std::shared_ptr<Nlp> problem) : problem_(std::move(problem)) {}

  /// The status is `converged` for a feasible sample, `infeasible` if the way down did not reach the constraints,
  /// `cancelled` by the hook. Throws ValueError for options that make no sense, EvaluationCancelled where that came
  /// before the first value; later, the result is the best point seen.
  SolverResult sample(Rng& rng, const EvaluationHook& hook = {});

  const std::shared_ptr<Nlp>& problem() const { return problem_; }
  const std::vector<VectorXd>& samples() const { return samples_; }  ///< the feasible ones so far
  void clear() { samples_.clear(); }

  SamplerOptions options;

 private:
  VectorXd seed(Rng& rng);
  SolverResult draw(Rng& rng, const EvaluationHook& hook);

  std::shared_ptr<Nlp> problem_;
  std::vector<VectorXd> samples_;
};

}  // namespace kinegraph
