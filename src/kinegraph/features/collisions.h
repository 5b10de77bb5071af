#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "kinegraph/collision/near_pairs.h"
#include "kinegraph/features/feature.h"

namespace kinegraph::inline features_internal {

/// The collidable pairs that a feature considers: all pairs of the scene, or only pairs that joints move relative to
/// each other, since q influences no others.
enum class PairChoice { scene, motion };

/// The collidable pairs, or those that involve one of given frames, for scenes with few bodies. Pairs that no joint
/// separates are measured once, until the scene changes.
class CollisionPairs {
 public:
  /// Empty `frames` means all. Pairs closer than `margin` (m) are near.
  CollisionPairs(const KinematicModel& model, const std::vector<int>& frames, double margin, PairChoice choice);

  int size() const { return int(moving_.size() + fixed_.size()); }

  /// Calls visit(pair, a, b, proximity) for the near pairs; a and b are the frames. For pairs that no joint separates,
  /// points and normal are in the coordinates of their link.
  template <class Visit>
  void forNear(const State& state, const Visit& visit) const;

 private:
  struct Pair {
    int pair, a, b;
  };
  struct Near : Pair {
    Proximity proximity;
  };
  /// The near fixed pairs for certain parameters of the scene.
  struct NearFixed {
    std::shared_ptr<const Parameters> parameters;
    std::vector<Near> pairs;
  };
  std::shared_ptr<const NearFixed> nearFixed(const State& state) const;

  double margin_;
  std::vector<int> moving_;  ///< indices of pairs
  std::vector<Pair> fixed_;  ///< both frames belong to the same link
  BodyPairs moving_bodies_;
  mutable std::mutex mutex_;
  mutable std::shared_ptr<const NearFixed> near_fixed_;
};

/// Sum of the penetration depths of all collidable pairs, or of those that involve one of the given frames. With a
/// margin, closer pairs count as penetrating:
///
///     y = sum max(0, margin - distance)      1 row, m
class AccumulatedCollisions final : public Feature {
 public:
  AccumulatedCollisions(const std::vector<int>& frames, const KinematicModel& model, PairChoice choice,
                        double margin = 0.);

  int rows() const override { return 1; }
  void eval(std::span<const State* const> states, double tau, Eigen::Ref<VectorXd> y, JacobianRows* J) const override;

 private:
  /// Returns a search for exclusive use, since several threads may evaluate at the same time.
  std::unique_ptr<NearPairSearch> borrow(const State& state) const;

  std::vector<int> frames_;
  PairChoice choice_;
  double margin_;
  std::optional<CollisionPairs> pairs_;  ///< for scenes with few bodies
  mutable std::mutex mutex_;
  mutable std::vector<std::unique_ptr<NearPairSearch>> idle_;
};

/// Penetration depths of the same pairs, one row each, so that an optimizer can treat the pairs separately:
///
///     y_i = max(-distance_i, -far)      m, positive in penetration
///
/// Pairs farther apart than `far` are not measured exactly. As an inequality with target -m it keeps the pairs m apart.
class PairCollisions final : public Feature {
 public:
  static constexpr double kFar = .1;  ///< m

  PairCollisions(const std::vector<int>& frames, const KinematicModel& model, PairChoice choice, double far = kFar)
      : far_(far), pairs_(model, frames, far, choice) {}

  int rows() const override { return pairs_.size(); }
  std::optional<double> flatValue() const override { return -far_; }
  void eval(std::span<const State* const> states, double tau, Eigen::Ref<VectorXd> y, JacobianRows* J) const override;

 private:
  double far_;
  CollisionPairs pairs_;
};

}  // namespace kinegraph::inline features_internal
