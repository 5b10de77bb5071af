#pragma once

#include "kinegraph/math/pose.h"

namespace kinegraph {

/// min 1/2 x^T H x + g^T x  subject to  A x + b = 0 in the first `equalities` rows and A x + b <= 0 in the others.
struct QuadraticProgram {
  MatrixXd H;  ///< n x n, symmetric positive definite
  VectorXd g;
  MatrixXd A;  ///< m x n
  VectorXd b;
  int equalities = 0;
};

enum class QuadraticStatus { solved, infeasible, notConvex, stalled };

struct QuadraticSolution {
  VectorXd x;
  VectorXd multipliers;  ///< of the rows of A: H x + g + A^T multipliers = 0
  QuadraticStatus status = QuadraticStatus::solved;
};

/// Solves a small dense convex quadratic program exactly, by the dual active-set method: it starts at the minimum
/// without constraints and takes in violated ones, one by one, while the multipliers keep their sign. Of rows that
/// depend on others it takes those that it needs. Source: Goldfarb & Idnani, A numerically stable dual method for
/// solving strictly convex quadratic programs, 1983.
QuadraticSolution solve(const QuadraticProgram& program);

}  // namespace kinegraph
