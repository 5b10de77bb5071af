#pragma once

#include <memory>
#include <mutex>
#include <vector>

#include "kinegraph/features/feature.h"
#include "kinegraph/kinematics/near_pairs.h"

namespace kinegraph {

/// The negative distance of two shapes: y = -(signed gap), positive where they penetrate; J = -n^T (Jp_A - Jp_B) at the
/// witness points. Frames without a shape count as points.
class NegDistance final : public Feature {
 public:
  NegDistance(int a, int b) : a_(a), b_(b) {}

  int rows() const override { return 1; }
  void eval(std::span<const State* const> states, double tau, Eigen::Ref<VectorXd> y, JacobianRows* J) const override;

 private:
  int a_, b_;
};

/// What the witness points of two shapes give, in the world. The Jacobian is that of the relative motion of the shapes, by
/// central differences of the distance computation (step 1e-6), and of the motion of both together, in closed form. Where
/// the nearest features switch it is a one-sided derivative.
class Witness final : public Feature {
 public:
  enum class Kind {
    vector,       ///< point_a - point_b on the surfaces, m
    normal,       ///< unit, from B to A
    point_a,      ///< m
    point_b,      ///< m
    core_vector,  ///< core_a - core_b, radii neglected, m
  };
  Witness(Kind kind, int a, int b) : kind_(kind), a_(a), b_(b) {}

  int rows() const override { return 3; }
  void eval(std::span<const State* const> states, double tau, Eigen::Ref<VectorXd> y, JacobianRows* J) const override;

 private:
  Vector3d value(const Proximity& near) const;

  Kind kind_;
  int a_, b_;
};

/// Two fingers on opposite sides of an object, v_i = core witness vector from object to finger i:
///     y = v_1 + v_2                                                              3 rows, m
///     central: below it, 0.01 (2 p + n_1 - n_2), p the direction from finger 1 to finger 2, n_i that of v_i    6 rows
class Oppose final : public Feature {
 public:
  Oppose(int finger1, int finger2, int object, bool central)
      : finger1_(finger1), finger2_(finger2), first_(Witness::Kind::core_vector, finger1, object),
        second_(Witness::Kind::core_vector, finger2, object), central_(central) {}

  int rows() const override { return central_ ? 6 : 3; }
  void eval(std::span<const State* const> states, double tau, Eigen::Ref<VectorXd> y, JacobianRows* J) const override;

 private:
  int finger1_, finger2_;
  Witness first_, second_;
  bool central_;
};

/// The collidable pairs, or those of them that involve one of the given frames.
BodyPairs pairsWith(const Program& program, const std::vector<int>& frames);

/// Sum of the penetration depths of all collidable pairs, or of those that involve one of the given frames:
///     y = sum max(0, -distance)      1 row, m
class AccumulatedCollisions final : public Feature {
 public:
  AccumulatedCollisions(const std::vector<int>& frames, const Program& program);

  int rows() const override { return 1; }
  void eval(std::span<const State* const> states, double tau, Eigen::Ref<VectorXd> y, JacobianRows* J) const override;

 private:
  /// A search of its own for everyone who evaluates at the same time.
  std::unique_ptr<NearPairSearch> borrow(const State& state) const;

  std::vector<int> frames_;
  std::optional<BodyPairs> pairs_;  ///< where bodies are few
  mutable std::mutex mutex_;
  mutable std::vector<std::unique_ptr<NearPairSearch>> idle_;
};

/// The same pairs with a row each, so that an optimizer sees which are in trouble:
///     y_i = max(-distance_i, -0.1 m)      m, positive where they penetrate
/// Pairs farther apart than that are not looked at any closer. As inequality with target -m it keeps them m apart.
class PairCollisions final : public Feature {
 public:
  static constexpr double kFar = .1;  ///< m

  PairCollisions(const std::vector<int>& frames, const Program& program) : pairs_(pairsWith(program, frames)) {}

  int rows() const override { return int(pairs_.pairs.size()); }
  std::optional<double> flatValue() const override { return -kFar; }
  void eval(std::span<const State* const> states, double tau, Eigen::Ref<VectorXd> y, JacobianRows* J) const override;

 private:
  BodyPairs pairs_;
};

}  // namespace kinegraph
