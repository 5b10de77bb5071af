#include "kinegraph/komo/collision/sampled_pairs.h"

#include <algorithm>

namespace kinegraph::inline komo_internal {

namespace {

/// Returns true if the bounding spheres prove that two bodies are farther apart than `max_distance`.
bool areFar(const CollisionBody& a, const RigidTransform& X_WA, const CollisionBody& b, const RigidTransform& X_WB,
            double max_distance) {
  const double reach = a.boundRadius() + b.boundRadius() + max_distance;
  return reach >= 0. && (X_WA * a.boundCenter() - X_WB * b.boundCenter()).squaredNorm() > reach * reach;
}

}  // namespace

SampledPairs::SampledPairs(std::vector<CollisionSample> samples, double max_distance, const State& scene)
    : samples_(std::move(samples)),
      max_distance_(max_distance),
      state_(scene),
      q_(scene.dofs()),
      gradient_(1, scene.dofs()) {
  for (std::size_t i = 0; i < samples_.size(); ++i)
    if (!samples_[i].isEmpty()) in_order_.push_back(int(i));
  std::ranges::stable_sort(in_order_, {}, [&](int i) { return samples_[std::size_t(i)].time; });
}

bool SampledPairs::isNear(const CollisionSample& sample, bool with_gradient, double& distance) {
  const auto& [time, a, b] = sample;
  const CollisionBody &body_a = *state_.model().body[std::size_t(a)], &body_b = *state_.model().body[std::size_t(b)];
  const RigidTransform X_WA = state_.pose(a), X_WB = state_.pose(b);
  if (areFar(body_a, X_WA, body_b, X_WB, max_distance_)) return false;
  const Proximity near = proximity(body_a, X_WA, body_b, X_WB);
  distance = near.distance;
  if (distance >= max_distance_) return false;
  if (!with_gradient) return true;
  gradient_.setZero();
  JacobianRows gradient = gradient_;
  addDistanceGradient(state_, a, b, near, 1., gradient);
  return true;
}

}  // namespace kinegraph::inline komo_internal
