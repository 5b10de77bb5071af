#include "kinegraph/solvers/result.h"

#include <algorithm>

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

std::string explain(const Nlp& nlp, const VectorXd& phi, double tolerance, int at_most) {
  std::vector<std::pair<double, int>> violated;
  for (int row = 0; row < int(nlp.types().size()); ++row) {
    const double v = violation(nlp.types()[row], phi[row]);
    if (v > tolerance) violated.emplace_back(v, row);
  }
  if (violated.empty()) return cat("All constraints hold to ", tolerance, ".");
  std::stable_sort(violated.begin(), violated.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  std::string text = cat(violated.size(), violated.size() == 1 ? " constraint is" : " constraints are", " violated (scaled values):");
  for (int i = 0; i < int(violated.size()) && i < at_most; ++i) {
    text += cat("\n  ", nlp.rowName(violated[i].second), ": ", violated[i].first);
  }
  if (int(violated.size()) > at_most) text += cat("\n  and ", int(violated.size()) - at_most, " more");
  return text;
}

}  // namespace kinegraph
