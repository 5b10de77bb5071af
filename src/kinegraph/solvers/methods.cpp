#include "kinegraph/solvers/nlp_solver.h"

#include <algorithm>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/stopwatch.h"
#include "kinegraph/common/text.h"
#include "kinegraph/nlp/finite_difference_nlp.h"
#include "kinegraph/solvers/interface/requirements.h"
#include "kinegraph/solvers/methods/derivative_free.h"
#include "kinegraph/solvers/methods/first_order.h"
#include "kinegraph/solvers/methods/penalty_methods.h"
#include "kinegraph/solvers/methods/sequential_quadratic.h"

namespace kinegraph {

namespace {

/// Runs solveSlack, then solveLogBarrier with the remaining evaluations.
SolverResult slackThenBarrier(Nlp& nlp, const VectorXd& x0, const SolverOptions& options,
                              const EvaluationCallback& callback) {
  SolverResult first = solveSlack(nlp, x0, options, callback);
  if (first.status != SolverStatus::converged || first.evals >= options.stopEvals) return first;
  SolverOptions rest = options;
  rest.stopEvals -= first.evals;
  SolverResult second = solveLogBarrier(nlp, first.x, rest, callback);
  second.evals += first.evals;
  return second;
}

/// Runs the augmented Lagrangian. For small problems with general costs, sequential quadratic programming gets half of
/// the evaluations first; if neither method converges, the better result is returned.
SolverResult solveDefault(Nlp& nlp, const VectorXd& x0, const SolverOptions& options, const VectorXd& dual,
                          const EvaluationCallback& callback, AugmentedLagrangianMemory* memory) {
  const CostCurvature curvature = x0.size() == nlp.dimension() ? costCurvature(nlp, x0) : CostCurvature::squares;
  if (curvature != CostCurvature::unknown && curvature != CostCurvature::known)
    return solveAugmentedLagrangian(nlp, x0, options, dual, callback, memory);
  SolverOptions part = options;
  part.stopEvals = std::max(1, options.stopEvals / 2);
  SolverResult first = solveSequentialQuadratic(nlp, x0, part, callback, dual);
  if (first.status == SolverStatus::converged || first.status == SolverStatus::cancelled ||
      first.evals >= options.stopEvals)
    return first;
  part.stopEvals = options.stopEvals - first.evals;
  SolverResult second = solveAugmentedLagrangian(nlp, x0, part, dual, callback, memory);
  const double tolerance = options.constraintTolerance();
  const bool first_is_better = second.status != SolverStatus::converged && first.violation <= tolerance &&
                               (second.violation > tolerance || first.f + first.sos < second.f + second.sos);
  const int evals = first.evals + second.evals;
  SolverResult& better = first_is_better ? first : second;
  better.evals = evals;
  return std::move(better);
}

/// The arguments of `solve`.
struct Call {
  Nlp& nlp;
  const VectorXd& x0;
  const SolverOptions& options;
  const VectorXd& dual;
  const EvaluationCallback& callback;
  AugmentedLagrangianMemory* memory;
};

/// An entry of the table of methods.
struct MethodEntry {
  OptMethod method;
  SolverResult (*run)(const Call& call);
};

using M = OptMethod;

constexpr MethodEntry kMethods[] = {
    {M::augmentedLag, [](const Call& c) { return solveDefault(c.nlp, c.x0, c.options, c.dual, c.callback, c.memory); }},
    {M::squaredPenalty, [](const Call& c) { return solveSquaredPenalty(c.nlp, c.x0, c.options, c.callback, false); }},
    {M::singleSquaredPenalty,
     [](const Call& c) { return solveSquaredPenalty(c.nlp, c.x0, c.options, c.callback, true); }},
    {M::logBarrier, [](const Call& c) { return solveLogBarrier(c.nlp, c.x0, c.options, c.callback); }},
    {M::slackGN, [](const Call& c) { return solveSlack(c.nlp, c.x0, c.options, c.callback); }},
    {M::slackGN_logBarrier, [](const Call& c) { return slackThenBarrier(c.nlp, c.x0, c.options, c.callback); }},
    {M::newton,
     [](const Call& c) {
       requireNoConstraints(c.nlp, "newton");
       return solveAugmentedLagrangian(c.nlp, c.x0, c.options, {}, c.callback, c.memory);
     }},
    {M::LBFGS, [](const Call& c) { return solveLbfgs(c.nlp, c.x0, c.options, c.callback); }},
    {M::gradientDescent, [](const Call& c) { return solveGradientDescent(c.nlp, c.x0, c.options, c.callback); }},
    {M::rprop, [](const Call& c) { return solveRprop(c.nlp, c.x0, c.options, c.callback); }},
    {M::NelderMead, [](const Call& c) { return solveNelderMead(c.nlp, c.x0, c.options, c.callback); }},
    {M::CMA, [](const Call& c) { return solveCma(c.nlp, c.x0, c.options, c.callback); }},
};

SolverResult dispatch(const Call& call) {
  for (const MethodEntry& entry : kMethods) {
    if (entry.method == call.options.method) return entry.run(call);
  }
  std::vector<std::string> names;
  for (const MethodEntry& entry : kMethods) names.push_back(optMethodName(entry.method));
  throw ValueError(
      cat("OptMethod::", optMethodName(call.options.method), " is not available; expected one of ", join(names)));
}

}  // namespace

const std::vector<OptMethod>& availableMethods() {
  static const std::vector<OptMethod> methods = [] {
    std::vector<OptMethod> all;
    for (const MethodEntry& entry : kMethods) all.push_back(entry.method);
    return all;
  }();
  return methods;
}

void agreeOnFeasibility(SolverResult& result) {
  if (result.status == SolverStatus::infeasible && result.feasible) {
    result.status = SolverStatus::stalled;
    result.message =
        cat("the constraints hold within the tolerance, but their violation ", result.violation, " no longer falls");
  } else if (result.status == SolverStatus::converged && !result.feasible) {
    result.status = SolverStatus::stalled;
    result.message = cat("steps are tiny, but a constraint is violated by ", result.violation);
  }
}

SolverResult solve(Nlp& nlp, const VectorXd& x0, const SolverOptions& options, const VectorXd& dual,
                   const EvaluationCallback& callback, AugmentedLagrangianMemory* memory) {
  const Stopwatch stopwatch;
  SolverResult result;
  if (options.finiteDifference > 0.) {
    FiniteDifferenceNlp numeric(nlp, options.finiteDifference);
    result = dispatch({numeric, x0, options, dual, callback, nullptr});
  } else {
    result = dispatch({nlp, x0, options, dual, callback, memory});
  }
  agreeOnFeasibility(result);
  result.totalEvals = result.evals;
  result.time = stopwatch.seconds();
  return result;
}

}  // namespace kinegraph
