#include "kinegraph/perception/marker_poses.h"

#include <Eigen/Dense>
#include <cmath>

namespace kinegraph::inline perception_internal {

namespace {

Matrix3d nearestRotation(const Matrix3d& A) {
  const Eigen::JacobiSVD<Matrix3d> svd(A, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Matrix3d D = Matrix3d::Identity();
  D(2, 2) = (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0. ? -1. : 1.;
  return svd.matrixU() * D * svd.matrixV().transpose();
}

}  // namespace

std::optional<RigidTransform> markerInCamera(const MatrixXd& points, const MatrixXd& pixels, const Vector4d& fxycxy) {
  std::vector<Eigen::Index> seen;
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    if (pixels.row(i).allFinite()) seen.push_back(i);
  }
  if (seen.size() < 4) return std::nullopt;
  const double scale = 1. / std::max(points.cwiseAbs().maxCoeff(), 1e-9);
  MatrixXd A(2 * Eigen::Index(seen.size()), 9);
  for (std::size_t n = 0; n < seen.size(); ++n) {
    const Vector3d p(scale * points(seen[n], 0), scale * points(seen[n], 1), 1.);
    const double u = (pixels(seen[n], 0) - fxycxy[2]) / fxycxy[0], v = (pixels(seen[n], 1) - fxycxy[3]) / fxycxy[1];
    A.row(2 * Eigen::Index(n)) << p.transpose(), 0., 0., 0., -u * p.transpose();
    A.row(2 * Eigen::Index(n) + 1) << 0., 0., 0., p.transpose(), -v * p.transpose();
  }
  const Eigen::JacobiSVD<MatrixXd> svd(A, Eigen::ComputeFullV);
  if (svd.singularValues()[7] < 1e-9 * svd.singularValues()[0]) return std::nullopt;
  const VectorXd h = svd.matrixV().col(8);
  Vector3d x(h[0], h[3], h[6]), y(h[1], h[4], h[7]), p(h[2], h[5], h[8]);
  double factor = std::sqrt(x.norm() * y.norm());
  if (factor < 1e-12) return std::nullopt;
  if (p.z() < 0.) factor = -factor;  // in front of the camera
  x /= factor;
  y /= factor;
  Matrix3d R;
  R << x, y, x.cross(y);
  return RigidTransform{nearestRotation(R), p / (factor * scale)};
}

std::optional<LinearCalibration> linearCalibration(const std::vector<RigidTransform>& arms,
                                                   const MarkerImages& images) {
  if (images.points.col(2).cwiseAbs().maxCoeff() > 1e-6) return std::nullopt;
  std::vector<std::pair<RigidTransform, RigidTransform>> pairs;  // A_k, B_k
  for (std::size_t k = 0; k < arms.size(); ++k) {
    const auto B = markerInCamera(images.points, images.pixels[k], images.fxycxy);
    if (B) pairs.emplace_back(arms[k], *B);
  }
  if (pairs.size() < 3) return std::nullopt;
  // vec(R_A R_X R_B) = (R_B^T x R_A) vec(R_X) = vec(R_M)
  MatrixXd rows(9 * Eigen::Index(pairs.size()), 18);
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const Matrix3d &A = pairs[k].first.R, &B = pairs[k].second.R;
    for (Eigen::Index i = 0; i < 3; ++i) {
      for (Eigen::Index j = 0; j < 3; ++j) rows.block<3, 3>(9 * Eigen::Index(k) + 3 * i, 3 * j) = B(j, i) * A;
    }
    rows.block<9, 9>(9 * Eigen::Index(k), 9) = -Eigen::Matrix<double, 9, 9>::Identity();
  }
  const VectorXd solution = Eigen::JacobiSVD<MatrixXd>(rows, Eigen::ComputeFullV).matrixV().col(17);
  Matrix3d R_X = Eigen::Map<const Matrix3d>(solution.data()), R_M = Eigen::Map<const Matrix3d>(solution.data() + 9);
  const double sign = R_X.determinant() < 0. ? -1. : 1.;
  LinearCalibration result{{nearestRotation(sign * R_X), {}}, {nearestRotation(sign * R_M), {}}};
  // R_A t_X - t_M = -t_A - R_A R_X t_B
  MatrixXd T(3 * Eigen::Index(pairs.size()), 6);
  VectorXd b(T.rows());
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const auto& [A, B] = pairs[k];
    T.middleRows<3>(3 * Eigen::Index(k)) << A.R, -Matrix3d::Identity();
    b.segment<3>(3 * Eigen::Index(k)) = -A.p - A.R * (result.camera.R * B.p);
  }
  const VectorXd t = T.completeOrthogonalDecomposition().solve(b);
  result.camera.p = t.head<3>();
  result.marker.p = t.tail<3>();
  return result;
}

}  // namespace kinegraph::inline perception_internal
