#include "kinegraph/features/distance.h"

#include <algorithm>

namespace kinegraph::inline features_internal {

namespace {

const CollisionBody& bodyOf(const State& state, int frame) {
  static const std::shared_ptr<const CollisionBody> point = pointBody();
  const auto& body = state.model().body[frame];
  return body ? *body : *point;
}

Proximity proximityOf(const State& state, int a, int b) {
  return proximity(bodyOf(state, a), state.pose(a), bodyOf(state, b), state.pose(b));
}

/// Returns d / (|d| + eps) and its derivative.
Vector3d softDirection(const Vector3d& d, double eps, Matrix3d& derivative) {
  const double norm = d.norm(), soft = norm + eps;
  derivative = Matrix3d::Identity() / soft;
  if (norm > 0.) derivative -= d * d.transpose() / (norm * soft * soft);
  return d / soft;
}

/// Returns the derivative from values before and after a point. At a discontinuity it is the one-sided derivative of
/// the smoother side.
Vector3d slopeAt(const Vector3d& before, const Vector3d& at, const Vector3d& after, double h) {
  const Vector3d back = at - before, ahead = after - at;
  const double larger = std::max(ahead.norm(), back.norm());
  if ((ahead - back).norm() <= std::max(.01 * h, .1 * larger)) return (after - before) / (2. * h);
  return (ahead.norm() <= back.norm() ? ahead : back) / h;
}

}  // namespace

void addDistanceGradient(const State& state, int a, int b, const Proximity& near, double factor, JacobianRows& J) {
  const KinematicModel& model = state.model();
  const Vector3d n = factor * near.rate * near.normal, moment_a = near.point_a.cross(n),
                 moment_b = near.point_b.cross(n);
  int column_a = model.last_column[state.link(a)], column_b = model.last_column[state.link(b)];
  while (column_a != column_b) {  // columns come after their ancestors
    int& column = std::max(column_a, column_b) == column_a ? column_a : column_b;
    const State::Twist& twist = state.twist(column);
    const bool of_a = &column == &column_a;
    const double rate = n.dot(twist.linear) + (of_a ? moment_a : moment_b).dot(twist.angular);
    J(0, model.column_dof[column]) += of_a ? rate : -rate;
    column = model.column_before[column];
  }
}

void NegDistance::eval(std::span<const State* const> states, double, Eigen::Ref<VectorXd> y, JacobianRows* J) const {
  const Proximity near = proximityOf(*states[0], a_, b_);
  y[0] = -near.distance;
  if (J) addDistanceGradient(*states[0], a_, b_, near, -1., *J);
}

Vector3d Witness::value(const Proximity& near) const {
  switch (kind_) {
    case Kind::vector:
      return near.point_a - near.point_b;
    case Kind::normal:
      return near.normal;
    case Kind::point_a:
      return near.point_a;
    case Kind::point_b:
      return near.point_b;
    case Kind::core_vector:
      return near.core_a - near.core_b;
  }
  return Vector3d::Zero();
}

void Witness::eval(std::span<const State* const> states, double, Eigen::Ref<VectorXd> y, JacobianRows* J) const {
  const State& state = *states[0];
  const CollisionBody &body_a = bodyOf(state, a_), &body_b = bodyOf(state, b_);
  const RigidTransform X_WA = state.pose(a_), X_WB = state.pose(b_);
  const Proximity near = proximity(body_a, X_WA, body_b, X_WB);
  const Vector3d at = value(near);
  y = at;
  if (!J) return;
  const double h = 1e-6;
  Matrix3d linear, angular;  // of A moving about `center` while B is fixed
  const Vector3d center = near.core_a;
  for (int i = 0; i < 3; ++i) {
    const auto moved = [&](double step, bool rotates) {
      RigidTransform X = X_WA;
      if (rotates) {
        const Matrix3d R = axisRotation(i, step);
        X = {R * X_WA.R, center + R * (X_WA.p - center)};
      } else {
        X.p[i] += step;
      }
      return value(proximity(body_a, X, body_b, X_WB));
    };
    linear.col(i) = slopeAt(moved(-h, false), at, moved(h, false), h);
    angular.col(i) = slopeAt(moved(-h, true), at, moved(h, true), h);
  }
  state.addJacobian(a_, center, linear, angular, *J);
  state.addJacobian(b_, center, -linear, -angular, *J);
  if (kind_ == Kind::point_a || kind_ == Kind::point_b) {
    state.addPointJacobian(b_, at, 1., *J);
  } else {
    state.addJacobian(b_, center, Matrix3d::Zero(), -skew(at), *J);
  }
}

void Oppose::eval(std::span<const State* const> states, double tau, Eigen::Ref<VectorXd> y, JacobianRows* J) const {
  const State& state = *states[0];
  Vector3d v1, v2;
  Matrix3d D, D1, D2;
  if (!J) {
    first_.eval(states, tau, v1, nullptr);
    second_.eval(states, tau, v2, nullptr);
  } else {  // the rows above hold J1, then J1 + J2; the rows below D1 J1 - D2 J2 = (D1 + D2) J1 - D2 (J1 + J2)
    JacobianRows above = J->topRows(3);
    first_.eval(states, tau, v1, &above);
    if (central_) {
      second_.eval(states, tau, v2, nullptr);
      softDirection(v1, 1e-3, D1);
      softDirection(v2, 1e-3, D2);
      J->bottomRows(3) += (.01 * (D1 + D2)).lazyProduct(above);
    }
    second_.eval(states, tau, v2, &above);
    if (central_) J->bottomRows(3) -= (.01 * D2).lazyProduct(above);
  }
  y.head<3>() = v1 + v2;
  if (!central_) return;
  const Vector3d p1 = state.position(finger1_), p2 = state.position(finger2_);
  y.tail<3>() =
      .01 * (2. * softDirection(p2 - p1, 1e-3, D) + softDirection(v1, 1e-3, D1) - softDirection(v2, 1e-3, D2));
  if (!J) return;
  const Matrix3d none = Matrix3d::Zero();
  state.addJacobian(finger2_, p2, .02 * D, none, J->bottomRows(3));
  state.addJacobian(finger1_, p1, -.02 * D, none, J->bottomRows(3));
}

}  // namespace kinegraph::inline features_internal
