#include "kinegraph/solvers/result.h"

#include "kinegraph/base/text.h"

namespace kinegraph {

std::string solverStatusName(SolverStatus status) {
  switch (status) {
    case SolverStatus::converged: return "converged";
    case SolverStatus::infeasible: return "infeasible";
    case SolverStatus::stalled: return "stalled";
    case SolverStatus::limit: return "limit";
    case SolverStatus::cancelled: return "cancelled";
  }
  return "";
}

std::string SolverResult::str() const {
  std::string dimension = x.size() > 0 ? cat(x.size()) : "";
  return cat("{ time: ", time, ", evals: ", evals, ", done: ", int(done), ", feasible: ", int(feasible), ", eq: ", eq, ", ineq: ", ineq,
             ", sos: ", sos, ", f: ", f, ", x-dim: [", dimension, "] }");
}

}  // namespace kinegraph
