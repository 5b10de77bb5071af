#include "kinegraph/features/forces.h"

#include <cmath>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/features/distance.h"
#include "kinegraph/kinematics/dynamics.h"

namespace kinegraph::inline features_internal {

namespace {

using Factor = ContactForce::Factor;
using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

bool isRigidlyJoined(const State& state, int a, int b) {
  return a == b || (state.link(a) == state.link(b) && state.link(a) > 0);
}

/// Returns 1 if the force acts on the frame, -1 if its reaction does, 0 otherwise.
double signFor(const ContactForce& contact, const State& state, int frame) {
  if (!contact.isIn(state)) return 0.;
  const double on = isRigidlyJoined(state, contact.object, frame), back = isRigidlyJoined(state, contact.from, frame);
  return on - back;
}

/// Sum of the forces on a frame and of their torques about its center of mass.
struct ContactWrench {
  Vector3d force = Vector3d::Zero(), torque = Vector3d::Zero();

  ContactWrench(const std::vector<ContactForce>& contacts, const State& state, int frame) {
    const Vector3d center = frameCenterOfMass(state, frame);
    for (const ContactForce& contact : contacts) {
      const double sign = signFor(contact, state, frame);
      if (sign == 0.) continue;
      const Vector3d f = sign * contact.value(state);
      force += f;
      torque += (state.position(contact.point) - center).cross(f);
    }
  }
};

/// Adds A d force/dq + B d torque/dq to J.
void addWrenchJacobian(const std::vector<ContactForce>& contacts, const State& state, int frame, const Factor& A,
                       const Factor& B, JacobianRows J) {
  const Vector3d center = frameCenterOfMass(state, frame);
  const Factor none = Factor::Zero(A.rows(), 3);
  for (const ContactForce& contact : contacts) {
    const double sign = signFor(contact, state, frame);
    if (sign == 0.) continue;
    const Vector3d f = sign * contact.value(state), p = state.position(contact.point);
    contact.addJacobian(state, sign * (A + B * skew(p - center)), J);
    const Factor C = -B * skew(f);
    state.addJacobian(contact.point, p, C, none, J);
    state.addJacobian(frame, center, Factor(-C), none, J);
  }
}

/// Returns the normal from b to a, and its Jacobian by the dofs of the state unless `J` is null.
Vector3d normalOf(const State& state, int a, int b, double tau, RowMajor* J) {
  const Witness normal(Witness::Kind::normal, a, b);
  const State* states[] = {&state};
  Vector3d n;
  if (!J) {
    normal.eval(states, tau, n, nullptr);
    return n;
  }
  J->setZero(3, state.dofs());
  JacobianRows rows(*J);
  normal.eval(states, tau, n, &rows);
  return n;
}

}  // namespace

Vector3d ContactForce::value(const State& state) const {
  const auto [first, count] = state.model().frame_dofs[dofs];
  if (count == 0) return Vector3d::Zero();
  if (is_free) return unit * state.q().segment<3>(first);
  return unit * state.q()[first] * state.pose(point).R.col(2);
}

void ContactForce::addJacobian(const State& state, const Factor& A, JacobianRows J) const {
  const auto [first, count] = state.model().frame_dofs[dofs];
  if (count == 0) return;
  if (is_free) {
    J.middleCols(first, 3) += unit * A;
    return;
  }
  const Vector3d z = state.pose(point).R.col(2);
  J.col(first) += unit * A * z;
  state.addJacobian(point, state.position(point), Factor(Factor::Zero(A.rows(), 3)),
                    Factor(-unit * state.q()[first] * A * skew(z)), J);
}

void TotalForce::eval(std::span<const State* const> states, double, Eigen::Ref<VectorXd> y, JacobianRows* J) const {
  const State& state = *states[0];
  const double mass = state.parameters().frame_mass[frame_].mass;
  if (!(mass > 0.)) {
    throw ValueError(
        cat("totalForce: '", state.model().frame_name[frame_], "' has no mass; give it `mass: ..` or call setMass"));
  }
  const ContactWrench wrench(contacts_, state, frame_);
  y.head<3>() = -mass * kGravity - wrench.force;
  y.tail<3>() = wrench.torque;
  if (!J) return;
  Factor A = Factor::Zero(6, 3), B = A;
  A.topRows(3) = -Matrix3d::Identity();
  B.bottomRows(3).setIdentity();
  addWrenchJacobian(contacts_, state, frame_, A, B, *J);
}

namespace {

Matrix3d inverseInertia(const Matrix3d& inertia) {
  return inertia.isZero() ? Matrix3d(10. * Matrix3d::Identity()) : Matrix3d(inertia.inverse());
}

/// Subtracts seconds (F / m, R I^-1 R^T T) from y, and its Jacobian from J.
void subtractAccelerations(const std::vector<ContactForce>& contacts, const State& state, int frame,
                           const Matrix3d& inverse_inertia, double seconds, Eigen::Ref<VectorXd> y, JacobianRows* J) {
  const double known = state.parameters().frame_mass[frame].mass, mass = known > 0. ? known : 1.;
  const ContactWrench wrench(contacts, state, frame);
  const Matrix3d R = state.pose(frame).R, inverse_inertia_W = R * inverse_inertia * R.transpose();
  y.head<3>() -= seconds / mass * wrench.force;
  y.tail<3>() -= seconds * inverse_inertia_W * wrench.torque;
  if (!J) return;
  Factor A = Factor::Zero(6, 3), B = A, rotation = A;
  A.topRows(3) = -seconds / mass * Matrix3d::Identity();
  B.bottomRows(3) = -seconds * inverse_inertia_W;
  addWrenchJacobian(contacts, state, frame, A, B, *J);
  rotation.bottomRows(3) =
      -seconds * (inverse_inertia_W * skew(wrench.torque) - skew(inverse_inertia_W * wrench.torque));
  state.addJacobian(frame, state.position(frame), Factor(Factor::Zero(6, 3)), rotation, *J);
}

}  // namespace

NewtonEuler::NewtonEuler(int frame, double gravity, const Matrix3d& inertia, std::vector<ContactForce> contacts)
    : frame_(frame),
      flight_(frame, gravity),
      angular_(frame),
      inertia_(inertia),
      inverse_inertia_(inverseInertia(inertia)),
      contacts_(std::move(contacts)) {}

/// Adds I_W^-1 (w x I_W w) tau to y. With w_B = R^T w it is R h(w_B) tau, h(w_B) = I^-1 (w_B x I w_B).
void NewtonEuler::addGyroscopicTerm(std::span<const State* const> states, double tau, Eigen::Ref<VectorXd> y,
                                    JacobianRows* J) const {
  if (inertia_.isZero()) return;
  Vector3d before, after;
  RowMajor J_before, J_after;
  const Eigen::Index n = J ? J->cols() / 3 : 0;
  if (!J) {
    angular_.eval(states.first(2), tau, before, nullptr);
    angular_.eval(states.last(2), tau, after, nullptr);
  } else {
    J_before.setZero(3, 2 * n);
    J_after.setZero(3, 2 * n);
    JacobianRows rows_before(J_before), rows_after(J_after);
    angular_.eval(states.first(2), tau, before, &rows_before);
    angular_.eval(states.last(2), tau, after, &rows_after);
  }
  const Matrix3d R = states[1]->pose(frame_).R;
  const Vector3d w = .5 * (before + after), w_B = R.transpose() * w;
  const Vector3d gyroscopic = R * inverse_inertia_ * w_B.cross(inertia_ * w_B);
  y.tail<3>() += tau * gyroscopic;
  if (!J) return;
  const Matrix3d slope = R * inverse_inertia_ * (skew(w_B) * inertia_ - skew(inertia_ * w_B)) * R.transpose();
  J->block(3, 0, 3, 2 * n) += .5 * tau * slope * J_before;
  J->block(3, n, 3, 2 * n) += .5 * tau * slope * J_after;
  Factor none = Factor::Zero(6, 3), by_rotation = none;
  by_rotation.bottomRows(3) = tau * (slope * skew(w) - skew(gyroscopic));
  states[1]->addJacobian(frame_, states[1]->position(frame_), none, by_rotation, J->middleCols(n, n));
}

void NewtonEuler::eval(std::span<const State* const> states, double tau, Eigen::Ref<VectorXd> y,
                       JacobianRows* J) const {
  flight_.eval(states, tau, y, J);
  addGyroscopicTerm(states, tau, y, J);
  if (!J) return subtractAccelerations(contacts_, *states[1], frame_, inverse_inertia_, tau, y, nullptr);
  const Eigen::Index n = J->cols() / 3;
  JacobianRows middle = J->middleCols(n, n);
  subtractAccelerations(contacts_, *states[1], frame_, inverse_inertia_, tau, y, &middle);
}

DampedMotion::DampedMotion(int frame, double gravity, const Matrix3d& inertia, std::vector<ContactForce> contacts)
    : frame_(frame),
      angular_(frame),
      gravity_(gravity),
      inverse_inertia_(inverseInertia(inertia)),
      contacts_(std::move(contacts)) {}

void DampedMotion::eval(std::span<const State* const> states, double tau, Eigen::Ref<VectorXd> y,
                        JacobianRows* J) const {
  constexpr double kSeconds = .1;  // 1 / d
  const Vector3d before = frameCenterOfMass(*states[0], frame_), now = frameCenterOfMass(*states[1], frame_);
  y.head<3>() = (now - before) / tau;
  y[2] += kSeconds * gravity_;
  Vector3d angular;
  if (!J) {
    angular_.eval(states, tau, angular, nullptr);
    y.tail<3>() = angular;
    return subtractAccelerations(contacts_, *states[1], frame_, inverse_inertia_, kSeconds, y, nullptr);
  }
  const Eigen::Index n = J->cols() / 2;
  states[0]->addPointJacobian(frame_, before, -1. / tau, J->block(0, 0, 3, n));
  states[1]->addPointJacobian(frame_, now, 1. / tau, J->block(0, n, 3, n));
  JacobianRows below = J->bottomRows(3), later = J->rightCols(n);
  angular_.eval(states, tau, angular, &below);
  y.tail<3>() = angular;
  subtractAccelerations(contacts_, *states[1], frame_, inverse_inertia_, kSeconds, y, &later);
}

void TangentialForce::eval(std::span<const State* const> states, double tau, Eigen::Ref<VectorXd> y,
                           JacobianRows* J) const {
  const State& state = *states[0];
  y.setZero();
  for (const ContactForce& contact : contacts_) {
    if (!contact.isIn(state)) continue;
    const double on_a = signFor(contact, state, a_), on_b = signFor(contact, state, b_);
    if (on_a * on_b >= 0.) continue;  // not between the two
    const Vector3d f = on_a * contact.value(state);
    RowMajor Jn;
    const Vector3d n = normalOf(state, a_, b_, tau, J ? &Jn : nullptr);
    y += f - n * n.dot(f);
    if (!J) continue;
    contact.addJacobian(state, on_a * (Matrix3d::Identity() - n * n.transpose()), *J);
    J->leftCols(Jn.cols()) -= (n.dot(f) * Matrix3d::Identity() + n * f.transpose()) * Jn;
  }
}

void FrictionCone::eval(std::span<const State* const> states, double tau, Eigen::Ref<VectorXd> y,
                        JacobianRows* J) const {
  const State& state = *states[0];
  y.setZero();
  if (!contact_.isIn(state)) return;
  RowMajor Jn;
  const Vector3d n = normalOf(state, contact_.object, contact_.from, tau, J ? &Jn : nullptr);
  if (!contact_.is_free) {
    const Vector3d z = state.pose(contact_.point).R.col(2);
    y[0] = std::cos(std::atan(friction_)) - n.dot(z);
    if (!J) return;
    J->leftCols(Jn.cols()) -= z.transpose() * Jn;
    const Eigen::RowVector3d none = Eigen::RowVector3d::Zero(), rotation = n.transpose() * skew(z);
    state.addJacobian(contact_.point, state.position(contact_.point), none, rotation, *J);
    return;
  }
  const Vector3d f = contact_.value(state) / contact_.unit;
  const double normal = n.dot(f), factor = 2. * (1. + friction_ * friction_) * normal;
  y[0] = -normal;
  y[1] = f.squaredNorm() - .5 * factor * normal;
  if (!J) return;
  Factor A(2, 3), B(2, 3);
  A << -n.transpose(), 2. * f.transpose() - factor * n.transpose();
  B << -f.transpose(), -factor * f.transpose();
  contact_.addJacobian(state, A / contact_.unit, *J);
  J->leftCols(Jn.cols()) += B * Jn;
}

void NormalsOppose::eval(std::span<const State* const> states, double tau, Eigen::Ref<VectorXd> y,
                         JacobianRows* J) const {
  RowMajor Ja, Jb;
  y = normalOf(*states[0], a_, point_, tau, J ? &Ja : nullptr) +
      normalOf(*states[0], b_, point_, tau, J ? &Jb : nullptr);
  if (J) J->leftCols(Ja.cols()) += Ja + Jb;
}

void NormalAlignment::eval(std::span<const State* const> states, double tau, Eigen::Ref<VectorXd> y,
                           JacobianRows* J) const {
  const State& state = *states[0];
  RowMajor Jn;
  const Vector3d n = normalOf(state, body_, point_, tau, J ? &Jn : nullptr), z = state.pose(point_).R.col(2);
  y = z - sign_ * n;
  if (!J) return;
  J->leftCols(Jn.cols()) -= sign_ * Jn;
  state.addJacobian(point_, state.position(point_), Factor(Factor::Zero(3, 3)), Factor(-skew(z)), *J);
}

}  // namespace kinegraph::inline features_internal
