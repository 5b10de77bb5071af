#pragma once

#include <vector>

#include "kinegraph/features/feature.h"
#include "kinegraph/features/masses.h"

namespace kinegraph::inline features_internal {

/// A force between two frames in a trajectory optimization problem. It acts on `object` at the origin of the frame
/// `point`, and the opposite force acts on `from`. The joint of the auxiliary frame `dofs` holds its magnitude.
struct ContactForce {
  int object = -1, from = -1, point = -1, dofs = -1;
  double unit = 1.;      ///< N per unit of its dofs
  bool is_free = false;  ///< three dofs, along the world axes; otherwise one, along the z axis of `point`

  bool isIn(const State& state) const { return state.model().frame_dofs[dofs].count > 0; }
  Vector3d value(const State& state) const;  ///< N, in the world; zero if the state does not have this force

  using Factor = Eigen::Matrix<double, Eigen::Dynamic, 3, 0, 6, 3>;  ///< at most 6 rows

  /// J += A df/dq.
  void addJacobian(const State& state, const Factor& A, JacobianRows J) const;
};

/// Weight minus contact forces on a body, and the torque of these forces about its center of mass c (N, N m):
///
///     y = (m g e_z - sum f_i,  sum (p_i - c) x f_i)      6 rows; zero in static equilibrium
///
/// Forces on rigidly connected frames count, too. Throws ValueError for a body without a mass.
class TotalForce final : public Feature {
 public:
  TotalForce(int frame, std::vector<ContactForce> contacts) : frame_(frame), contacts_(std::move(contacts)) {}

  int rows() const override { return 6; }
  void eval(std::span<const State* const> states, double tau, Eigen::Ref<VectorXd> y, JacobianRows* J) const override;

 private:
  int frame_;
  std::vector<ContactForce> contacts_;
};

/// Newton-Euler equations over one step, with the contact forces F and torques T (about the center of mass) of the
/// middle slice (m/s and rad/s):
///
///     y = (v_t - v_{t-1} + (0, 0, g) tau - F tau / m,  w_t - w_{t-1} - I_W^-1 (T - w x I_W w) tau)      6 rows
///
/// with I_W = R I R^T in the middle slice, and w the mean of both angular velocities. Missing masses count as 1 kg,
/// missing inertias as 0.1 kg m^2.
class NewtonEuler final : public Feature {
 public:
  NewtonEuler(int frame, double gravity, const Matrix3d& inertia, std::vector<ContactForce> contacts);

  int rows() const override { return 6; }
  int order() const override { return 2; }
  void eval(std::span<const State* const> states, double tau, Eigen::Ref<VectorXd> y, JacobianRows* J) const override;

 private:
  void addGyroscopicTerm(std::span<const State* const> states, double tau, Eigen::Ref<VectorXd> y,
                         JacobianRows* J) const;

  int frame_;
  FreeFlight flight_;
  AngularVelocity angular_;
  Matrix3d inertia_, inverse_inertia_;
  std::vector<ContactForce> contacts_;
};

/// Quasi-static motion: forces balance a friction proportional to the velocity. F and T are the contact forces and
/// torques of the later slice (m/s and rad/s), d = 10/s:
///
///     y = (v + ((0, 0, g) - F / m) / d,  w - R I^-1 R^T T / d)      6 rows
///
/// Zero for a body at rest without forces. Missing masses count as 1 kg, missing inertias as 0.1 kg m^2.
class DampedMotion final : public Feature {
 public:
  DampedMotion(int frame, double gravity, const Matrix3d& inertia, std::vector<ContactForce> contacts);

  int rows() const override { return 6; }
  int order() const override { return 1; }
  void eval(std::span<const State* const> states, double tau, Eigen::Ref<VectorXd> y, JacobianRows* J) const override;

 private:
  int frame_;
  AngularVelocity angular_;
  double gravity_;  ///< m/s^2
  Matrix3d inverse_inertia_;
  std::vector<ContactForce> contacts_;
};

/// Tangential part of a contact force, with the normal n between its bodies: y = f - n n^T f      3 rows, N
///
/// Zero if there is no such force.
class TangentialForce final : public Feature {
 public:
  TangentialForce(int a, int b, std::vector<ContactForce> contacts) : a_(a), b_(b), contacts_(std::move(contacts)) {}

  int rows() const override { return 3; }
  void eval(std::span<const State* const> states, double tau, Eigen::Ref<VectorXd> y, JacobianRows* J) const override;

 private:
  int a_, b_;
  std::vector<ContactForce> contacts_;
};

/// Friction cone: all rows are at most 0 if the force pushes the object away from the other body and stays within the
/// cone, with the normal n:
///
///     one dof:  y = cos(atan mu) - n^T z                                       1 row
///     free:     y = (-n^T f,  (|f|^2 - (1 + mu^2) (n^T f)^2) / unit) / unit    2 rows
class FrictionCone final : public Feature {
 public:
  FrictionCone(const ContactForce& contact, double friction) : contact_(contact), friction_(friction) {}

  int rows() const override { return contact_.is_free ? 2 : 1; }
  void eval(std::span<const State* const> states, double tau, Eigen::Ref<VectorXd> y, JacobianRows* J) const override;

 private:
  ContactForce contact_;
  double friction_;
};

/// Zero if a point lies between two surfaces that face each other: y = n(a, p) + n(b, p)      3 rows
class NormalsOppose final : public Feature {
 public:
  NormalsOppose(int a, int b, int point) : a_(a), b_(b), point_(point) {}

  int rows() const override { return 3; }
  void eval(std::span<const State* const> states, double tau, Eigen::Ref<VectorXd> y, JacobianRows* J) const override;

 private:
  int a_, b_, point_;
};

/// Zero if the z axis of a point's frame is the direction to a body, or with sign -1 the direction from it:
///
///     y = z - sign n(body, p)      3 rows
class NormalAlignment final : public Feature {
 public:
  NormalAlignment(int point, int body, double sign) : point_(point), body_(body), sign_(sign) {}

  int rows() const override { return 3; }
  void eval(std::span<const State* const> states, double tau, Eigen::Ref<VectorXd> y, JacobianRows* J) const override;

 private:
  int point_, body_;
  double sign_;
};

}  // namespace kinegraph::inline features_internal
