#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "kinegraph/collision/near_pairs.h"
#include "kinegraph/features/feature.h"

namespace kinegraph {

/// Which collidable pairs a feature looks at: all of a scene, as it is; or those that joints move apart, which are all
/// that can be asked of q.
enum class PairChoice { scene, motion };

/// The collidable pairs, or those of them that involve one of given frames, where bodies are few. Pairs that no joint
/// moves apart are measured once, until the scene changes.
class CollisionPairs {
 public:
  /// `frames`: empty means all. Pairs count as near below `margin`, m.
  CollisionPairs(const KinematicModel& model, const std::vector<int>& frames, double margin, PairChoice choice);

  int size() const { return int(moving_.size() + fixed_.size()); }

  /// Calls visit(pair, a, b, proximity) for the near pairs; a and b are the frames. For pairs that no joint moves
  /// apart, points and normal are those of the link's own frame.
  template <class Visit>
  void forNear(const State& state, const Visit& visit) const;

 private:
  struct Pair {
    int pair, a, b;
  };
  struct Near : Pair {
    Proximity proximity;
  };
  /// The near ones among the fixed pairs, with these parameters of the scene.
  struct NearFixed {
    std::shared_ptr<const Parameters> parameters;
    std::vector<Near> pairs;
  };
  std::shared_ptr<const NearFixed> nearFixed(const State& state) const;

  double margin_;
  std::vector<int> moving_;  ///< pairs
  std::vector<Pair> fixed_;  ///< both frames are on one link
  BodyPairs moving_bodies_;
  mutable std::mutex mutex_;
  mutable std::shared_ptr<const NearFixed> near_fixed_;
};

/// Sum of the penetration depths of all collidable pairs, or of those that involve one of the given frames; with a
/// margin, of how much they lack to be that far apart:
///     y = sum max(0, margin - distance)      1 row, m
class AccumulatedCollisions final : public Feature {
 public:
  AccumulatedCollisions(const std::vector<int>& frames, const KinematicModel& model, PairChoice choice,
                        double margin = 0.);

  int rows() const override { return 1; }
  void eval(std::span<const State* const> states, double tau, Eigen::Ref<VectorXd> y, JacobianRows* J) const override;

 private:
  /// A search of its own for everyone who evaluates at the same time.
  std::unique_ptr<NearPairSearch> borrow(const State& state) const;

  std::vector<int> frames_;
  PairChoice choice_;
  double margin_;
  std::optional<CollisionPairs> pairs_;  ///< where bodies are few
  mutable std::mutex mutex_;
  mutable std::vector<std::unique_ptr<NearPairSearch>> idle_;
};

/// The same pairs with a row each, so that an optimizer sees which are in trouble:
///     y_i = max(-distance_i, -far)      m, positive where they penetrate
/// Pairs farther apart than that (10 cm) are not looked at any closer. As inequality with target -m it keeps them m apart.
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

}  // namespace kinegraph
