#include "kinegraph/solvers/interface/result.h"

#include <algorithm>

#include "kinegraph/common/text.h"

namespace kinegraph {

std::string solverStatusName(SolverStatus status) {
  switch (status) {
    case SolverStatus::converged:
      return "converged";
    case SolverStatus::infeasible:
      return "infeasible";
    case SolverStatus::stalled:
      return "stalled";
    case SolverStatus::limit:
      return "limit";
    case SolverStatus::cancelled:
      return "cancelled";
  }
  return "";
}

void SolverResult::setSums(const std::vector<ObjectiveType>& types, const VectorXd& phi, double tolerance) {
  const ErrorSums sums = sumErrors(types, phi);
  f = sums.f;
  sos = sums.sos;
  ineq = sums.ineq;
  eq = sums.eq;
  violation = largestViolation(types, phi);
  feasible = violation <= std::max(1e-3, 10. * tolerance);
  done = true;
}

std::optional<bool> SolverResult::free(const CancellationToken& cancellation) const {
  if (!validity) return std::nullopt;
  return validity->get(cancellation).valid;
}

std::string SolverResult::summary(const CancellationToken& cancellation) const {
  if (!validity || !feasible || validity->get(cancellation).valid) return message;
  return cat(message, "; the solution is invalid between slices: ", validity->get().message);
}

std::string SolverResult::str() const {
  std::string dimension = x.size() > 0 ? cat(x.size()) : "";
  return cat("{ time: ", time, ", evals: ", evals, ", done: ", int(done), ", feasible: ", int(feasible), ", eq: ", eq,
             ", ineq: ", ineq, ", sos: ", sos, ", f: ", f, ", x-dim: [", dimension, "] }");
}

}  // namespace kinegraph
