#include "kinegraph/perception/fit_sensors.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/geometry/shapes/cells.h"
#include "kinegraph/perception/measured_depth.h"

namespace kinegraph::inline perception_internal {

namespace {

constexpr int kPixelStep = 6;                 // between points, in each direction
constexpr double kSensorPixelsOfNoise = 50.;  // pixels with a common error, from the windows of a stereo match
constexpr double kCameraPosition = .02;       // m, standard deviation of the prior
constexpr double kCameraRotation = .03;       // rad
constexpr double kJointAngle = .01;           // rad
constexpr double kJointLength = .005;         // m
constexpr double kThingPosition = .05, kThingRotation = .5;  // m, rad
constexpr double kFitted = .006;                             // m, farther points are not of this body
constexpr double kLongestMove = .03, kLargestTurn = .1;      // m, rad, of a step
constexpr double kDetermined = .7;  // standard deviation over that of the prior, above which the images tell little
const std::vector<double> kSensorWidths{.04, .03, .02, .015, .01, .007, .005, .004, .003, .003};  // m
const std::vector<double> kJointWidths{.006, .004, .003, .003, .003};  // m, together with the things

bool hasOwnJoint(const Frame& frame) { return frame.data().joint && frame.data().joint->dofs() > 0; }

RigidTransform displacedBy(const RigidTransform& X, const Vector3d& by, const Vector3d& turn) {
  const double angle = turn.norm();
  const Matrix3d R = angle > 0. ? Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix() : Matrix3d::Identity();
  return {R * X.R, X.p + by};
}

std::set<int> idsOf(const Config& config, const std::vector<std::string>& names) {
  std::set<int> ids;
  for (const std::string& name : names) ids.insert(config.getFrame(name).id());
  return ids;
}

bool estimates(const RegisterOptions& options, Estimate what) {
  return std::find(options.estimate.begin(), options.estimate.end(), what) != options.estimate.end();
}

/// The inverse variances of the prior of a thing, per direction of its freedom.
VectorXd priorOfThing(const PoseFreedom& freedom) {
  const auto B = freedom.basis();
  VectorXd prior(B.cols());
  for (int i = 0; i < B.cols(); ++i)
    prior[i] = B.col(i).head<3>().squaredNorm() / (kThingPosition * kThingPosition) +
               B.col(i).tail<3>().squaredNorm() / (kThingRotation * kThingRotation);
  return prior;
}

}  // namespace

SensorFit::SensorFit(Config& config, std::span<const DepthView> views, const std::vector<std::string>& things,
                     const RegisterOptions& options)
    : config_(config), views_(views.begin(), views.end()), things_(things), may_rest_(!options.support.empty()) {
  const std::set<int> ids = idsOf(config, things);
  camera_of_view_.assign(views_.size(), -1);
  for (const DepthView& view : views_)
    frame_of_view_.push_back(view.camera.empty() ? -1 : config_.getFrame(view.camera).id());
  if (estimates(options, Estimate::camera)) addCameras();
  if (estimates(options, Estimate::joints)) addDofs(ids);
  moved_ = VectorXd::Zero(sensorVariables());
  addPoints();
  addBodies(ids);
}

void SensorFit::addCameras() {
  for (std::size_t k = 0; k < views_.size(); ++k) {
    const int frame = frame_of_view_[k];
    if (frame >= 0 && hasOwnJoint(config_.getFrame(frame)))
      throw ValueError(cat("registerScene: estimate has 'camera', and the camera's frame '", views_[k].camera,
                           "' has a joint of its own; expected a camera frame fixed to its parent"));
    const auto known = std::find_if(cameras_.begin(), cameras_.end(),
                                    [&](const Camera& camera) { return frame >= 0 && camera.frame == frame; });
    camera_of_view_[k] = int(known - cameras_.begin());
    if (known == cameras_.end()) cameras_.push_back({frame, int(k)});
  }
}

void SensorFit::addDofs(const std::set<int>& things) {
  for (const Frame& frame : config_.getJoints()) {
    const Joint& joint = *frame.data().joint;
    const int index = config_.model()->frame_dofs[std::size_t(frame.id())].first;
    const bool is_single = joint.dofs() == 1 && joint.steps.size() == 1;
    if (is_single && !joint.mimic && joint.steps[0].moves() && !things.contains(frame.id()))
      dofs_.push_back({index, frame.getName(), joint.steps[0].translates() ? kJointLength : kJointAngle});
  }
  if (dofs_.empty())
    throw ValueError(
        "registerScene: estimate has 'joints', and the scene has no active hinge or slide but those of the frames "
        "looked for; expected an arm");
}

void SensorFit::addPoints() {
  for (std::size_t k = 0; k < views_.size(); ++k) {
    const DepthView& view = views_[k];
    for (int row = kPixelStep / 2; row < view.height; row += kPixelStep) {
      for (int column = kPixelStep / 2; column < view.width; column += kPixelStep) {
        const double d = view.depth[std::size_t(row) * std::size_t(view.width) + std::size_t(column)];
        if (!isMeasured(float(d))) continue;
        const Vector4d& f = view.fxycxy;
        points_.push_back(
            {{(column + .5 - f[2]) * d / f[0], (row + .5 - f[3]) * d / f[1], d}, view.noise * d * d, int(k)});
      }
    }
  }
}

/// Each part whose shapes do not move relative to each other.
void SensorFit::addBodies(const std::set<int>& things) {
  for (const Frame& frame : config_.getFrames()) {
    const bool is_root = !frame.getParent() || hasOwnJoint(frame);
    if (!is_root || things.contains(frame.id()) || !hasVisibleShape(frame, things)) continue;
    bodies_.push_back({VisibleShape(frame, things), frame.id()});
  }
  parts_ = bodies_.size();
}

void SensorFit::addThings(const SeenScene& seen) {
  while (bodies_.size() > parts_) bodies_.pop_back();
  int variable = sensorVariables();
  for (const auto& [name, result] : seen.frames) {
    if (result.status != SeenStatus::seen) continue;
    const Frame frame = config_.getFrame(name);
    Body body{VisibleShape(frame, idsOf(config_, things_)), frame.id()};
    body.X = frame.getPose().transform();
    body.thing = name;
    body.freedom = freedomOf(frame, may_rest_);
    body.first_variable = variable;
    variable += int(body.freedom.basis().cols());
    bodies_.push_back(std::move(body));
  }
}

int SensorFit::variables() const {
  int count = sensorVariables();
  for (std::size_t i = parts_; i < bodies_.size(); ++i) count += int(bodies_[i].freedom.basis().cols());
  return count;
}

/// Updates the poses of cameras and bodies from those of the scene.
void SensorFit::place() {
  eyes_.clear();
  for (const DepthView& view : views_) eyes_.push_back(view.cameraPose(config_).transform());
  for (std::size_t i = 0; i < parts_; ++i) bodies_[i].X = config_.getFrame(bodies_[i].frame).getPose().transform();
  for (Body& body : bodies_) {
    body.eyes.clear();
    for (const RigidTransform& X_WC : eyes_)
      body.eyes.push_back(body.shape.eyeInParts(body.X.R.transpose() * (X_WC.p - body.X.p)));
  }
}

/// The body whose surface that faces the camera is nearest, if it is within `reach`.
SensorFit::Contact SensorFit::contactOf(const Vector3d& p, int view, double reach) const {
  Contact best;
  for (const Body& body : bodies_) {
    const Vector3d arm = p - body.X.p;
    const double far = body.shape.radius() + std::min(reach, std::abs(best.near.distance));
    if (arm.squaredNorm() > far * far) continue;
    const SurfaceDistance near = body.shape.facing(body.X.R.transpose() * arm, body.eyes[std::size_t(view)]);
    if (std::abs(near.distance) < std::min(reach, std::abs(best.near.distance))) best = {&body, near};
  }
  return best;
}

/// The derivative of a point's distance from a body by all variables. `normal` is that of the surface, in the world.
VectorXd SensorFit::row(const Body& body, const Point& point, const Vector3d& p, const Vector3d& normal) const {
  VectorXd J = VectorXd::Zero(variables());
  const State& state = config_.state();
  if (const int camera = camera_of_view_[std::size_t(point.view)]; camera >= 0)
    J.segment<6>(6 * camera) << normal, (p - eyes_[std::size_t(point.view)].p).cross(normal);
  if (!dofs_.empty()) {
    VectorXd of_q = VectorXd::Zero(state.dofs());
    const auto velocity = [&](const State::Twist& twist) { return normal.dot(twist.linear + twist.angular.cross(p)); };
    if (const int camera = frame_of_view_[std::size_t(point.view)]; camera >= 0)
      state.forTwists(camera, [&](int dof, const State::Twist& twist) { of_q[dof] += velocity(twist); });
    if (body.thing.empty())
      state.forTwists(body.frame, [&](int dof, const State::Twist& twist) { of_q[dof] -= velocity(twist); });
    for (std::size_t i = 0; i < dofs_.size(); ++i) J[Eigen::Index(6 * cameras_.size() + i)] = of_q[dofs_[i].index];
  }
  if (body.first_variable >= 0) {
    const auto B = body.freedom.basis();
    Vector6d of_thing;
    of_thing << normal, (p - body.X.p).cross(normal);
    J.segment(body.first_variable, B.cols()) = -(B.transpose() * of_thing);
  }
  return J;
}

SensorFit::Equations SensorFit::equations(double width, bool inliers_only) const {
  const int n = variables();
  Equations sum{MatrixXd::Zero(n, n), VectorXd::Zero(n), std::vector<VectorXd>(views_.size(), VectorXd::Zero(n))};
  for (const Point& point : points_) {
    const RigidTransform& X_WC = eyes_[std::size_t(point.view)];
    const Vector3d p = X_WC * point.c;
    const double reach = inliers_only ? std::max(kFitted, 3. * point.sigma) : std::max(4. * width, .012);
    const Contact contact = contactOf(p, point.view, reach);
    if (!contact.body) continue;
    const double d = contact.near.distance, ratio = d / std::max(width, 1.2 * point.sigma);
    const double robust = inliers_only ? 1. : std::pow(1. + ratio * ratio, -2),
                 weight = robust / (point.sigma * point.sigma);
    const Vector3d normal = contact.body->X.R * contact.near.gradient;
    const VectorXd J = row(*contact.body, point, p, normal);
    sum.H.selfadjointView<Eigen::Lower>().rankUpdate(J, weight);
    sum.g += weight * d * J;
    const DepthView& view = views_[std::size_t(point.view)];
    sum.pulls[std::size_t(point.view)] +=
        weight * normal.dot((p - X_WC.p).normalized()) * point.sigma * view.bias / view.noise * J;
    sum.residuals += weight * d * d;
    ++sum.count;
  }
  sum.H = MatrixXd(sum.H.selfadjointView<Eigen::Lower>());
  return sum;
}

/// The inverse variances of the priors of all variables.
VectorXd SensorFit::priors() const {
  VectorXd prior(variables());
  for (std::size_t k = 0; k < cameras_.size(); ++k)
    prior.segment<6>(Eigen::Index(6 * k)) << Vector3d::Constant(std::pow(kCameraPosition, -2)),
        Vector3d::Constant(std::pow(kCameraRotation, -2));
  for (std::size_t i = 0; i < dofs_.size(); ++i)
    prior[Eigen::Index(6 * cameras_.size() + i)] = std::pow(dofs_[i].deviation, -2);
  for (std::size_t i = parts_; i < bodies_.size(); ++i) {
    const VectorXd of_thing = priorOfThing(bodies_[i].freedom);
    prior.segment(bodies_[i].first_variable, of_thing.size()) = of_thing;
  }
  return prior;
}

/// Moves cameras, joints and things.
void SensorFit::move(const VectorXd& step) {
  moved_ += step.head(sensorVariables());
  for (std::size_t k = 0; k < cameras_.size(); ++k) {
    const auto by = step.segment<6>(Eigen::Index(6 * k));
    const Camera& camera = cameras_[k];
    const RigidTransform X = displacedBy(eyes_[std::size_t(camera.view)], by.head<3>(), by.tail<3>());
    if (camera.frame >= 0)
      config_.getFrame(camera.frame).setPose(Pose(X));
    else
      views_[std::size_t(camera.view)].pose = Pose(X);
  }
  VectorXd q = config_.getJointState();
  for (std::size_t i = 0; i < dofs_.size(); ++i) q[dofs_[i].index] += step[Eigen::Index(6 * cameras_.size() + i)];
  if (!dofs_.empty()) config_.setJointState(q);
  for (std::size_t i = parts_; i < bodies_.size(); ++i) {
    const auto B = bodies_[i].freedom.basis();
    bodies_[i].X = bodies_[i].freedom.moved(bodies_[i].X, B * step.segment(bodies_[i].first_variable, B.cols()));
  }
}

void SensorFit::fit(const SeenScene& seen) {
  addThings(seen);
  const VectorXd prior = priors();
  for (const double width : seen.frames.empty() ? kSensorWidths : kJointWidths) {
    place();
    const Equations sum = equations(width, false);
    MatrixXd H = sum.H;
    H.diagonal() += prior;
    VectorXd g = sum.g;
    g.head(moved_.size()) += prior.head(moved_.size()).cwiseProduct(moved_);
    VectorXd step = -H.ldlt().solve(g);
    double excess = 1.;
    for (std::size_t k = 0; k < cameras_.size(); ++k) {
      const auto by = step.segment<6>(Eigen::Index(6 * k));
      excess = std::max({excess, by.head<3>().norm() / kLongestMove, by.tail<3>().norm() / kLargestTurn});
    }
    for (std::size_t i = 0; i < dofs_.size(); ++i)
      excess = std::max(excess, std::abs(step[Eigen::Index(6 * cameras_.size() + i)]) / kLargestTurn);
    move(step / excess);
  }
  place();
}

void SensorFit::describe(SeenScene& seen) const {
  const int m = sensorVariables();
  const Equations sum = equations(kFitted, true);
  const double shared = std::max(1., kSensorPixelsOfNoise / (kPixelStep * kPixelStep));
  const double scale = shared * std::max(1., sum.residuals / std::max(sum.count, 1));
  MatrixXd H = sum.H / scale;
  H.diagonal() += priors();
  const MatrixXd inverse = H.inverse();
  MatrixXd covariance = inverse;
  for (const VectorXd& pull : sum.pulls) {
    const VectorXd shift = inverse * pull / scale;
    covariance += shift * shift.transpose();
  }
  for (const int camera : camera_of_view_) {
    if (camera < 0) continue;
    const Camera& of = cameras_[std::size_t(camera)];
    const std::optional<Frame> parent = of.frame >= 0 ? config_.getFrame(of.frame).getParent() : std::nullopt;
    const RigidTransform X_WP = parent ? parent->getPose().transform() : RigidTransform{};
    Matrix6d to_parent = Matrix6d::Zero();
    to_parent.topLeftCorner<3, 3>() = to_parent.bottomRightCorner<3, 3>() = X_WP.R.transpose();
    seen.cameras.push_back({Pose(X_WP.inverse() * eyes_[std::size_t(of.view)]).canonical(),
                            to_parent * covariance.block<6, 6>(6 * camera, 6 * camera) * to_parent.transpose()});
  }
  const Eigen::Index first = Eigen::Index(6 * cameras_.size()), count = Eigen::Index(dofs_.size());
  for (const Dof& dof : dofs_) seen.joints.push_back(dof.name);
  seen.joint_offsets = moved_.segment(first, count);
  seen.joint_covariance = covariance.block(first, first, count, count);
  for (std::size_t i = parts_; i < bodies_.size(); ++i) {
    const auto found = seen.frames.find(bodies_[i].thing);
    if (found == seen.frames.end() || found->second.status != SeenStatus::seen) continue;
    const auto B = bodies_[i].freedom.basis();
    const Eigen::Index at = bodies_[i].first_variable, size = B.cols();
    const MatrixXd shift = B * H.block(at, at, size, size).ldlt().solve(H.block(at, 0, size, m));
    found->second.covariance += shift * covariance.topLeftCorner(m, m) * shift.transpose();
  }
  addWarnings(covariance, seen.warnings);
}

/// Names the sensors that the images hardly determine.
void SensorFit::addWarnings(const MatrixXd& covariance, std::vector<std::string>& warnings) const {
  const VectorXd relative = covariance.diagonal().cwiseProduct(priors()).cwiseSqrt();  // to the deviation of the prior
  std::vector<std::string> open;
  for (std::size_t i = 0; i < dofs_.size(); ++i) {
    if (relative[Eigen::Index(6 * cameras_.size() + i)] > kDetermined) open.push_back(dofs_[i].name);
  }
  if (!open.empty())
    warnings.push_back(cat("the images hardly determine the offsets of the joints '", join(open, "', '"),
                           "', as if they do not show what these move; joint_covariance has the uncertainty"));
  for (std::size_t k = 0; k < cameras_.size(); ++k) {
    const Matrix6d of_camera = covariance.block<6, 6>(Eigen::Index(6 * k), Eigen::Index(6 * k));
    const Vector6d prior = priors().segment<6>(Eigen::Index(6 * k)).cwiseSqrt();
    const Matrix6d scaled = prior.asDiagonal() * of_camera * prior.asDiagonal();
    if (std::sqrt(Eigen::SelfAdjointEigenSolver<Matrix6d>(scaled).eigenvalues().maxCoeff()) > kDetermined)
      warnings.push_back(cat("the images do not determine the camera of view ", cameras_[k].view,
                             " in all directions, as if they show one plane; its covariance has the uncertainty"));
  }
}

void SensorFit::correct(Config& config) const {
  if (!dofs_.empty()) config.setJointState(config_.getJointState());
  for (const Camera& camera : cameras_) {
    if (camera.frame < 0) continue;
    const Frame from = config_.getFrame(camera.frame);
    Frame to = config.getFrame(camera.frame);
    if (to.getParent())
      to.setRelativePose(from.getRelativePose());
    else
      to.setPose(from.getPose());
  }
}

}  // namespace kinegraph::inline perception_internal
