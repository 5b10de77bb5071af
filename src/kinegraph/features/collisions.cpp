#include "kinegraph/features/collisions.h"

#include <algorithm>
#include <array>

#include "kinegraph/features/distance.h"

namespace kinegraph::inline features_internal {

namespace {

std::vector<std::pair<int, int>> pairsOf(const KinematicModel& model, const std::vector<int>& frames,
                                         PairChoice choice) {
  const auto is_listed = [&](int frame) { return std::find(frames.begin(), frames.end(), frame) != frames.end(); };
  std::vector<std::pair<int, int>> pairs;
  for (const auto& pair : model.collidable()) {
    if (choice == PairChoice::motion && !model.movesApart(pair.first, pair.second)) continue;
    if (frames.empty() || is_listed(pair.first) || is_listed(pair.second)) pairs.push_back(pair);
  }
  return pairs;
}

/// Calls visit(place, a, b, proximity) for the pairs closer than `margin`.
template <class Visit>
void forNearOf(const BodyPairs& pairs, const State& state, double margin, const Visit& visit) {
  std::array<std::byte, 16384> buffer;  // holds a hundred bodies without allocation
  std::pmr::monotonic_buffer_resource memory(buffer.data(), buffer.size());
  PlacedBodies bodies(pairs, &memory);
  bodies.place(state);
  bodies.forMaybeNear(margin, [&](int place) {
    const Proximity near = bodies.proximity(place);
    if (near.distance < margin)
      visit(place, pairs.frames[pairs.pairs[place].first], pairs.frames[pairs.pairs[place].second], near);
  });
}

}  // namespace

CollisionPairs::CollisionPairs(const KinematicModel& model, const std::vector<int>& frames, double margin,
                               PairChoice choice)
    : margin_(margin), moving_bodies_(model, {}) {
  const std::vector<std::pair<int, int>> pairs = pairsOf(model, frames, choice);
  std::vector<std::pair<int, int>> moving;
  for (int pair = 0; pair < int(pairs.size()); ++pair) {
    const auto [a, b] = pairs[std::size_t(pair)];
    if (model.movesApart(a, b)) {
      moving_.push_back(pair);
      moving.emplace_back(a, b);
    } else {
      fixed_.push_back({pair, a, b});
    }
  }
  moving_bodies_ = BodyPairs(model, moving);
}

std::shared_ptr<const CollisionPairs::NearFixed> CollisionPairs::nearFixed(const State& state) const {
  const std::lock_guard lock(mutex_);
  if (near_fixed_ && near_fixed_->parameters == state.sharedParameters()) return near_fixed_;
  auto found = std::make_shared<NearFixed>();
  found->parameters = state.sharedParameters();
  for (const Pair& pair : fixed_) {
    const CollisionBody &a = *state.model().body[pair.a], &b = *state.model().body[pair.b];
    const RigidTransform &X_LA = state.parameters().frame_offset[pair.a],
                         &X_LB = state.parameters().frame_offset[pair.b];
    const double reach = a.boundRadius() + b.boundRadius() + margin_;
    if ((X_LA * a.boundCenter() - X_LB * b.boundCenter()).squaredNorm() > reach * reach) continue;
    const Proximity near = proximity(a, X_LA, b, X_LB);
    if (near.distance < margin_) found->pairs.push_back({pair, near});
  }
  near_fixed_ = found;
  return found;
}

template <class Visit>
void CollisionPairs::forNear(const State& state, const Visit& visit) const {
  if (!fixed_.empty()) {
    for (const Near& near : nearFixed(state)->pairs) visit(near.pair, near.a, near.b, near.proximity);
  }
  forNearOf(moving_bodies_, state, margin_,
            [&](int place, int a, int b, const Proximity& near) { visit(moving_[std::size_t(place)], a, b, near); });
}

AccumulatedCollisions::AccumulatedCollisions(const std::vector<int>& frames, const KinematicModel& model,
                                             PairChoice choice, double margin)
    : frames_(frames), choice_(choice), margin_(margin) {
  if (model.contacts.bodies.size() <= NearPairs::kFew) pairs_.emplace(model, frames, margin, choice);
}

std::unique_ptr<NearPairSearch> AccumulatedCollisions::borrow(const State& state) const {
  const std::lock_guard lock(mutex_);
  if (idle_.empty()) return std::make_unique<NearPairSearch>(state.sharedModel(), frames_);
  std::unique_ptr<NearPairSearch> search = std::move(idle_.back());
  idle_.pop_back();
  return search;
}

void AccumulatedCollisions::eval(std::span<const State* const> states, double, Eigen::Ref<VectorXd> y,
                                 JacobianRows* J) const {
  const State& state = *states[0];
  y[0] = 0.;
  const auto add = [&](int a, int b, const Proximity& near) {
    y[0] += margin_ - near.distance;
    if (J) addDistanceGradient(state, a, b, near, -1., *J);
  };
  if (pairs_) {
    pairs_->forNear(state, [&](int, int a, int b, const Proximity& near) { add(a, b, near); });
    return;
  }
  std::unique_ptr<NearPairSearch> search = borrow(state);
  search->place(state);
  for (const NearPairSearch::Near& pair : search->near(margin_)) {
    const int a = search->frame(pair.a), b = search->frame(pair.b);
    if (choice_ == PairChoice::scene || state.model().movesApart(a, b)) add(a, b, search->proximity(pair));
  }
  const std::lock_guard lock(mutex_);
  idle_.push_back(std::move(search));
}

void PairCollisions::eval(std::span<const State* const> states, double, Eigen::Ref<VectorXd> y, JacobianRows* J) const {
  const State& state = *states[0];
  y.setConstant(-far_);
  pairs_.forNear(state, [&](int pair, int a, int b, const Proximity& near) {
    y[pair] = -near.distance;
    if (!J) return;
    JacobianRows row = J->middleRows(pair, 1);
    addDistanceGradient(state, a, b, near, -1., row);
  });
}

}  // namespace kinegraph::inline features_internal
