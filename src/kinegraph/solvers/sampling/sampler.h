#pragma once

#include <memory>
#include <string>
#include <vector>

#include "kinegraph/common/option_table.h"
#include "kinegraph/common/random.h"
#include "kinegraph/solvers/interface/result.h"

namespace kinegraph {

/// Options of NlpSampler; samplerOptionTable() documents each field. The names are those of the package robotic.
struct SamplerOptions {
  std::string seedMethod = "uni";
  int seedCandidates = 10;
  int seedAttempts = 10;
  double tolerance = 1e-3;
  std::string downhillMethod = "GN";
  int downhillMaxSteps = 50;
  double penaltyMu = 1.;
  double slackStepAlpha = 1.;
  double slackMaxStep = .1;
  double slackRegLambda = 1e-2;
  double ineqOverstep = -1.;
  std::string downhillNoiseMethod = "none";
  double downhillNoiseSigma = .1;
  std::string downhillRejectMethod = "Wolfe";
  std::string interiorMethod = "HR";
  int interiorBurnInSteps = 0;
  int interiorSampleSteps = 1;
  double interiorNoiseSigma = .5;
  double hitRunEqMargin = .1;
  double eps = 0.;
  double langevinTauPrime = -1.;
  int verbose = 0;

  /// Throws ValueError with the first invalid field.
  void validate() const;
};

/// Returns name, unit, meaning and range of each field, for messages, bindings and documents.
const OptionTable<SamplerOptions>& samplerOptionTable();

/// Samples points that satisfy the constraints of a problem. Descent steps lead from a seed to the constraints;
/// interior steps then move within them. With their number, the distribution of the samples converges, for any seed, to
/// the following:
///
///   HR           hit-and-run: uniform on the feasible set (equalities as thin shells, projected at the end)
///   MCMC         Metropolis steps: proportional to exp(-costs), on the surface of the equalities, if any
///   Langevin     as MCMC, with steps along the gradient of the costs
///   manifoldRRT  a tree that grows over the surface towards random points: no defined distribution
///
/// Here costs = sum f + sum sos. The same random numbers give the same samples.
/// Source: Toussaint, Braun & Ortiz-Haro, NLP Sampling, 2024; Neal, Slice sampling, 2003 (HR along a line);
/// Zappa, Holmes-Cerfon & Goodman, Monte Carlo on manifolds, 2018.
class NlpSampler {
 public:
  explicit NlpSampler(std::shared_ptr<Nlp> problem) : problem_(std::move(problem)) {}

  /// Samples a point. The status is `converged` for a feasible sample, `infeasible` if the descent did not reach the
  /// constraints, `cancelled` after the callback. Throws ValueError for invalid options. Throws EvaluationCancelled if
  /// an evaluation does so before the first value; later the result is the best point so far.
  SolverResult sample(Rng& rng, const EvaluationCallback& callback = {});

  const std::shared_ptr<Nlp>& problem() const { return problem_; }
  const std::vector<VectorXd>& samples() const { return samples_; }  ///< all feasible samples so far
  void clear() { samples_.clear(); }

  SamplerOptions options;

 private:
  VectorXd seed(Rng& rng);
  SolverResult samplePoint(Rng& rng, const EvaluationCallback& callback);

  std::shared_ptr<Nlp> problem_;
  std::vector<VectorXd> samples_;
};

}  // namespace kinegraph
