#include "kinegraph/features/velocity.h"

#include <cmath>

namespace kinegraph::inline features_internal {

namespace {

/// The columns of J for the earlier and the later configuration.
JacobianRows earlier(JacobianRows& J) { return J.leftCols(J.cols() / 2); }
JacobianRows later(JacobianRows& J) { return J.rightCols(J.cols() / 2); }

}  // namespace

void AngularVelocity::eval(std::span<const State* const> states, double tau, Eigen::Ref<VectorXd> y,
                           JacobianRows* J) const {
  const Quaterniond before(states[0]->pose(frame_).R), now(states[1]->pose(frame_).R);
  Quaterniond step = now * before.conjugate();
  if (step.w() < 0.) step.coeffs() *= -1.;
  y = 2. / tau * step.vec();
  if (!J) return;
  const Matrix3d none = Matrix3d::Zero(), linear = step.w() / tau * Matrix3d::Identity(),
                 rotation = skew(step.vec()) / tau;
  states[1]->addJacobian(frame_, Vector3d::Zero(), none, linear - rotation, later(*J));
  states[0]->addJacobian(frame_, Vector3d::Zero(), none, -linear - rotation, earlier(*J));
}

void LinearVelocity::eval(std::span<const State* const> states, double tau, Eigen::Ref<VectorXd> y,
                          JacobianRows* J) const {
  const Vector3d before = states[0]->position(frame_), now = states[1]->position(frame_);
  y = (now - before) / tau;
  if (!J) return;
  states[1]->addPointJacobian(frame_, now, 1. / tau, later(*J));
  states[0]->addPointJacobian(frame_, before, -1. / tau, earlier(*J));
}

void AlignWithMotion::eval(std::span<const State* const> states, double, Eigen::Ref<VectorXd> y,
                           JacobianRows* J) const {
  const Vector3d before = states[0]->position(b_), now = states[1]->position(b_), d = now - before;
  const Vector3d axis = states[0]->pose(a_).R.col(axis_);
  constexpr double kShortest = 1e-4;  // m; below it the direction fades to zero
  const double soft = std::hypot(d.norm(), kShortest);
  y = d / soft - axis;
  if (!J) return;
  const Matrix3d D = Matrix3d::Identity() / soft - d * d.transpose() / (soft * soft * soft);
  const Matrix3d none = Matrix3d::Zero();
  states[1]->addJacobian(b_, now, D, none, later(*J));
  states[0]->addJacobian(b_, before, -D, none, earlier(*J));
  states[0]->addJacobian(a_, Vector3d::Zero(), none, skew(axis), earlier(*J));
}

}  // namespace kinegraph::inline features_internal
