#pragma once

#include <memory>
#include <memory_resource>
#include <optional>
#include <utility>
#include <vector>

#include "kinegraph/geometry/proximity.h"
#include "kinegraph/kinematics/near_pair_search.h"

namespace kinegraph {

/// Pairs of frames with shapes, and each of their bodies once.
struct BodyPairs {
  /// Pairs of frame ids; frames without a shape count as points.
  BodyPairs(const Program& program, const std::vector<std::pair<int, int>>& frame_pairs);

  std::vector<int> frames;                                   ///< ids
  std::vector<std::shared_ptr<const CollisionBody>> bodies;  ///< of those frames
  std::vector<std::pair<int, int>> pairs;                    ///< places in `frames`
  std::vector<double> reach;                                 ///< per pair: sum of the radii of bounding spheres
};

/// The bodies of pairs where a State puts them. Before a pair's exact distance is computed, bounds may show
/// that it is far: those of the bounding spheres, then those of one's sphere and the other one's core.
class PlacedBodies {
 public:
  /// `pairs` must stay. Memory for the poses comes from `memory`.
  explicit PlacedBodies(const BodyPairs& pairs, std::pmr::memory_resource* memory = std::pmr::get_default_resource())
      : pairs_(&pairs), placed_(pairs.frames.size(), memory) {}

  void place(const State& state);

  int pairs() const { return int(pairs_->pairs.size()); }

  Proximity proximity(int pair) const {
    const auto [a, b] = pairs_->pairs[pair];
    return kinegraph::proximity(*pairs_->bodies[a], placed_[a].pose, *pairs_->bodies[b], placed_[b].pose);
  }

  /// May the pair be nearer than `margin`, or that near? False is certain.
  bool mayBeNear(int pair, double margin) const {
    const auto [a, b] = pairs_->pairs[pair];
    const double reach = pairs_->reach[pair] + margin;
    if (reach < 0.) return true;  // a depth that spheres say nothing about
    return (placed_[a].center - placed_[b].center).squaredNorm() <= reach * reach && coresMayBeNear(a, b, margin);
  }

 private:
  bool coresMayBeNear(int a, int b, double margin) const;

  struct Placed {
    Placed() {}  // zeros would be written for nothing

    RigidTransform pose;
    Vector3d center;  ///< of the bounding sphere
  };

  const BodyPairs* pairs_;
  std::pmr::vector<Placed> placed_;
};

/// Distances of all collidable pairs of a scene, with nearest points.
class PairDistances {
 public:
  explicit PairDistances(std::shared_ptr<const Program> program)
      : program_(std::move(program)), pairs_(*program_, program_->collidable()), bodies_(pairs_) {}
  PairDistances(const PairDistances& other) : PairDistances(other.program_) {}

  const std::shared_ptr<const Program>& program() const { return program_; }

  /// Calls visit(i, proximity) for pair i of program()->collidable(), in turn.
  template <class Visit>
  void forAll(const State& state, const Visit& visit) {
    bodies_.place(state);
    for (int pair = 0; pair < bodies_.pairs(); ++pair) visit(pair, bodies_.proximity(pair));
  }

 private:
  std::shared_ptr<const Program> program_;
  BodyPairs pairs_;
  PlacedBodies bodies_;
};

/// The collidable pairs of a scene. Those of few bodies are looked at one by one, those of many by a NearPairSearch; the answers
/// are the same.
class NearPairs {
 public:
  static constexpr std::size_t kFew = 64;  ///< bodies

  explicit NearPairs(std::shared_ptr<const Program> program);
  NearPairs(const NearPairs& other) : NearPairs(other.program_) {}

  /// `state` must stay while this is asked.
  void place(const State& state);

  /// Calls visit(a, b, distance) for the frames of the pairs nearer than `margin`, or that near, by frames.
  template <class Visit>
  void forDistances(double margin, const Visit& visit) {
    if (search_) {
      for (const NearPairSearch::Near& pair : search_->near(margin)) visit(search_->frame(pair.a), search_->frame(pair.b), pair.distance);
      return;
    }
    for (int pair = 0; pair < bodies_->pairs(); ++pair) {
      if (!bodies_->mayBeNear(pair, margin)) continue;
      const double distance = bodies_->proximity(pair).distance;
      const auto [a, b] = program_->collidable()[std::size_t(pair)];
      if (distance <= margin) visit(a, b, distance);
    }
  }

  /// Are all pairs at least `margin` apart? The pair that was too near the last time is looked at first.
  bool apart(double margin);

 private:
  std::shared_ptr<const Program> program_;
  std::optional<NearPairSearch> search_;
  std::optional<BodyPairs> pairs_;
  std::optional<PlacedBodies> bodies_;
  int suspect_ = -1;
};

}  // namespace kinegraph
