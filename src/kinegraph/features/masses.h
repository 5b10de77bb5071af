#pragma once

#include <vector>

#include "kinegraph/features/feature.h"
#include "kinegraph/features/velocity.h"

namespace kinegraph::inline features_internal {

/// Energy of frames as point masses at their centers of mass c_i, between two configurations (J):
///
///     y = sum m_i/2 |(c_i(t) - c_i(t-1)) / tau|^2 + 9.81 m_i z_i(t)      1 row
///
/// Rotational energy is neglected; a frame without a mass counts as 1 kg at its origin.
class Energy final : public Feature {
 public:
  explicit Energy(std::vector<int> frames) : frames_(std::move(frames)) {}

  int rows() const override { return 1; }
  int order() const override { return 1; }
  void eval(std::span<const State* const> states, double tau, Eigen::Ref<VectorXd> y, JacobianRows* J) const override;

 private:
  std::vector<int> frames_;
};

/// Common center of mass of frames, in the world:
///
///     y = sum m_i c_i / sum m_i      3 rows, m
///
/// Without frames it is that of everything that moves. Evaluation throws ValueError if none of them has a mass.
class CenterOfMass final : public Feature {
 public:
  explicit CenterOfMass(std::vector<int> frames) : frames_(std::move(frames)) {}

  int rows() const override { return 3; }
  void eval(std::span<const State* const> states, double tau, Eigen::Ref<VectorXd> y, JacobianRows* J) const override;

 private:
  std::vector<int> frames_;
};

/// Position of a frame relative to the common center of mass of other frames, in the world:
///
///     y = p_F - sum m_i c_i / sum m_i      3 rows, m
///
/// Without other frames it is the center of everything that moves. Evaluation throws ValueError if none of them has a
/// mass.
class CenterOfMassOffset final : public Feature {
 public:
  CenterOfMassOffset(int frame, std::vector<int> others) : frame_(frame), others_(std::move(others)) {}

  int rows() const override { return 3; }
  void eval(std::span<const State* const> states, double tau, Eigen::Ref<VectorXd> y, JacobianRows* J) const override;

 private:
  int frame_;
  std::vector<int> others_;
};

/// Change of a frame's velocity minus that of free fall, over one step (impulse per mass, m/s and rad/s):
///
///     y = (v_t - v_{t-1} + (0, 0, g) tau,  w_t - w_{t-1})      6 rows; zero in free flight
///
/// v is the velocity of its center of mass. With g = 0 it is zero for a body that slides without friction.
class FreeFlight final : public Feature {
 public:
  FreeFlight(int frame, double gravity) : frame_(frame), angular_(frame), gravity_(gravity) {}

  int rows() const override { return 6; }
  int order() const override { return 2; }
  void eval(std::span<const State* const> states, double tau, Eigen::Ref<VectorXd> y, JacobianRows* J) const override;

 private:
  int frame_;
  AngularVelocity angular_;
  double gravity_;  ///< m/s^2
};

}  // namespace kinegraph::inline features_internal
