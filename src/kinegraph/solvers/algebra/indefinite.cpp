#include "kinegraph/solvers/algebra/indefinite.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <algorithm>
#include <vector>

namespace kinegraph::inline solvers_internal {

namespace {

constexpr double kLeastRelative = 1e-8;  ///< smallest relevant curvature, in units of the largest entry
constexpr double kRowWeight = 10.;       ///< curvature across constraints, in units of the largest entry of W
constexpr double kAdmitted = 1e-9;       ///< largest a^T d of a feasible direction, for rows of length 1

bool isConvex(const MatrixXd& W, double least) {
  MatrixXd shifted = W;
  shifted.diagonal().array() -= least;
  return Eigen::LLT<MatrixXd>(shifted).info() == Eigen::Success;
}

std::vector<Eigen::Index> blockingRows(const MatrixXd& rows, const VectorXd& d) {
  std::vector<Eigen::Index> found;
  for (Eigen::Index j = 0; j < rows.rows(); ++j) {
    if (rows.row(j).dot(d) > kAdmitted) found.push_back(j);
  }
  return found;
}

}  // namespace

QuadraticFunction convexified(const MatrixXd& W, const VectorXd& g, const MatrixXd& A, const VectorXd& b,
                              double least) {
  const double size = W.cwiseAbs().maxCoeff(), some = kLeastRelative * size;
  QuadraticFunction out{W, g};
  if (isConvex(W, some)) return out;
  const MatrixXd Z = nullSpace(A);
  MatrixXd left = out.H;  // curvature across the constraints after minimization along them
  if (Z.cols() > 0) {
    const Eigen::SelfAdjointEigenSolver<MatrixXd> principal(Z.transpose() * W * Z);
    VectorXd curvatures = principal.eigenvalues();
    const MatrixXd along = Z * principal.eigenvectors();
    if (!(curvatures[0] > some)) {  // negative curvature along the constraints
      curvatures = curvatures.cwiseAbs().cwiseMax(std::max(some, least));
      out.H += along * (curvatures - principal.eigenvalues()).asDiagonal() * along.transpose();
    }
    const MatrixXd mixed = out.H * along;
    left = out.H - mixed * curvatures.cwiseInverse().asDiagonal() * mixed.transpose();
  }
  if (A.rows() == 0) return out;
  const double lowest = Eigen::SelfAdjointEigenSolver<MatrixXd>(left, Eigen::EigenvaluesOnly).eigenvalues()[0],
               weight = kRowWeight * std::max(size, least) + 2. * std::max(0., -lowest);
  out.H += weight * (MatrixXd::Identity(W.rows(), W.cols()) - Z * Z.transpose());
  out.g += weight * A.completeOrthogonalDecomposition().solve(b);
  return out;
}

void appendRow(MatrixXd& rows, const Eigen::RowVectorXd& row) {
  rows.conservativeResize(rows.rows() + 1, row.size());
  rows.bottomRows(1) = row;
}

MatrixXd nullSpace(const MatrixXd& rows) {
  const Eigen::Index n = rows.cols();
  if (rows.rows() == 0) return MatrixXd::Identity(n, n);
  Eigen::ColPivHouseholderQR<MatrixXd> factor(rows.transpose());
  factor.setThreshold(1e-10);
  const MatrixXd Q = factor.householderQ();
  return Q.rightCols(n - factor.rank());
}

std::optional<VectorXd> negativeCurvature(const MatrixXd& W, Restriction rows, double least) {
  for (Eigen::Index pass = 0; pass <= rows.tight.rows(); ++pass) {
    const MatrixXd Z = nullSpace(rows.fixed);
    if (Z.cols() == 0) return std::nullopt;
    const Eigen::SelfAdjointEigenSolver<MatrixXd> principal(Z.transpose() * W * Z);
    std::vector<Eigen::Index> fewest;
    for (Eigen::Index k = 0; k < Z.cols() && principal.eigenvalues()[k] < -least; ++k) {
      for (const double sign : {1., -1.}) {
        const VectorXd d = (sign * Z * principal.eigenvectors().col(k)).normalized();
        std::vector<Eigen::Index> blocking = blockingRows(rows.tight, d);
        if (blocking.empty()) return d;
        if (fewest.empty() || blocking.size() < fewest.size()) fewest = std::move(blocking);
      }
    }
    if (fewest.empty()) return std::nullopt;
    for (const Eigen::Index j : fewest) appendRow(rows.fixed, rows.tight.row(j));
  }
  return std::nullopt;
}

}  // namespace kinegraph::inline solvers_internal
