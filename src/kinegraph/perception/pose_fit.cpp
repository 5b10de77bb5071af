#include "kinegraph/perception/pose_fit.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>

namespace kinegraph::inline perception_internal {

namespace {

constexpr double kLongestStep = .02, kLargestRotation = .35;  // m, rad
constexpr double kDamping = 1e-3;
constexpr double kWidthOfNoise = 1.2;   // least width of a robust weight, in standard deviations
constexpr double kSureDeviations = 3.;  // standard deviations for agreement
constexpr double kKeepOutSigma = .002;  // m, standard deviation of an overlap of two things
constexpr double kAgreement = .006;     // m, between surface and depth in counts
constexpr double kGrazing = .1;         // cosine of the viewing angle from which a surface can be measured
constexpr double kHandWidth = .8, kPointsOfUnitWeight = 700.;  // distance (m), points at which a looked-through pixel
                                                               // weighs as one pixel

using Pixel = ObservedView::Pixel;

/// A point of the surface as a camera sees it.
struct Projection {
  enum class Is { turned_away, outside, none, hidden, agrees, through };
  Is is = Is::turned_away;
  double u = 0., v = 0.;  ///< pixels
  Vector3d c;             ///< in the camera
  std::size_t pixel = 0;
};

Projection project(const ObservedView& view, const Vector3d& p, const Vector3d& normal, double tolerance) {
  Projection out;
  const Vector3d ray = p - view.X_WC.p;
  const double cosine = -normal.dot(ray) / ray.norm();
  if (cosine < kGrazing) return out;
  out.c = view.X_WC.R.transpose() * ray;
  out.is = Projection::Is::outside;
  if (out.c.z() < .05) return out;
  out.u = view.fx * out.c.x() / out.c.z() + view.cx;
  out.v = view.fy * out.c.y() / out.c.z() + view.cy;
  const int row = int(std::floor(out.v + .25)), column = int(std::floor(out.u + .25));  // centers lie at .25
  if (row < 0 || column < 0 || row >= view.height || column >= view.width) return out;
  out.pixel = view.index(row, column);
  const double z = view.depth[out.pixel];
  tolerance = std::max(tolerance, kSureDeviations * view.noise * out.c.z() * out.c.z());
  tolerance += .7 * out.c.z() / view.fx * std::sqrt(1. - cosine * cosine) / cosine;  // of the depth within a pixel
  out.is = z <= 0.                     ? Projection::Is::none
           : z < out.c.z() - tolerance ? Projection::Is::hidden
           : z < out.c.z() + tolerance ? Projection::Is::agrees
                                       : Projection::Is::through;
  return out;
}

using FreedomBasis = Eigen::Matrix<double, 6, Eigen::Dynamic, Eigen::ColMajor, 6, 6>;
using FreedomVector = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, 6, 1>;
using FreedomMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, 6, 6>;

/// J^T W J and J^T W r of rows, for displacements along a basis.
struct NormalEquations {
  explicit NormalEquations(const FreedomBasis& basis)
      : B(basis), A(FreedomMatrix::Zero(B.cols(), B.cols())), g(FreedomVector::Zero(B.cols())) {}

  FreedomBasis B;
  FreedomMatrix A;  ///< its lower triangle
  FreedomVector g;

  /// A residual that falls by `direction` per displacement of a point at `arm` from the origin.
  void add(const Vector3d& direction, const Vector3d& arm, double residual, double weight) {
    Vector6d of_pose;
    of_pose << direction, arm.cross(direction);
    const FreedomVector J = B.transpose() * of_pose;
    for (Eigen::Index i = 0; i < J.size(); ++i) {
      for (Eigen::Index k = 0; k <= i; ++k) A(i, k) += weight * J[i] * J[k];
    }
    g += weight * residual * J;
  }
};

double robustWeight(double residual, double width) {
  const double ratio = residual / width, spread = 1. + ratio * ratio;
  return 1. / (spread * spread);
}

void addPoints(const VisibleShape& shape, const FitPoints& points, const std::vector<ObservedView>& views,
               const RigidTransform& X, double width, NormalEquations& sum) {
  const double reach = std::max(4. * width, .012);
  std::vector<EyeInParts> eyes;
  for (const ObservedView& view : views) eyes.push_back(shape.eyeInParts(X.R.transpose() * (view.X_WC.p - X.p)));
  for (const ObservedPoint& point : points.measured) {
    const Vector3d arm = point.p - X.p, local = X.R.transpose() * arm;
    if (local.norm() > shape.radius() + reach) continue;
    const SurfaceDistance near = shape.facing(local, eyes[std::size_t(point.view)]);
    if (!(std::abs(near.distance) < std::max(reach, kSureDeviations * point.sigma))) continue;
    const double weight =
        robustWeight(near.distance, std::max(width, kWidthOfNoise * point.sigma)) / (point.sigma * point.sigma);
    sum.add(-(X.R * near.gradient), arm, near.distance, weight);
  }
  for (const Vector3d& point : points.keep_out) {
    const Vector3d arm = point - X.p, local = X.R.transpose() * arm;
    if (local.norm() > shape.radius()) continue;
    const SurfaceDistance near = shape.nearest(local);
    if (near.distance < 0.) sum.add(-(X.R * near.gradient), arm, near.distance, 1. / (kKeepOutSigma * kKeepOutSigma));
  }
}

void addLookedThrough(const VisibleShape& shape, const ObservedView& view, const RigidTransform& X, double width,
                      int samples, double points, NormalEquations& sum) {
  const double tolerance = std::max(.008, 2. * width), cap = std::max(.01, 2. * width);
  for (int i = 0; i < samples; ++i) {
    const Vector3d arm = X.R * shape.samples()[std::size_t(i)];
    const Projection seen = project(view, X.p + arm, X.R * shape.normals()[std::size_t(i)], tolerance);
    if (seen.is != Projection::Is::through) continue;
    const std::int32_t target = view.nearest[seen.pixel];
    if (target < 0) continue;
    Eigen::Vector2d away(seen.u - (target % view.width + .25), seen.v - (target / view.width + .25));
    const double pixels = away.norm();
    if (pixels < .5) continue;
    away /= pixels;
    const double meters = (pixels - .5) * seen.c.z() / view.fx;
    const double weight = std::pow(view.fx / kHandWidth, 2) * points / kPointsOfUnitWeight * robustWeight(meters, cap);
    const Vector3d direction(away.x(), away.y(), -(seen.c.x() * away.x() + seen.c.y() * away.y()) / seen.c.z());
    sum.add(view.X_WC.R * direction, arm, meters, weight);
  }
}

}  // namespace

Eigen::Matrix<double, 6, Eigen::Dynamic> PoseFreedom::basis() const {
  if (kind == Kind::free) return Matrix6d::Identity();
  const int columns = kind == Kind::resting ? 3 : 1;
  Eigen::Matrix<double, 6, Eigen::Dynamic> B = Eigen::Matrix<double, 6, Eigen::Dynamic>::Zero(6, columns);
  if (kind == Kind::resting) B(0, 0) = B(1, 1) = B(5, 2) = 1.;
  if (kind == Kind::sliding) B.col(0).head<3>() = axis;
  if (kind == Kind::turning) B.col(0).tail<3>() = axis;
  return B;
}

RigidTransform PoseFreedom::moved(const RigidTransform& X, const Vector6d& displacement) const {
  RigidTransform out = X;
  if (kind == Kind::sliding) {
    const double at = std::clamp(axis.dot(X.p - start.p) + axis.dot(displacement.head<3>()), lower, upper);
    out.p = start.p + at * axis;
    return out;
  }
  if (kind == Kind::turning) {
    const Eigen::AngleAxisd so_far(X.R * start.R.transpose());
    const double angle = so_far.angle() * (so_far.axis().dot(axis) < 0. ? -1. : 1.);
    const double at = std::clamp(angle + axis.dot(displacement.tail<3>()), lower, upper);
    out.R = Eigen::AngleAxisd(at, axis).toRotationMatrix() * start.R;
    return out;
  }
  out.p += displacement.head<3>();
  const double angle = displacement.tail<3>().norm();
  if (angle > 1e-12) out.R = Eigen::AngleAxisd(angle, displacement.tail<3>() / angle).toRotationMatrix() * X.R;
  return out;
}

PoseFreedom freedomOf(const Frame& frame, bool may_rest) {
  PoseFreedom freedom;
  freedom.start = frame.getPose().transform();
  const std::optional<Joint>& joint = frame.data().joint;
  if (joint && joint->dofs() == 1 && joint->steps.size() == 1 && joint->steps[0].moves()) {
    const MotionStep& step = joint->steps[0];
    freedom.kind = step.translates() ? PoseFreedom::Kind::sliding : PoseFreedom::Kind::turning;
    const double direction = step.sign * joint->scale;
    freedom.axis = freedom.start.R * step.direction(joint->axis);
    if (joint->lower.size() == 1) {
      const double at = frame.getJointState()[0];
      const double a = direction * (joint->lower[0] - at), b = direction * (joint->upper[0] - at);
      freedom.lower = std::min(a, b);
      freedom.upper = std::max(a, b);
    }
    return freedom;
  }
  const std::optional<Frame> parent = frame.getParent();
  const bool in_hand = parent && isMoved(*parent);
  if (may_rest && !in_hand) freedom.kind = PoseFreedom::Kind::resting;
  return freedom;
}

RigidTransform restingPose(const VisibleShape& shape, const RigidTransform& X, double height) {
  RigidTransform out = X;
  const Vector3d down = -Vector3d::UnitZ();
  const Vector3d* best = nullptr;
  for (const Vector3d& direction : shape.restingDirections()) {
    if (!best || down.dot(X.R * direction) > down.dot(X.R * *best)) best = &direction;
  }
  if (best) out.R = Quaterniond::FromTwoVectors(X.R * *best, down).toRotationMatrix() * X.R;
  out.p.z() = height + shape.extent(out.R.transpose() * down);
  return out;
}

void fitPose(const VisibleShape& shape, const PoseFreedom& freedom, const FitPoints& points,
             const std::vector<ObservedView>& views, const std::vector<double>& widths, int samples,
             RigidTransform& X) {
  const FreedomBasis B = freedom.basis();
  FreedomVector scale(B.cols());
  for (int i = 0; i < B.cols(); ++i)
    scale[i] = B.col(i).head<3>().squaredNorm() + std::pow(shape.radius(), 2) * B.col(i).tail<3>().squaredNorm();
  samples = std::min(samples, int(shape.samples().size()));
  for (const double width : widths) {
    NormalEquations sum(B);
    addPoints(shape, points, views, X, width, sum);
    for (const ObservedView& view : views)
      addLookedThrough(shape, view, X, width, samples, double(points.measured.size()), sum);
    const double mean = (sum.A.diagonal().array() / scale.array()).sum() / double(B.cols());
    sum.A.diagonal() += (kDamping * mean + 1e-6) * scale;
    Vector6d step = -(B * sum.A.ldlt().solve(sum.g));
    step /= std::max({1., step.head<3>().norm() / kLongestStep, step.tail<3>().norm() / kLargestRotation});
    X = freedom.moved(X, step);
  }
}

double SurfaceCounts::score() const { return (agree - 1.5 * through + .05 * (hidden + none)) / std::max(1, inView()); }

SurfaceCounts countSurface(const VisibleShape& shape, const RigidTransform& X, const std::vector<ObservedView>& views,
                           int samples, bool alone) {
  SurfaceCounts counts;
  samples = std::min(samples, int(shape.samples().size()));
  for (const ObservedView& view : views) {
    const Vector3d eye = X.R.transpose() * (view.X_WC.p - X.p);
    for (int i = 0; i < samples; ++i) {
      const Vector3d& local = shape.samples()[std::size_t(i)];
      const Projection seen = project(view, X * local, X.R * shape.normals()[std::size_t(i)], kAgreement);
      if (seen.is == Projection::Is::turned_away) continue;
      if (alone && !shape.seesItself(local, eye)) continue;
      using Is = Projection::Is;
      if (seen.is == Is::outside) ++counts.outside;
      if (seen.is == Is::none) ++counts.none;
      if (seen.is == Is::agrees) ++counts.agree;
      if (seen.is == Is::through) ++counts.through;
      if (seen.is != Is::hidden) continue;
      ++counts.hidden;
      if (alone) counts.before.push_back(view.point(int(seen.pixel) / view.width, int(seen.pixel) % view.width));
    }
  }
  return counts;
}

}  // namespace kinegraph::inline perception_internal
