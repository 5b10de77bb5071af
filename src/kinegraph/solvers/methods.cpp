#include "kinegraph/solvers/methods.h"

#include <algorithm>
#include <chrono>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
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

/// The augmented Lagrangian. Where costs are general and the problem is small, a sequence of quadratic programs gets half of the
/// evaluations first, and the better of both is the result if neither converges.
SolverResult solveDefault(Nlp& nlp, const VectorXd& x0, const SolverOptions& options, const VectorXd& dual,
                          const EvaluationHook& hook, AugmentedLagrangianMemory* memory) {
  const CostCurvature curvature = x0.size() == nlp.dimension() ? costCurvature(nlp, x0) : CostCurvature::squares;
  if (curvature != CostCurvature::unknown && curvature != CostCurvature::known)
    return solveAugmentedLagrangian(nlp, x0, options, dual, hook, memory);
  SolverOptions part = options;
  part.stopEvals = std::max(1, options.stopEvals / 2);
  SolverResult first = solveSequentialQuadratic(nlp, x0, part, hook, dual);
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

/// What `solve` was called with.
struct Call {
  Nlp& nlp;
  const VectorXd& x0;
  const SolverOptions& options;
  const VectorXd& dual;
  const EvaluationHook& hook;
  AugmentedLagrangianMemory* memory;
};

/// The table of methods: a row each.
struct MethodRow {
  OptMethod method;
  SolverResult (*run)(const Call& call);
};

using M = OptMethod;

constexpr MethodRow kMethods[] = {
    {M::augmentedLag, [](const Call& c) { return solveDefault(c.nlp, c.x0, c.options, c.dual, c.hook, c.memory); }},
    {M::squaredPenalty, [](const Call& c) { return solveSquaredPenalty(c.nlp, c.x0, c.options, c.hook, false); }},
    {M::singleSquaredPenalty, [](const Call& c) { return solveSquaredPenalty(c.nlp, c.x0, c.options, c.hook, true); }},
    {M::logBarrier, [](const Call& c) { return solveLogBarrier(c.nlp, c.x0, c.options, c.hook); }},
    {M::slackGN, [](const Call& c) { return solveSlack(c.nlp, c.x0, c.options, c.hook); }},
    {M::slackGN_logBarrier, [](const Call& c) { return slackThenBarrier(c.nlp, c.x0, c.options, c.hook); }},
    {M::newton,
     [](const Call& c) {
       requireNoConstraints(c.nlp, "newton");
       return solveAugmentedLagrangian(c.nlp, c.x0, c.options, {}, c.hook, c.memory);
     }},
    {M::LBFGS, [](const Call& c) { return solveLbfgs(c.nlp, c.x0, c.options, c.hook); }},
    {M::gradientDescent, [](const Call& c) { return solveGradientDescent(c.nlp, c.x0, c.options, c.hook); }},
    {M::rprop, [](const Call& c) { return solveRprop(c.nlp, c.x0, c.options, c.hook); }},
    {M::NelderMead, [](const Call& c) { return solveNelderMead(c.nlp, c.x0, c.options, c.hook); }},
    {M::CMA, [](const Call& c) { return solveCma(c.nlp, c.x0, c.options, c.hook); }},
};

SolverResult dispatch(const Call& call) {
  for (const MethodRow& row : kMethods) {
    if (row.method == call.options.method) return row.run(call);
  }
  std::vector<std::string> names;
  for (const MethodRow& row : kMethods) names.push_back(optMethodName(row.method));
  throw ValueError(
      cat("OptMethod::", optMethodName(call.options.method), " is not available; there are ", join(names)));
}

}  // namespace

const std::vector<OptMethod>& availableMethods() {
  static const std::vector<OptMethod> methods = [] {
    std::vector<OptMethod> all;
    for (const MethodRow& row : kMethods) all.push_back(row.method);
    return all;
  }();
  return methods;
}

void agreeOnFeasibility(SolverResult& result) {
  if (result.status == SolverStatus::infeasible && result.feasible) {
    result.status = SolverStatus::stalled;
    result.message = cat("the constraints hold, but their violation no longer falls; it is ", result.violation);
  } else if (result.status == SolverStatus::converged && !result.feasible) {
    result.status = SolverStatus::stalled;
    result.message = cat("steps are tiny, but a constraint is violated by ", result.violation);
  }
}

SolverResult solve(Nlp& nlp, const VectorXd& x0, const SolverOptions& options, const VectorXd& dual,
                   const EvaluationHook& hook, AugmentedLagrangianMemory* memory) {
  const auto start = std::chrono::steady_clock::now();
  SolverResult result;
  if (options.finiteDifference > 0.) {
    FiniteDifferenceNlp numeric(nlp, options.finiteDifference);
    result = dispatch({numeric, x0, options, dual, hook, nullptr});
  } else {
    result = dispatch({nlp, x0, options, dual, hook, memory});
  }
  agreeOnFeasibility(result);
  result.totalEvals = result.evals;
  result.time = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

}  // namespace kinegraph
