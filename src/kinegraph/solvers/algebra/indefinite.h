#pragma once

#include <optional>

#include "kinegraph/math/pose.h"

namespace kinegraph {

/// The quadratic function 1/2 d^T H d + g^T d.
struct QuadraticFunction {
  MatrixXd H;
  VectorXd g;
};

/// A strictly convex function in place of 1/2 d^T W d + g^T d. As long as W is convex where A d + b = 0, it is the same
/// there, up to a constant, so that least values with these rows active are the same, and so are their multipliers: it
/// is W itself, or W with a multiple of the squared distance from where A d + b = 0. Otherwise negative curvatures along
/// the rows have their sign changed, so that steps lead away from saddles, and none of those is less than `least`.
/// Sources: Nocedal & Wright, Numerical Optimization, 2nd ed., ch. 3.4 and 18.4; Dauphin et al., Identifying and
/// attacking the saddle point problem, 2014.
QuadraticFunction convexified(const MatrixXd& W, const VectorXd& g, const MatrixXd& A, const VectorXd& b, double least);

/// Rows that restrict where one can go: a^T d = 0 for those of `held`, a^T d <= 0 for those of `touched`.
struct Restriction {
  MatrixXd held, touched;
};

void appendRow(MatrixXd& rows, const Eigen::RowVectorXd& row);

/// An orthonormal basis of the vectors that all rows are orthogonal to, in columns.
MatrixXd nullSpace(const MatrixXd& rows);

/// A direction of length 1 that the rows admit, with d^T W d < -`least`; none if there is none among the directions of
/// principal curvature, with touched rows held as far as they are in the way. (Whether any direction exists at all is an
/// NP-hard question where rows are touched.)
std::optional<VectorXd> negativeCurvature(const MatrixXd& W, Restriction rows, double least);

}  // namespace kinegraph
