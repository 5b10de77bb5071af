#include "kinegraph/perception/calibrate_camera.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/kinematics/state.h"
#include "kinegraph/perception/marker_poses.h"

namespace kinegraph {

namespace {

using Vector12d = Eigen::Matrix<double, 12, 1>;
using Matrix12d = Eigen::Matrix<double, 12, 12>;

constexpr double kRadianDegrees = 57.29577951308232;
constexpr double kArm = .3;                  // m, by which rotations are compared with translations
constexpr double kUndetermined = .03;        // m
constexpr double kBadFit = 9.;               // squared error over that of the noise
constexpr double kPosition = .005;           // m, standard deviation that warns
constexpr double kRotation = 1. / 57.29578;  // rad

/// The pose relative to the parent, or in the world without one.
Pose placeOf(const Frame& frame) { return frame.getParent() ? frame.getRelativePose() : frame.getPose(); }

void place(Frame& frame, const Pose& pose) {
  if (frame.getParent()) {
    frame.setRelativePose(pose);
  } else {
    frame.setPose(pose);
  }
}

RigidTransform displaced(const RigidTransform& X, const Eigen::Ref<const Vector6d>& by) {
  const Vector3d w = by.tail<3>();
  const double angle = w.norm();
  const Matrix3d R = angle > 0. ? Eigen::AngleAxisd(angle, w / angle).toRotationMatrix() : Matrix3d::Identity();
  return {R * X.R, X.p + by.head<3>()};
}

/// The pixels of the points as functions of the two poses.
class MarkerProblem {
 public:
  MarkerProblem(const Config& config, const Frame& camera, const Frame& marker, const MarkerImages& images,
                const CalibrateOptions& options)
      : images_(images), options_(options), state_(config.state()) {
    camera_parent_ = camera.getParent() ? camera.getParent()->id() : -1;
    marker_parent_ = marker.getParent() ? marker.getParent()->id() : -1;
    for (Eigen::Index k = 0; k < images.q.rows(); ++k) arms_.push_back(armAt(images.q.row(k)));
  }

  const std::vector<RigidTransform>& arms() const { return arms_; }
  bool moves() const {
    return std::any_of(arms_.begin(), arms_.end(), [&](const RigidTransform& A) {
      return (A.p - arms_[0].p).norm() > 1e-6 || (A.R - arms_[0].R).norm() > 1e-6;
    });
  }

  /// Weights the errors of an image by its pixel and joint noise.
  void weigh(const RigidTransform& X, const RigidTransform& M) {
    whitening_.clear();
    constexpr double kStep = 1e-6;
    for (Eigen::Index k = 0; k < images_.q.rows(); ++k) {
      const VectorXd at = project(arms_[std::size_t(k)], X, M, k), q = images_.q.row(k);
      MatrixXd J(at.size(), q.size());
      for (Eigen::Index j = 0; j < q.size(); ++j) {
        VectorXd moved = q;
        moved[j] += kStep;
        J.col(j) = (project(armAt(moved), X, M, k) - at) / kStep;
      }
      const double pixel = options_.pixel_noise * options_.pixel_noise,
                   joint = options_.joint_noise * options_.joint_noise;
      const MatrixXd S = pixel * MatrixXd::Identity(at.size(), at.size()) + joint * (J * J.transpose());
      whitening_.push_back(S.llt().matrixL().solve(MatrixXd::Identity(at.size(), at.size())));
    }
  }

  /// Weighted errors of all images.
  VectorXd errors(const RigidTransform& X, const RigidTransform& M) const {
    std::vector<double> all;
    for (Eigen::Index k = 0; k < images_.q.rows(); ++k) {
      const VectorXd e = whitening_[std::size_t(k)] * (project(arms_[std::size_t(k)], X, M, k) - measured(k));
      all.insert(all.end(), e.begin(), e.end());
    }
    return Eigen::Map<const VectorXd>(all.data(), Eigen::Index(all.size()));
  }

  /// Root mean square distance in one image, pixels.
  double pixelError(const RigidTransform& X, const RigidTransform& M, Eigen::Index k) const {
    const VectorXd e = project(arms_[std::size_t(k)], X, M, k) - measured(k);
    return e.size() > 0 ? std::sqrt(2. * e.squaredNorm() / double(e.size())) : 0.;
  }

 private:
  RigidTransform armAt(const VectorXd& q) {
    state_.setJoints(q.data());
    const RigidTransform camera = camera_parent_ >= 0 ? state_.pose(camera_parent_) : RigidTransform{},
                         marker = marker_parent_ >= 0 ? state_.pose(marker_parent_) : RigidTransform{};
    return marker.inverse() * camera;
  }

  bool isSeen(Eigen::Index k, Eigen::Index i) const { return images_.pixels[std::size_t(k)].row(i).allFinite(); }

  VectorXd project(const RigidTransform& A, const RigidTransform& X, const RigidTransform& M, Eigen::Index k) const {
    const RigidTransform X_CM = (A * X).inverse() * M;
    std::vector<double> pixels;
    for (Eigen::Index i = 0; i < images_.points.rows(); ++i) {
      if (!isSeen(k, i)) continue;
      const Vector3d p = X_CM * Vector3d(images_.points.row(i).transpose());
      const double z = std::max(p.z(), 1e-3);  // behind the camera: a large error
      pixels.push_back(images_.fxycxy[0] * p.x() / z + images_.fxycxy[2]);
      pixels.push_back(images_.fxycxy[1] * p.y() / z + images_.fxycxy[3]);
    }
    return Eigen::Map<const VectorXd>(pixels.data(), Eigen::Index(pixels.size()));
  }

  VectorXd measured(Eigen::Index k) const {
    std::vector<double> pixels;
    for (Eigen::Index i = 0; i < images_.points.rows(); ++i) {
      if (!isSeen(k, i)) continue;
      for (const int axis : {0, 1}) pixels.push_back(images_.pixels[std::size_t(k)](i, axis));
    }
    return Eigen::Map<const VectorXd>(pixels.data(), Eigen::Index(pixels.size()));
  }

  const MarkerImages& images_;
  const CalibrateOptions& options_;
  State state_;
  int camera_parent_, marker_parent_;
  std::vector<RigidTransform> arms_;  ///< A_k
  std::vector<MatrixXd> whitening_;
};

/// The poses of camera and marker, and the information about their displacements.
struct Fit {
  RigidTransform X, M;
  Matrix12d information = Matrix12d::Zero();
  double error = 0.;  ///< squared, per degree of freedom
};

/// Minimizes the weighted errors by damped Gauss-Newton steps.
Fit minimize(MarkerProblem& problem, const RigidTransform& X, const RigidTransform& M) {
  Fit fit{X, M};
  const auto moved = [&](const Vector12d& by) {
    return std::pair(displaced(fit.X, by.head<6>()), displaced(fit.M, by.tail<6>()));
  };
  for (int round = 0; round < 3; ++round) {
    problem.weigh(fit.X, fit.M);
    VectorXd e = problem.errors(fit.X, fit.M);
    double damping = 1e-3;
    for (int step = 0; step < 60 && damping < 1e8; ++step) {
      MatrixXd J(e.size(), 12);
      constexpr double kStep = 1e-6;
      for (int j = 0; j < 12; ++j) {
        const auto [above_X, above_M] = moved(kStep * Vector12d::Unit(j));
        const auto [below_X, below_M] = moved(-kStep * Vector12d::Unit(j));
        J.col(j) = (problem.errors(above_X, above_M) - problem.errors(below_X, below_M)) / (2. * kStep);
      }
      fit.information = J.transpose() * J;
      const Vector12d gradient = J.transpose() * e;
      Matrix12d H = fit.information;
      H.diagonal() += damping * fit.information.diagonal() + Vector12d::Constant(1e-9);
      const Vector12d by = -H.ldlt().solve(gradient);
      const auto [next_X, next_M] = moved(by);
      const VectorXd next = problem.errors(next_X, next_M);
      if (!(next.squaredNorm() < e.squaredNorm())) {
        damping *= 10.;
        if (by.norm() < 1e-10) break;
        continue;
      }
      const bool done = e.squaredNorm() - next.squaredNorm() < 1e-10 * (1. + e.squaredNorm());
      fit.X = next_X;
      fit.M = next_M;
      e = next;
      damping = std::max(.2 * damping, 1e-9);
      if (done) break;
    }
    fit.error = e.squaredNorm() / double(std::max<Eigen::Index>(e.size() - 12, 1));
  }
  return fit;
}

/// Fills the covariances and the directions that the images do not determine.
void addCertainty(const Fit& fit, CameraCalibration& result) {
  Vector12d scale;
  scale << Vector6d::Ones(), Vector6d::Ones();
  for (const int i : {3, 4, 5, 9, 10, 11}) scale[i] = 1. / kArm;
  const Matrix12d scaled = scale.asDiagonal() * fit.information * scale.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Matrix12d> eigen(scaled);
  const double enlarged = std::max(fit.error, 1.), least = 1. / (10. * 10.);
  Vector12d variance;
  std::vector<Vector12d> free;
  for (int i = 0; i < 12; ++i) {
    variance[i] = enlarged / std::max(eigen.eigenvalues()[i], least);
    if (std::sqrt(variance[i] / enlarged) > kUndetermined)
      free.push_back((scale.asDiagonal() * eigen.eigenvectors().col(i)).normalized());
  }
  const Matrix12d covariance = scale.asDiagonal() *
                               (eigen.eigenvectors() * variance.asDiagonal() * eigen.eigenvectors().transpose()) *
                               scale.asDiagonal();
  result.covariance = covariance.topLeftCorner<6, 6>();
  result.marker_covariance = covariance.bottomRightCorner<6, 6>();
  result.free_directions.resize(Eigen::Index(free.size()), 12);
  for (std::size_t i = 0; i < free.size(); ++i) result.free_directions.row(Eigen::Index(i)) = free[i].transpose();
}

void warn(const MarkerProblem& problem, const Fit& fit, const MarkerImages& images, const CalibrateOptions& options,
          CameraCalibration& result) {
  double sum = 0., worst = 0.;
  Eigen::Index worst_image = 0;
  for (Eigen::Index k = 0; k < images.q.rows(); ++k) {
    const double error = problem.pixelError(fit.X, fit.M, k);
    sum += error * error;
    if (error > worst) worst = error, worst_image = k;
  }
  result.pixel_error = std::sqrt(sum / double(images.q.rows()));
  const double position = std::sqrt(result.covariance.diagonal().head<3>().maxCoeff()),
               rotation = std::sqrt(result.covariance.diagonal().tail<3>().maxCoeff());
  if (fit.error > kBadFit) {
    result.warnings.push_back(
        cat("the points fit ", std::sqrt(fit.error), " times worse than pixel_noise (", options.pixel_noise,
            " pixels) and joint_noise (", options.joint_noise, ") allow, the worst in image ", worst_image, " (", worst,
            " pixels): check the order and the unit of the points, fxycxy, and the joint angles"));
  } else if (result.free_directions.rows() > 0) {
    result.warnings.push_back(cat("the images do not determine ", result.free_directions.rows(),
                                  " directions (free_directions): turn the hand about two axes that are not parallel, "
                                  "by 30 degrees and more"));
  } else if (position > kPosition || rotation > kRotation) {
    result.warnings.push_back(cat("the images determine the camera only to ", 1e3 * position, " mm and ",
                                  kRadianDegrees * rotation,
                                  " degrees (standard deviation): add images, with larger rotations of the hand"));
  }
}

void validate(const Config& config, const MarkerImages& images) {
  const auto fail = [](const std::string& text) { throw ValueError("calibrateCamera: " + text); };
  const Eigen::Index n = images.points.rows(), count = images.q.rows(), dofs = config.getJointDimension();
  if (images.points.cols() != 3 || n < 4 || !images.points.allFinite())
    fail(cat("points have shape (", n, ", ", images.points.cols(), "); expected (n, 3) finite numbers, n >= 4"));
  if (images.points.cwiseAbs().maxCoeff() > 5.)
    fail(cat("a point is ", images.points.cwiseAbs().maxCoeff(), " m away from its frame; lengths are in meters"));
  if (!images.fxycxy.allFinite() || images.fxycxy[0] <= 0. || images.fxycxy[1] <= 0.)
    fail("fxycxy has invalid focal lengths; expected fx fy cx cy in pixels, fx and fy > 0");
  if (images.q.cols() != dofs || !images.q.allFinite())
    fail(cat("q has shape (", count, ", ", images.q.cols(), "); expected finite joint angles, (K, ", dofs, ")"));
  if (count < 3) fail(cat(count, " images; expected at least 3, better 10"));
  if (Eigen::Index(images.pixels.size()) != count)
    fail(cat("pixels of ", images.pixels.size(), " images, and ", count, " configurations; expected one each"));
  for (std::size_t k = 0; k < images.pixels.size(); ++k) {
    if (images.pixels[k].rows() != n || images.pixels[k].cols() != 2)
      fail(cat("the pixels of image ", k, " have shape (", images.pixels[k].rows(), ", ", images.pixels[k].cols(),
               "); expected (", n, ", 2)"));
  }
}

}  // namespace

void CalibrateOptions::validate() const {
  if (!(pixel_noise > 0.) || !std::isfinite(pixel_noise) || !(joint_noise >= 0.) || !std::isfinite(joint_noise))
    throw ValueError(cat("calibrateCamera: pixel_noise is ", pixel_noise, " and joint_noise ", joint_noise,
                         "; expected pixel_noise > 0 in pixels and joint_noise >= 0 in rad"));
}

std::string CameraCalibration::str() const {
  std::string text = cat("camera at ", camera.p.x(), " ", camera.p.y(), " ", camera.p.z(), " within ",
                         1e3 * std::sqrt(covariance.diagonal().head<3>().sum()), " mm and ",
                         kRadianDegrees * std::sqrt(covariance.diagonal().tail<3>().sum()), " degrees, points within ",
                         pixel_error, " pixels");
  for (const std::string& warning : warnings) text += cat("\nwarning: ", warning);
  return text;
}

CameraCalibration calibrateCamera(Config& config, const std::string& camera, const std::string& marker,
                                  const MarkerImages& images, const CalibrateOptions& options) {
  options.validate();
  validate(config, images);
  Frame camera_frame = config.getFrame(camera), marker_frame = config.getFrame(marker);
  MarkerProblem problem(config, camera_frame, marker_frame, images, options);
  if (!problem.moves())
    throw ValueError(cat("calibrateCamera: the configurations do not move camera '", camera, "' relative to marker '",
                         marker, "'; one of them must be attached to the robot, the other one not"));
  Fit start{placeOf(camera_frame).transform(), placeOf(marker_frame).transform()};
  if (const auto linear = linearCalibration(problem.arms(), images)) start = {linear->camera, linear->marker};
  const Fit fit = minimize(problem, start.X, start.M);
  CameraCalibration result;
  result.camera = Pose(fit.X);
  result.marker = Pose(fit.M);
  addCertainty(fit, result);
  warn(problem, fit, images, options, result);
  place(camera_frame, result.camera);
  place(marker_frame, result.marker);
  return result;
}

}  // namespace kinegraph
