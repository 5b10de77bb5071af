#include "kinegraph/solvers/methods.h"

#include <algorithm>
#include <chrono>

#include "kinegraph/base/errors.h"
#include "kinegraph/base/text.h"
#include "kinegraph/nlp/finite_difference_nlp.h"
#include "kinegraph/solvers/interface/requirements.h"
#include "kinegraph/solvers/methods/derivative_free.h"
#include "kinegraph/solvers/methods/first_order.h"
#include "kinegraph/solvers/methods/penalty_methods.h"
#include "kinegraph/solvers/methods/sequential_quadratic.h"

namespace kinegraph {

namespace {

/// Each part gets the evaluations that the one before left.
SolverResult slackThenBarrier(Nlp& nlp, const VectorXd& x0, const SolverOptions& options, const EvaluationHook& hook) {
  SolverResult first = solveSlack(nlp, x0, options, hook);
  if (first.status != SolverStatus::converged || first.evals >= options.stopEvals) return first;
  SolverOptions rest = options;
  rest.stopEvals -= first.evals;
  SolverResult second = solveLogBarrier(nlp, first.x, rest, hook);
  second.evals += first.evals;
  return second;
}

/// The augmented Lagrangian. Where the curvature has to be learnt, a sequence of quadratic programs gets half of the
/// evaluations first, and the better of both is the result if neither converges.
SolverResult solveDefault(Nlp& nlp, const VectorXd& x0, const SolverOptions& options, const VectorXd& dual,
                          const EvaluationHook& hook, AugmentedLagrangianMemory* memory) {
  if (x0.size() != nlp.dimension() || !needsLearntCurvature(nlp, x0))
    return solveAugmentedLagrangian(nlp, x0, options, dual, hook, memory);
  SolverOptions part = options;
  part.stopEvals = std::max(1, options.stopEvals / 2);
  SolverResult first = solveSequentialQuadratic(nlp, x0, part, hook);
  if (first.status == SolverStatus::converged || first.status == SolverStatus::cancelled ||
      first.evals >= options.stopEvals)
    return first;
  part.stopEvals = options.stopEvals - first.evals;
  SolverResult second = solveAugmentedLagrangian(nlp, x0, part, dual, hook, memory);
  const double tolerance = options.constraintTolerance();
  const bool first_is_better = second.status != SolverStatus::converged && first.violation <= tolerance &&
                               (second.violation > tolerance || first.f + first.sos < second.f + second.sos);
  const int evals = first.evals + second.evals;
  SolverResult& better = first_is_better ? first : second;
  better.evals = evals;
  return std::move(better);
}

SolverResult dispatch(Nlp& nlp, const VectorXd& x0, const SolverOptions& options, const VectorXd& dual,
                      const EvaluationHook& hook, AugmentedLagrangianMemory* memory) {
  switch (options.method) {
    case OptMethod::augmentedLag:
      return solveDefault(nlp, x0, options, dual, hook, memory);
    case OptMethod::newton:
      requireNoConstraints(nlp, "newton");
      return solveAugmentedLagrangian(nlp, x0, options, {}, hook, memory);
    case OptMethod::gradientDescent:
      return solveGradientDescent(nlp, x0, options, hook);
    case OptMethod::rprop:
      return solveRprop(nlp, x0, options, hook);
    case OptMethod::LBFGS:
      return solveLbfgs(nlp, x0, options, hook);
    case OptMethod::NelderMead:
      return solveNelderMead(nlp, x0, options, hook);
    case OptMethod::CMA:
      return solveCma(nlp, x0, options, hook);
    case OptMethod::squaredPenalty:
      return solveSquaredPenalty(nlp, x0, options, hook, false);
    case OptMethod::singleSquaredPenalty:
      return solveSquaredPenalty(nlp, x0, options, hook, true);
    case OptMethod::logBarrier:
      return solveLogBarrier(nlp, x0, options, hook);
    case OptMethod::slackGN:
      return solveSlack(nlp, x0, options, hook);
    case OptMethod::slackGN_logBarrier:
      return slackThenBarrier(nlp, x0, options, hook);
    default:
      break;
  }
  std::vector<std::string> names;
  for (OptMethod method : availableMethods()) names.push_back(optMethodName(method));
  throw ValueError(cat("OptMethod::", optMethodName(options.method), " is not available; there are ", join(names)));
}

}  // namespace

const std::vector<OptMethod>& availableMethods() {
  using M = OptMethod;
  static const std::vector<M> methods = {
      M::augmentedLag, M::squaredPenalty, M::singleSquaredPenalty, M::logBarrier, M::slackGN,    M::slackGN_logBarrier,
      M::newton,       M::LBFGS,          M::gradientDescent,      M::rprop,      M::NelderMead, M::CMA};
  return methods;
}

SolverResult solve(Nlp& nlp, const VectorXd& x0, const SolverOptions& options, const VectorXd& dual,
                   const EvaluationHook& hook, AugmentedLagrangianMemory* memory) {
  const auto start = std::chrono::steady_clock::now();
  SolverResult result;
  if (options.finiteDifference > 0.) {
    FiniteDifferenceNlp numeric(nlp, options.finiteDifference);
    result = dispatch(numeric, x0, options, dual, hook, nullptr);
  } else {
    result = dispatch(nlp, x0, options, dual, hook, memory);
  }
  result.time = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

}  // namespace kinegraph
