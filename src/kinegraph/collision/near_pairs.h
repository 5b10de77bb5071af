#pragma once

#include <memory>
#include <memory_resource>
#include <optional>
#include <utility>
#include <vector>

#include "kinegraph/collision/near_pair_search.h"
#include "kinegraph/geometry/distance/proximity.h"

namespace kinegraph::inline collision_internal {

/// Pairs of frames with shapes, with every body once.
struct BodyPairs {
  /// Takes pairs of frame ids; frames without a shape count as points.
  BodyPairs(const KinematicModel& model, const std::vector<std::pair<int, int>>& frame_pairs);

  std::vector<int> frames;                                   ///< ids
  std::vector<std::shared_ptr<const CollisionBody>> bodies;  ///< of those frames
  std::vector<std::pair<int, int>> pairs;                    ///< indices into `frames`
  std::vector<double> reach;                                 ///< per pair: sum of the radii of the bounding spheres, m
};

/// The bodies of pairs at their poses in a State. Bounds exclude far pairs before exact distances are computed: those
/// of the bounding spheres, then those of one body's sphere and the other one's core.
class PlacedBodies {
 public:
  /// `pairs` must outlive it. Memory for the poses comes from `memory`.
  explicit PlacedBodies(const BodyPairs& pairs, std::pmr::memory_resource* memory = std::pmr::get_default_resource())
      : pairs_(&pairs), poses_(pairs.frames.size(), memory), centers_(pairs.frames.size(), memory) {}

  void place(const State& state);

  int pairs() const { return int(pairs_->pairs.size()); }

  Proximity proximity(int pair) const {
    const auto [a, b] = pairs_->pairs[pair];
    return kinegraph::proximity(*pairs_->bodies[a], poses_[a], *pairs_->bodies[b], poses_[b]);
  }

  /// False only if the pair is certainly farther apart than `margin`.
  bool mayBeNear(int pair, double margin) const {
    const auto [a, b] = pairs_->pairs[pair];
    const double reach = pairs_->reach[pair] + margin;
    if (reach < 0.) return true;  // spheres do not bound penetration depths
    return (centers_[a] - centers_[b]).squaredNorm() <= reach * reach && coresMayBeNear(a, b, margin);
  }

  /// Calls visit(pair) for all pairs for which mayBeNear is true.
  template <class Visit>
  void forMaybeNear(double margin, const Visit& visit) const {
    const std::pair<int, int>* pairs = pairs_->pairs.data();
    const double* reaches = pairs_->reach.data();
    const Center* centers = centers_.data();
    for (int pair = 0, count = this->pairs(); pair < count; ++pair) {
      const Vector3d &a = centers[pairs[pair].first], &b = centers[pairs[pair].second];
      const double x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2], reach = reaches[pair] + margin;
      const bool spheres_are_far = x * x + y * y + z * z > reach * reach && reach >= 0.;
      if (!spheres_are_far && (reach < 0. || coresMayBeNear(pairs[pair].first, pairs[pair].second, margin)))
        visit(pair);
    }
  }

 private:
  bool coresMayBeNear(int a, int b, double margin) const;

  /// Not initialized, to save time.
  struct Placed : RigidTransform {
    Placed() {}
  };
  struct Center : Vector3d {
    Center() {}
  };

  const BodyPairs* pairs_;
  std::pmr::vector<Placed> poses_;
  std::pmr::vector<Center> centers_;  ///< of the bounding spheres
};

/// Distances and witness points of all collidable pairs of a scene.
class PairDistances {
 public:
  explicit PairDistances(std::shared_ptr<const KinematicModel> model)
      : model_(std::move(model)), pairs_(*model_, model_->collidable()), bodies_(pairs_) {}
  PairDistances(const PairDistances& other) : PairDistances(other.model_) {}

  const std::shared_ptr<const KinematicModel>& model() const { return model_; }

  /// Calls visit(i, proximity) for pair i of model()->collidable(), in order.
  template <class Visit>
  void forAll(const State& state, const Visit& visit) {
    bodies_.place(state);
    for (int pair = 0; pair < bodies_.pairs(); ++pair) visit(pair, bodies_.proximity(pair));
  }

 private:
  std::shared_ptr<const KinematicModel> model_;
  BodyPairs pairs_;
  PlacedBodies bodies_;
};

/// The near collidable pairs of a scene. Checks the pairs of few bodies one by one, and those of many by a
/// NearPairSearch, with equal results.
class NearPairs {
 public:
  static constexpr std::size_t kFew = 64;  ///< bodies

  explicit NearPairs(std::shared_ptr<const KinematicModel> model);
  NearPairs(const NearPairs& other) : NearPairs(other.model_) {}

  /// `state` must outlive the following calls.
  void place(const State& state);

  /// Calls visit(a, b, distance) for the pairs of frames at a distance of at most `margin`, ordered by frames.
  template <class Visit>
  void forDistances(double margin, const Visit& visit) {
    if (search_) {
      for (const NearPairSearch::Near& pair : search_->near(margin))
        visit(search_->frame(pair.a), search_->frame(pair.b), pair.distance);
      return;
    }
    bodies_->forMaybeNear(margin, [&](int pair) {
      const double distance = bodies_->proximity(pair).distance;
      const auto [a, b] = model_->collidable()[std::size_t(pair)];
      if (distance <= margin) visit(a, b, distance);
    });
  }

  /// Whether all pairs that joints move apart are at least `margin` apart. Checks the pair that was too close the last
  /// time first.
  bool apart(double margin);

 private:
  std::shared_ptr<const KinematicModel> model_;
  std::optional<NearPairSearch> search_;
  std::optional<BodyPairs> pairs_;
  std::optional<PlacedBodies> bodies_;
  int suspect_ = -1;
};

}  // namespace kinegraph::inline collision_internal
