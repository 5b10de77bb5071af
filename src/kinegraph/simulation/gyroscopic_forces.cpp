#include "kinegraph/simulation/gyroscopic_forces.h"

#include <algorithm>
#include <cmath>

namespace kinegraph::inline simulation_internal {

namespace {

/// rad per step. Slower rotations are not corrected: their energy grows by less than h/2 (kSlow/h)^2 per second.
constexpr double kSlow = 1e-3;
constexpr double kTooFast = .5;  ///< rad per step
constexpr int kMaxIterations = 20;
constexpr double kAccuracy = 1e-13;       ///< relative, of an angular momentum
constexpr double kJointAccuracy = 1e-10;  ///< relative, of joint velocities

using Vector = Eigen::Map<const Vector3d>;
using Rotation = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>;

Matrix3d rotation(const Vector3d& vector) {
  const double angle = vector.norm();
  if (angle == 0.) return Matrix3d::Identity();
  return Eigen::AngleAxisd(angle, vector / angle).toRotationMatrix();
}

Matrix3d crossMatrix(const Vector3d& v) {
  Matrix3d m;
  m << 0., -v.z(), v.y(), v.z(), 0., -v.x(), -v.y(), v.x(), 0.;
  return m;
}

/// Solves exp(h w'/2) I w' = momentum for w' by Newton's method, starting at `w`. Returns false without convergence.
bool findAngularVelocity(const Matrix3d& I, const Vector3d& momentum, double h, Vector3d& w) {
  for (int i = 0; i < kMaxIterations; ++i) {
    const Vector3d rotated = rotation(-.5 * h * w) * momentum;
    const Vector3d missing = I * w - rotated;
    if (missing.norm() <= kAccuracy * momentum.norm()) return true;
    w -= (I - .5 * h * crossMatrix(rotated)).partialPivLu().solve(missing);
  }
  return false;
}

}  // namespace

GyroscopicForces::GyroscopicForces(const SceneModel& scene, const mjModel& model) {
  std::vector<char> is_driven(std::size_t(model.nv), false), is_listed(std::size_t(model.nv), false);
  for (const Servo& servo : scene.servos)
    std::fill_n(is_driven.begin() + servo.dof, servo.kind == MotionKind::quaternion ? 3 : 1, true);
  for (const GripperJoint& gripper : scene.grippers) {
    for (const int dof : gripper.dof) is_driven[std::size_t(dof)] = true;
  }
  for (const SceneModel::Follower& follower : scene.followers) is_driven[std::size_t(follower.dof)] = true;

  std::vector<char> rotates(std::size_t(model.ntree), false);
  for (int dof = 0; dof < model.nv; ++dof) {
    const int joint = model.dof_jntid[dof], tree = model.dof_treeid[dof];
    const bool is_free = model.jnt_type[joint] == mjJNT_FREE;
    if (is_free && model.tree_dofnum[tree] == 6) {
      if (dof == model.jnt_dofadr[joint]) free_.push_back({model.dof_bodyid[dof], dof});
      is_listed[std::size_t(dof)] = true;
    } else if (!is_driven[std::size_t(dof)] && model.jnt_type[joint] != mjJNT_SLIDE &&
               !(is_free && dof < model.jnt_dofadr[joint] + 3)) {
      rotates[std::size_t(tree)] = true;
      rotation_dofs_.push_back(dof);
    }
  }
  for (int dof = 0; dof < model.nv; ++dof) {
    if (!is_driven[std::size_t(dof)] && !is_listed[std::size_t(dof)] && rotates[std::size_t(model.dof_treeid[dof])])
      joint_dofs_.push_back(dof);
  }
  for (std::vector<mjtNum>* numbers : {&velocity_, &middle_, &bias_, &force_, &change_})
    numbers->resize(std::size_t(model.nv));
}

void GyroscopicForces::apply(mjModel& m, mjData& d, double h) {
  too_fast_ = 0;
  for (const FreeBody& free : free_) applyToFree(d, free, h);
  applyToJoints(m, d, h);
}

void GyroscopicForces::applyToFree(mjData& d, const FreeBody& free, double h) {
  Eigen::Map<Vector6d> applied(d.qfrc_applied + free.dof);
  applied.setZero();
  const Vector3d w = Vector(d.qvel + free.dof + 3);
  const double angle = h * w.norm();
  if (!(angle > kSlow)) return;
  if (angle > kTooFast) too_fast_ = free.body;
  const Rotation R(d.xmat + 9 * free.body);
  const mjtNum* inertia = d.crb + 10 * free.body;
  const double mass = inertia[9];
  Matrix3d I;
  I << inertia[0], inertia[3], inertia[4], inertia[3], inertia[1], inertia[5], inertia[4], inertia[5], inertia[2];
  I = R.transpose() * I * R;
  const Vector3d center = R.transpose() * (Vector(d.subtree_com + 3 * free.body) - Vector(d.xpos + 3 * free.body));
  Vector3d next = w;
  if (!findAngularVelocity(I, rotation(-.5 * h * w) * (I * w), h, next)) return;

  // the origin moves such that the center of mass keeps its velocity
  const Vector3d to_next = next - w;
  const Vector3d velocity = (2. * center - rotation(-h * w) * center - rotation(h * next) * center) / h;
  // MuJoCo solves (M + h C) dv = h f, where C = dQ/dv is the derivative of the velocity-dependent forces Q. Because Q
  // is quadratic, C dv = Q(v + dv) - Q(v) - Q(dv); f already contains Q(v).
  const Matrix3d C = crossMatrix(center), about_origin = I - mass * C * C;
  const auto centrifugal = [&](const Vector3d& of) -> Vector3d { return mass * of.cross(of.cross(center)); };
  const auto gyroscopic = [&](const Vector3d& of) -> Vector3d { return of.cross(about_origin * of); };
  applied.head<3>() = R * (mass / h * (velocity + to_next.cross(center)) + centrifugal(next) - centrifugal(to_next));
  applied.tail<3>() =
      (mass * center.cross(velocity) + about_origin * to_next) / h + gyroscopic(next) - gyroscopic(to_next);
}

/// Finds the midpoint velocity (v + v')/2 by fixed-point iteration; v' is the next velocity without contacts and
/// damping.
void GyroscopicForces::applyToJoints(const mjModel& m, mjData& d, double h) {
  for (const int dof : joint_dofs_) d.qfrc_applied[dof] = 0.;
  double fastest = 0.;
  for (const int dof : rotation_dofs_) {
    const double angle = h * std::abs(d.qvel[dof]);
    fastest = std::max(fastest, angle);
    if (angle > kTooFast) too_fast_ = m.dof_bodyid[dof];
  }
  if (!(fastest > kSlow)) return;
  const Physics& mj = physics();
  const int n = m.nv;
  std::copy_n(d.qvel, n, velocity_.begin());
  std::copy_n(d.qvel, n, middle_.begin());
  std::copy_n(d.qfrc_bias, n, bias_.begin());
  const double largest = std::abs(*std::ranges::max_element(velocity_, {}, [](double v) { return std::abs(v); }));
  bool is_found = false;
  for (int i = 0; i < kMaxIterations && !is_found; ++i) {
    for (int k = 0; k < n; ++k) force_[std::size_t(k)] = d.qfrc_applied[k] + d.qfrc_gravcomp[k] - bias_[std::size_t(k)];
    mj.mj_solveM(&m, &d, change_.data(), force_.data(), 1);
    double moved = 0.;
    for (int k = 0; k < n; ++k) {
      const double next = velocity_[std::size_t(k)] + .5 * h * change_[std::size_t(k)];
      moved = std::max(moved, std::abs(next - middle_[std::size_t(k)]));
      middle_[std::size_t(k)] = d.qvel[k] = next;
    }
    is_found = moved <= kJointAccuracy * largest;
    mj.mj_comVel(&m, &d);
    mj.mj_rne(&m, &d, 0, bias_.data());
  }
  std::copy_n(velocity_.begin(), n, d.qvel);
  mj.mj_comVel(&m, &d);
  if (!is_found) return;
  for (const int dof : joint_dofs_) d.qfrc_applied[dof] = d.qfrc_bias[dof] - bias_[std::size_t(dof)];
}

}  // namespace kinegraph::inline simulation_internal
