#include "kinegraph/perception/pose_certainty.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>

namespace kinegraph::inline perception_internal {

namespace {

constexpr double kInlier = .006;        // m, farther points are not of this thing
constexpr double kPixelsOfNoise = 50.;  // pixels with a common error, from the windows of a stereo match
constexpr double kPixelsOfPoint = 4.;   // an observed view has half the resolution
constexpr double kPriorPosition = .05, kPriorRotation = .5;  // m, rad, where the images say nothing
constexpr double kTestAngle = .1745;                         // rad
constexpr double kChange = .003, kChangeOfRadius = .04;      // m, and relative to the radius of the shape
constexpr double kFewPixels = 50., kFewOfAll = .05;
constexpr double kAnyAngle = 1.81;  // rad, standard deviation of a uniform angle

Vector3d middleOf(const std::vector<Vector3d>& points) {
  Vector3d middle = Vector3d::Zero();
  for (const Vector3d& point : points) middle += point / double(points.size());
  return middle;
}

/// The main axes of the shape in the world; the vertical comes first if the thing rests.
std::vector<Vector3d> testedAxes(const VisibleShape& shape, const PoseFreedom& freedom, const RigidTransform& X) {
  const Vector3d middle = middleOf(shape.samples());
  Matrix3d scatter = Matrix3d::Zero();
  for (const Vector3d& point : shape.samples()) scatter += (point - middle) * (point - middle).transpose();
  const Matrix3d main = X.R * Eigen::SelfAdjointEigenSolver<Matrix3d>(scatter).eigenvectors();
  std::vector<Vector3d> axes;
  if (freedom.kind == PoseFreedom::Kind::resting) axes.push_back(Vector3d::UnitZ());
  for (int i = 0; i < 3; ++i) {
    const bool is_new = std::none_of(axes.begin(), axes.end(),
                                     [&](const Vector3d& axis) { return std::abs(axis.dot(main.col(i))) > .94; });
    if (is_new) axes.push_back(main.col(i));
  }
  return axes;
}

}  // namespace

PoseCertainty poseCertainty(const VisibleShape& shape, const PoseFreedom& freedom,
                            const std::vector<ObservedPoint>& points, int thinning,
                            const std::vector<ObservedView>& views, const RigidTransform& X) {
  const auto eyesAt = [&](const RigidTransform& at) {
    std::vector<EyeInParts> eyes;
    for (const ObservedView& view : views) eyes.push_back(shape.eyeInParts(at.R.transpose() * (view.X_WC.p - at.p)));
    return eyes;
  };
  const auto distanceAt = [&](const RigidTransform& at, const std::vector<EyeInParts>& eyes,
                              const ObservedPoint& point) {
    return shape.facing(at.R.transpose() * (point.p - at.p), eyes[std::size_t(point.view)]);
  };
  const std::vector<EyeInParts> eyes = eyesAt(X);
  Matrix6d H = Matrix6d::Zero();
  std::vector<Vector6d> pulls(views.size(), Vector6d::Zero());  // of an error common to the pixels of a view
  std::vector<const ObservedPoint*> inliers;
  std::vector<double> distances;
  double residuals = 0.;
  for (const ObservedPoint& point : points) {
    const SurfaceDistance near = distanceAt(X, eyes, point);
    if (!(std::abs(near.distance) < std::max(kInlier, 3. * point.sigma))) continue;
    inliers.push_back(&point);
    distances.push_back(near.distance);
    const Vector3d normal = X.R * near.gradient;
    Vector6d J;
    J << -normal, -(point.p - X.p).cross(normal);
    const double weight = 1. / (point.sigma * point.sigma);
    H += weight * J * J.transpose();
    residuals += weight * near.distance * near.distance;
    const ObservedView& view = views[std::size_t(point.view)];
    const Vector3d ray = (point.p - view.X_WC.p).normalized();
    pulls[std::size_t(point.view)] += weight * normal.dot(ray) * point.sigma * view.bias / view.noise * J;
  }
  const double count = double(std::max<std::size_t>(inliers.size(), 1));
  const double shared = std::max(1., kPixelsOfNoise / (kPixelsOfPoint * thinning));
  const double scale = shared * std::max(1., residuals / count);
  const Eigen::Matrix<double, 6, Eigen::Dynamic> B = freedom.basis();
  MatrixXd information = B.transpose() * H * B;
  MatrixXd with_prior = information / scale;
  for (int i = 0; i < B.cols(); ++i) {
    with_prior(i, i) += B.col(i).head<3>().squaredNorm() / (kPriorPosition * kPriorPosition) +
                        B.col(i).tail<3>().squaredNorm() / (kPriorRotation * kPriorRotation);
  }
  const MatrixXd inverse = with_prior.inverse();
  MatrixXd covariance = inverse;
  for (const Vector6d& pull : pulls) {
    const VectorXd shift = inverse * (B.transpose() * pull) / scale;
    covariance += shift * shift.transpose();
  }
  PoseCertainty certainty{B * covariance * B.transpose(), MatrixXd::Zero(0, 6)};
  if (freedom.hasJoint()) return certainty;
  const double change = std::clamp(kChangeOfRadius * shape.radius(), .0012, kChange);
  const double few = std::min(kFewPixels, kFewOfAll * kPixelsOfPoint * thinning * count);
  const Vector3d center = X.p + X.R * middleOf(shape.samples());
  for (const Vector3d& axis : testedAxes(shape, freedom, X)) {
    double changed = 0.;
    for (const double angle : {-kTestAngle, kTestAngle}) {
      const Matrix3d R = Eigen::AngleAxisd(angle, axis).toRotationMatrix();
      const RigidTransform turned{R * X.R, center + R * (X.p - center)};
      const std::vector<EyeInParts> turned_eyes = eyesAt(turned);
      double pixels = 0.;
      for (std::size_t i = 0; i < inliers.size(); ++i) {
        if (std::abs(distanceAt(turned, turned_eyes, *inliers[i]).distance - distances[i]) > change)
          pixels += kPixelsOfPoint * thinning;
      }
      changed = std::max(changed, pixels);
    }
    if (changed >= few) continue;
    Vector6d direction;
    direction << axis.cross(X.p - center), axis;
    MatrixXd& rows = certainty.free_directions;
    rows.conservativeResize(rows.rows() + 1, 6);
    rows.row(rows.rows() - 1) = direction.normalized().transpose();
    certainty.covariance += kAnyAngle * kAnyAngle * direction * direction.transpose();
  }
  return certainty;
}

}  // namespace kinegraph::inline perception_internal
