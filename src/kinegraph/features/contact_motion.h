#pragma once

#include "kinegraph/features/forces.h"

namespace kinegraph::inline features_internal {

/// Component of a contact force that pulls its two bodies together, with the normal n from `from` to `object`, in units
/// of the force:
///
///     y = -n^T f / unit      1 row; at most 0 if the bodies push each other apart
class PullingForce final : public Feature {
 public:
  explicit PullingForce(const ContactForce& contact) : contact_(contact) {}

  int rows() const override { return 1; }
  void eval(std::span<const State* const> states, double tau, Eigen::Ref<VectorXd> y, JacobianRows* J) const override;

 private:
  ContactForce contact_;
};

/// A contact force, N, in the world: y = f      3 rows; zero in slices without the force.
class ForceValue final : public Feature {
 public:
  explicit ForceValue(const ContactForce& contact) : contact_(contact) {}

  int rows() const override { return 3; }
  void eval(std::span<const State* const> states, double tau, Eigen::Ref<VectorXd> y, JacobianRows* J) const override;

 private:
  ContactForce contact_;
};

/// Velocity of `object` relative to `from` at the point of contact p, over the previous step (m/s). With the bodies'
/// origins o and angular velocities w,
///
///     y = v_object - v_from,  v_b = (o_b(t) - o_b(t-1)) / tau + w_b x (p - o_b(t))      3 rows; zero without sliding
class SlidingVelocity final : public Feature {
 public:
  explicit SlidingVelocity(const ContactForce& contact) : contact_(contact) {}

  int rows() const override { return 3; }
  int order() const override { return 1; }
  void eval(std::span<const State* const> states, double tau, Eigen::Ref<VectorXd> y, JacobianRows* J) const override;

 private:
  ContactForce contact_;
};

/// Newton's law of impact at the point of contact in the middle of three slices. v are the velocities of `object`
/// relative to `from` before and after it, n is the normal (m/s):
///
///     y = n^T (v_after + elasticity v_before)      1 row
class ElasticBounce final : public Feature {
 public:
  ElasticBounce(const ContactForce& contact, double elasticity) : contact_(contact), elasticity_(elasticity) {}

  int rows() const override { return 1; }
  int order() const override { return 2; }
  void eval(std::span<const State* const> states, double tau, Eigen::Ref<VectorXd> y, JacobianRows* J) const override;

 private:
  ContactForce contact_;
  double elasticity_;
};

/// Complementarity of distance and force: zero if bodies at a positive distance d exert no force on each other.
///
///     y = d n^T f / unit      1 row, m
class ForceTimesDistance final : public Feature {
 public:
  explicit ForceTimesDistance(const ContactForce& contact) : contact_(contact) {}

  int rows() const override { return 1; }
  void eval(std::span<const State* const> states, double tau, Eigen::Ref<VectorXd> y, JacobianRows* J) const override;

 private:
  ContactForce contact_;
};

/// Complementarity of velocity and force: zero if bodies that push each other do not separate, v as in SlidingVelocity:
///
///     y = (n^T v) (n^T f) / unit      1 row, m/s
class ForceTimesVelocity final : public Feature {
 public:
  explicit ForceTimesVelocity(const ContactForce& contact) : contact_(contact) {}

  int rows() const override { return 1; }
  int order() const override { return 1; }
  void eval(std::span<const State* const> states, double tau, Eigen::Ref<VectorXd> y, JacobianRows* J) const override;

 private:
  ContactForce contact_;
};

/// Zero if a point is behind the center c of a round object of radius r that moves with the velocity v:
///
///     y = r v / sqrt(|v|^2 + 1e-6) - (c - p)      3 rows, m
class PushRadius final : public Feature {
 public:
  PushRadius(int point, int object, double radius) : point_(point), object_(object), radius_(radius) {}

  int rows() const override { return 3; }
  int order() const override { return 1; }
  void eval(std::span<const State* const> states, double tau, Eigen::Ref<VectorXd> y, JacobianRows* J) const override;

 private:
  int point_, object_;
  double radius_;
};

}  // namespace kinegraph::inline features_internal
