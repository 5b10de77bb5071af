#include "kinegraph/solvers/algebra/quadratic_program.h"

namespace kinegraph::inline solvers_internal {

QuadraticSolution solve(const QuadraticProgram& program, DualActiveSet& workspace) {
  const int n = int(program.g.size()), m = int(program.b.size());
  const VectorXd norms = program.A.rowwise().norm();
  workspace.resize(n, m);
  workspace.hessian() = program.H;
  workspace.gradient() = program.g;
  std::vector<int> rows;  // of the constraints
  rows.reserve(std::size_t(m));
  for (int row = 0; row < m; ++row) {
    if (row >= program.equalities && norms[row] == 0.) continue;
    const double scale = norms[row] > 0. ? 1. / norms[row] : 1.;
    const auto normal = -scale * program.A.row(row).transpose();
    if (row < program.equalities)
      workspace.addEquality(normal, scale * program.b[row]);
    else
      workspace.addInequality(normal, scale * program.b[row]);
    rows.push_back(row);
  }
  QuadraticSolution solution{VectorXd::Zero(n), VectorXd::Zero(m), workspace.solve()};
  if (solution.status == QuadraticStatus::notConvex) return solution;
  solution.x = workspace.x();
  for (int k = 0; k < workspace.activeCount(); ++k) {
    const int row = rows[std::size_t(workspace.active(k))];
    solution.multipliers[row] = workspace.multiplier(k) / (norms[row] > 0. ? norms[row] : 1.);
  }
  return solution;
}

QuadraticSolution solve(const QuadraticProgram& program) {
  DualActiveSet workspace;
  return solve(program, workspace);
}

}  // namespace kinegraph::inline solvers_internal
