#include "kinegraph/solvers/sampling/sampler.h"

#include <algorithm>
#include <limits>

#include "kinegraph/common/log.h"
#include "kinegraph/common/stopwatch.h"
#include "kinegraph/common/text.h"
#include "kinegraph/solvers/interface/best_so_far.h"
#include "kinegraph/solvers/sampling/interior_walk.h"
#include "kinegraph/solvers/sampling/sampled_problem.h"

namespace kinegraph {

VectorXd NlpSampler::seed(Rng& rng) {
  Nlp& nlp = *problem_;
  if (options.seedMethod == "gauss") return nlp.initialPoint(rng).cwiseMax(nlp.lower()).cwiseMin(nlp.upper());
  if (options.seedMethod == "uni" || samples_.empty()) return nlp.uniformPoint(rng);
  std::vector<VectorXd> candidates;
  std::vector<double> distances;
  for (int i = 0; i < options.seedCandidates; ++i) {
    candidates.push_back(nlp.uniformPoint(rng));
    double nearest = std::numeric_limits<double>::infinity();
    for (const VectorXd& sample : samples_) nearest = std::min(nearest, (sample - candidates.back()).norm());
    distances.push_back(nearest);
  }
  if (options.seedMethod == "nov")
    return candidates[std::size_t(std::max_element(distances.begin(), distances.end()) - distances.begin())];
  double sum = 0.;
  for (double distance : distances) sum += distance;
  double remaining = rng.uniform() * sum;
  for (std::size_t i = 0; i + 1 < candidates.size(); ++i) {
    if ((remaining -= distances[i]) < 0.) return candidates[i];
  }
  return candidates.back();
}

SolverResult NlpSampler::samplePoint(Rng& rng, const EvaluationCallback& callback) {
  SampledProblem problem(*problem_, options, callback);
  SampledPoint point;
  bool found = false;
  for (int attempt = 0; attempt < options.seedAttempts && !found && !problem.cancelled(); ++attempt) {
    SampledPoint next = problem.at(seed(rng));
    found = problem.goDownhill(next, rng, true);
    if (!found && options.downhillNoiseMethod != "none") found = problem.goDownhill(next, rng, false);
    if (attempt == 0 || found || next.slack < point.slack) point = std::move(next);
  }
  const int steps = options.interiorBurnInSteps + options.interiorSampleSteps;
  if (found && !problem.cancelled() && steps > 0 && options.interiorMethod != "none" && point.x.size() > 0) {
    point = walkInside(problem, point, steps, rng);
  }
  SolverResult result;
  result.x = point.x;
  result.dual = VectorXd::Zero(point.phi.size());
  result.evals = result.totalEvals = problem.evals();
  result.setSums(problem_->types(), point.phi, 0.);
  result.feasible = problem.isFeasible(point);
  result.status = problem.cancelled() ? SolverStatus::cancelled
                  : result.feasible   ? SolverStatus::converged
                                      : SolverStatus::infeasible;
  result.message = problem.cancelled() ? "cancelled by the caller"
                   : result.feasible   ? cat("a sample with a sum of violations of ", point.slack)
                                       : cat("the descent ended at a sum of violations of ", point.slack);
  VectorXd phi(point.phi.size());
  problem_->evaluate(point.x, phi, nullptr);  // leaves the problem at the sample
  if (result.feasible && !problem.cancelled()) samples_.push_back(result.x);
  return result;
}

SolverResult NlpSampler::sample(Rng& rng, const EvaluationCallback& callback) {
  options.validate();
  const Stopwatch stopwatch;
  const bool may_be_cancelled = problem_->mayBeCancelled();
  BestSoFar best(*problem_, options.tolerance);
  int calls = 0;
  const EvaluationCallback seen = [&](const VectorXd& x, const VectorXd& phi) {
    ++calls;
    best.see(x, phi);
    return !callback || callback(x, phi);
  };
  SolverResult result;
  try {
    result = samplePoint(rng, may_be_cancelled ? seen : callback);
  } catch (const EvaluationCancelled&) {
    if (!best.isKnown()) throw;
    result = best.result(calls);
    result.dual = VectorXd::Zero(Eigen::Index(problem_->types().size()));
    problem_->leaveAt(result.x);
  }
  result.problem = problem_;
  result.time = stopwatch.seconds();
  if (options.verbose > 0) logMessage(LogLevel::info, cat("==sampler== ", result.message, "  ", result.str()));
  return result;
}

}  // namespace kinegraph
