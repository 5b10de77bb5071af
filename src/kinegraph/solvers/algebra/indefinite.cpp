#include "kinegraph/solvers/algebra/indefinite.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <algorithm>
#include <vector>

namespace kinegraph {

namespace {

constexpr double kLeastRelative = 1e-8;  ///< curvature that counts as some, as a part of the largest entry
constexpr double kRowWeight = 10.;       ///< of |A d + b|^2, in units of the largest entry of W
constexpr double kAdmitted = 1e-9;       ///< of a^T d, for rows of length 1

bool isConvex(const MatrixXd& W, double least) {
  MatrixXd shifted = W;
  shifted.diagonal().array() -= least;
  return Eigen::LLT<MatrixXd>(shifted).info() == Eigen::Success;
}

std::vector<Eigen::Index> rowsInTheWay(const MatrixXd& rows, const VectorXd& d) {
  std::vector<Eigen::Index> found;
  for (Eigen::Index j = 0; j < rows.rows(); ++j) {
    if (rows.row(j).dot(d) > kAdmitted) found.push_back(j);
  }
  return found;
}

}  // namespace

QuadraticFunction convexified(const MatrixXd& W, const VectorXd& g, const MatrixXd& A, const VectorXd& b,
                              double least) {
  const double size = W.cwiseAbs().maxCoeff();
  QuadraticFunction out{W, g};
  if (isConvex(W, kLeastRelative * size)) return out;
  const double weight = kRowWeight * std::max(size, least);
  out.H.noalias() += weight * A.transpose() * A;
  out.g.noalias() += weight * A.transpose() * b;
  if (A.rows() > 0 && isConvex(out.H, kLeastRelative * size)) return out;
  const Eigen::SelfAdjointEigenSolver<MatrixXd> principal(out.H);
  const VectorXd curvatures = principal.eigenvalues().cwiseMax(std::max(kLeastRelative * size, least));
  out.H = principal.eigenvectors() * curvatures.asDiagonal() * principal.eigenvectors().transpose();
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
  for (Eigen::Index pass = 0; pass <= rows.touched.rows(); ++pass) {
    const MatrixXd Z = nullSpace(rows.held);
    if (Z.cols() == 0) return std::nullopt;
    const Eigen::SelfAdjointEigenSolver<MatrixXd> principal(Z.transpose() * W * Z);
    std::vector<Eigen::Index> fewest;
    for (Eigen::Index k = 0; k < Z.cols() && principal.eigenvalues()[k] < -least; ++k) {
      for (const double sign : {1., -1.}) {
        const VectorXd d = (sign * Z * principal.eigenvectors().col(k)).normalized();
        std::vector<Eigen::Index> in_the_way = rowsInTheWay(rows.touched, d);
        if (in_the_way.empty()) return d;
        if (fewest.empty() || in_the_way.size() < fewest.size()) fewest = std::move(in_the_way);
      }
    }
    if (fewest.empty()) return std::nullopt;
    for (const Eigen::Index j : fewest) appendRow(rows.held, rows.touched.row(j));
  }
  return std::nullopt;
}

}  // namespace kinegraph
