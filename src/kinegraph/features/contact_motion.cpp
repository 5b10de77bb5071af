#include "kinegraph/features/contact_motion.h"

#include <cmath>

#include "kinegraph/features/distance.h"
#include "kinegraph/features/velocity.h"

namespace kinegraph::inline features_internal {

namespace {

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// The normal of a contact, from `from` to `object`, and its Jacobian.
struct Normal {
  Vector3d n;
  RowMajor J;

  Normal(const ContactForce& contact, const State& state, bool with_jacobian) {
    const Witness witness(Witness::Kind::normal, contact.object, contact.from);
    const State* states[] = {&state};
    if (!with_jacobian) {
      witness.eval(states, 1., n, nullptr);
      return;
    }
    J.setZero(3, state.dofs());
    JacobianRows rows(J);
    witness.eval(states, 1., n, &rows);
  }
};

/// Velocity of a point p that moves with a body, between two configurations, with the body's origin o and angular
/// velocity w:
///
///     v = (o(to) - o(from)) / tau + w x r,  r = p - o in `now`, which is one of the two
struct PointVelocity {
  const State &from, &to, &now;
  int body, point;
  double tau;
  Vector3d v, w, r;
  RowMajor J_w;

  /// `columns`: of J for both configurations; 0 if no Jacobian is needed.
  PointVelocity(const State& from_, const State& to_, const State& now_, int body_, int point_, double tau_,
                Eigen::Index columns)
      : from(from_),
        to(to_),
        now(now_),
        body(body_),
        point(point_),
        tau(tau_),
        r(now.position(point) - now.position(body)) {
    const State* states[] = {&from, &to};
    if (columns == 0) {
      AngularVelocity(body).eval(states, tau, w, nullptr);
    } else {
      J_w.setZero(3, columns);
      JacobianRows rows(J_w);
      AngularVelocity(body).eval(states, tau, w, &rows);
    }
    v = (to.position(body) - from.position(body)) / tau + w.cross(r);
  }

  /// Adds A dv/dq: `J_pair` has the columns of both configurations, `J_now` those of one of them.
  template <class Derived>
  void addJacobian(const Eigen::MatrixBase<Derived>& A, JacobianRows J_pair, JacobianRows J_now) const {
    using Rows = Eigen::Matrix<double, Derived::RowsAtCompileTime, 3>;
    const Eigen::Index n = J_pair.cols() / 2;
    const Rows linear = A / tau, angular = A * skew(w), none = A * 0.;
    to.addJacobian(body, to.position(body), linear, none, J_pair.rightCols(n));
    from.addJacobian(body, from.position(body), -linear, none, J_pair.leftCols(n));
    J_pair -= (A * skew(r)) * J_w;
    now.addJacobian(point, now.position(point), angular, none, J_now);
    now.addJacobian(body, now.position(body), -angular, none, J_now);
  }
};

/// Returns the columns of the i-th of `count` configurations.
JacobianRows columnsOf(JacobianRows& J, int i, int count) {
  const Eigen::Index n = J.cols() / count;
  return J.middleCols(i * n, n);
}

}  // namespace

void PullingForce::eval(std::span<const State* const> states, double, Eigen::Ref<VectorXd> y, JacobianRows* J) const {
  const State& state = *states[0];
  y.setZero();
  if (!contact_.isIn(state)) return;
  const Normal normal(contact_, state, J);
  const Vector3d f = contact_.value(state) / contact_.unit;
  y[0] = -normal.n.dot(f);
  if (!J) return;
  contact_.addJacobian(state, -normal.n.transpose() / contact_.unit, *J);
  J->leftCols(normal.J.cols()) -= f.transpose() * normal.J;
}

void ForceValue::eval(std::span<const State* const> states, double, Eigen::Ref<VectorXd> y, JacobianRows* J) const {
  y = contact_.value(*states[0]);
  if (J) contact_.addJacobian(*states[0], Matrix3d(Matrix3d::Identity()), *J);
}

void SlidingVelocity::eval(std::span<const State* const> states, double tau, Eigen::Ref<VectorXd> y,
                           JacobianRows* J) const {
  const State &before = *states[0], &now = *states[1];
  y.setZero();
  if (!contact_.isIn(now)) return;
  const Eigen::Index columns = J ? J->cols() : 0;
  const PointVelocity object(before, now, now, contact_.object, contact_.point, tau, columns);
  const PointVelocity from(before, now, now, contact_.from, contact_.point, tau, columns);
  y = object.v - from.v;
  if (!J) return;
  object.addJacobian(Matrix3d(Matrix3d::Identity()), *J, columnsOf(*J, 1, 2));
  from.addJacobian(Matrix3d(-Matrix3d::Identity()), *J, columnsOf(*J, 1, 2));
}

void ElasticBounce::eval(std::span<const State* const> states, double tau, Eigen::Ref<VectorXd> y,
                         JacobianRows* J) const {
  const State &before = *states[0], &now = *states[1], &after = *states[2];
  y.setZero();
  if (!contact_.isIn(now)) return;
  const Eigen::Index columns = J ? J->cols() / 3 * 2 : 0;
  const PointVelocity object_before(before, now, now, contact_.object, contact_.point, tau, columns);
  const PointVelocity from_before(before, now, now, contact_.from, contact_.point, tau, columns);
  const PointVelocity object_after(now, after, now, contact_.object, contact_.point, tau, columns);
  const PointVelocity from_after(now, after, now, contact_.from, contact_.point, tau, columns);
  const Normal normal(contact_, now, J);
  const Vector3d v = object_after.v - from_after.v + elasticity_ * (object_before.v - from_before.v);
  y[0] = normal.n.dot(v);
  if (!J) return;
  const Eigen::RowVector3d A = normal.n.transpose(), B = elasticity_ * A;
  object_after.addJacobian(A, J->rightCols(columns), columnsOf(*J, 1, 3));
  from_after.addJacobian(Eigen::RowVector3d(-A), J->rightCols(columns), columnsOf(*J, 1, 3));
  object_before.addJacobian(B, J->leftCols(columns), columnsOf(*J, 1, 3));
  from_before.addJacobian(Eigen::RowVector3d(-B), J->leftCols(columns), columnsOf(*J, 1, 3));
  columnsOf(*J, 1, 3).leftCols(normal.J.cols()) += v.transpose() * normal.J;
}

void ForceTimesDistance::eval(std::span<const State* const> states, double tau, Eigen::Ref<VectorXd> y,
                              JacobianRows* J) const {
  const PullingForce pull(contact_);
  const NegDistance overlap(contact_.object, contact_.from);
  VectorXd force(1), depth(1);
  if (!J) {
    pull.eval(states, tau, force, nullptr);
    overlap.eval(states, tau, depth, nullptr);
    y = force * depth[0];
    return;
  }
  RowMajor J_force = RowMajor::Zero(1, J->cols()), J_depth = J_force;
  JacobianRows rows_force(J_force), rows_depth(J_depth);
  pull.eval(states, tau, force, &rows_force);
  overlap.eval(states, tau, depth, &rows_depth);
  y = force * depth[0];
  *J += depth[0] * J_force + force[0] * J_depth;
}

void ForceTimesVelocity::eval(std::span<const State* const> states, double tau, Eigen::Ref<VectorXd> y,
                              JacobianRows* J) const {
  const State& now = *states[1];
  y.setZero();
  if (!contact_.isIn(now)) return;
  const SlidingVelocity sliding(contact_);
  const Normal normal(contact_, now, J);
  const Vector3d f = contact_.value(now) / contact_.unit;
  VectorXd v(3);
  if (!J) {
    sliding.eval(states, tau, v, nullptr);
    y[0] = normal.n.dot(v) * normal.n.dot(f);
    return;
  }
  RowMajor J_v = RowMajor::Zero(3, J->cols());
  JacobianRows rows(J_v);
  sliding.eval(states, tau, v, &rows);
  const double force = normal.n.dot(f), speed = normal.n.dot(v);
  y[0] = speed * force;
  *J += force * normal.n.transpose() * J_v;
  JacobianRows later = columnsOf(*J, 1, 2);
  contact_.addJacobian(now, Eigen::RowVector3d(speed / contact_.unit * normal.n.transpose()), later);
  later.leftCols(normal.J.cols()) += (force * v + speed * f).transpose() * normal.J;
}

void PushRadius::eval(std::span<const State* const> states, double tau, Eigen::Ref<VectorXd> y, JacobianRows* J) const {
  constexpr double kSlowest = 1e-3;  // m/s; below it the direction fades to zero
  const State &before = *states[0], &now = *states[1];
  const Vector3d c = now.position(object_), p = now.position(point_), v = (c - before.position(object_)) / tau;
  const double speed = std::hypot(v.norm(), kSlowest);
  y = radius_ / speed * v - (c - p);
  if (!J) return;
  const Matrix3d one = Matrix3d::Identity(), none = Matrix3d::Zero();
  const Matrix3d slope = radius_ / tau * (one / speed - v * v.transpose() / (speed * speed * speed));
  const Eigen::Index n = J->cols() / 2;
  now.addJacobian(object_, c, Matrix3d(slope - one), none, J->rightCols(n));
  now.addJacobian(point_, p, one, none, J->rightCols(n));
  before.addJacobian(object_, before.position(object_), Matrix3d(-slope), none, J->leftCols(n));
}

}  // namespace kinegraph::inline features_internal
