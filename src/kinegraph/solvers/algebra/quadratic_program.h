#pragma once

#include "kinegraph/math/pose.h"
#include "kinegraph/solvers/algebra/dual_active_set.h"

namespace kinegraph::inline solvers_internal {

/// min 1/2 x^T H x + g^T x  subject to  A x + b = 0 in the first `equalities` rows and A x + b <= 0 in the others.
struct QuadraticProgram {
  MatrixXd H;  ///< n x n, symmetric positive definite
  VectorXd g;
  MatrixXd A;  ///< m x n
  VectorXd b;
  int equalities = 0;
};

struct QuadraticSolution {
  VectorXd x;
  VectorXd multipliers;  ///< of the rows of A: H x + g + A^T multipliers = 0
  QuadraticStatus status = QuadraticStatus::solved;
};

/// Solves the program with `workspace`, after scaling the rows of A to length 1. Inequalities without variables (rows
/// of zeros) are ignored.
QuadraticSolution solve(const QuadraticProgram& program, DualActiveSet& workspace);
QuadraticSolution solve(const QuadraticProgram& program);

}  // namespace kinegraph::inline solvers_internal
