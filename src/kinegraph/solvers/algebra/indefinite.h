#pragma once

#include <optional>

#include "kinegraph/math/pose.h"

namespace kinegraph::inline solvers_internal {

/// The quadratic function 1/2 d^T H d + g^T d.
struct QuadraticFunction {
  MatrixXd H;
  VectorXd g;
};

/// Returns a strictly convex replacement of 1/2 d^T W d + g^T d. If W is convex on A d + b = 0, the replacement is
/// equal there up to a constant, so that minima with these active constraints and their multipliers stay the same: it
/// is W itself, or W plus a multiple of the squared distance from A d + b = 0. Otherwise negative curvatures along the
/// constraints change their sign, so that steps lead away from saddles, and each of them is at least `least`.
/// Sources: Nocedal & Wright, Numerical Optimization, 2nd ed., ch. 3.4 and 18.4; Dauphin et al., Identifying and
/// attacking the saddle point problem, 2014.
QuadraticFunction convexified(const MatrixXd& W, const VectorXd& g, const MatrixXd& A, const VectorXd& b, double least);

/// Constraints on directions d: a^T d = 0 for the rows of `fixed`, a^T d <= 0 for those of `tight`.
struct Restriction {
  MatrixXd fixed, tight;
};

void appendRow(MatrixXd& rows, const Eigen::RowVectorXd& row);

/// Returns an orthonormal basis of the null space of the rows, in columns.
MatrixXd nullSpace(const MatrixXd& rows);

/// Returns a feasible direction of length 1 with d^T W d < -`least`, or none. The function searches the principal
/// directions and fixes tight constraints that block them. (Whether any such direction exists is NP-hard for tight
/// constraints.)
std::optional<VectorXd> negativeCurvature(const MatrixXd& W, Restriction rows, double least);

}  // namespace kinegraph::inline solvers_internal
