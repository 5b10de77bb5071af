#include "kinegraph/komo/collision/sampled_pairs.h"

#include <algorithm>

namespace kinegraph {

namespace {

/// Do the spheres around two bodies show that they are that far apart?
bool areFar(const CollisionBody& a, const RigidTransform& X_WA, const CollisionBody& b, const RigidTransform& X_WB,
            double most) {
  const double reach = a.boundRadius() + b.boundRadius() + most;
  return reach >= 0. && (X_WA * a.boundCenter() - X_WB * b.boundCenter()).squaredNorm() > reach * reach;
}

}  // namespace

SampledPairs::SampledPairs(std::vector<CollisionSample> samples, double most, const State& scene)
    : samples_(std::move(samples)), most_(most), state_(scene), q_(scene.dofs()), gradient_(1, scene.dofs()) {
  for (std::size_t i = 0; i < samples_.size(); ++i)
    if (!samples_[i].isEmpty()) in_order_.push_back(int(i));
  std::ranges::stable_sort(in_order_, {}, [&](int i) { return samples_[std::size_t(i)].share; });
}

bool SampledPairs::isNear(const CollisionSample& sample, bool with_gradient, double& distance) {
  const auto& [share, a, b] = sample;
  const CollisionBody &body_a = *state_.model().body[std::size_t(a)], &body_b = *state_.model().body[std::size_t(b)];
  const RigidTransform X_WA = state_.pose(a), X_WB = state_.pose(b);
  if (areFar(body_a, X_WA, body_b, X_WB, most_)) return false;
  const Proximity near = proximity(body_a, X_WA, body_b, X_WB);
  distance = near.distance;
  if (distance >= most_) return false;
  if (!with_gradient) return true;
  gradient_.setZero();
  JacobianRows gradient = gradient_;
  addDistanceGradient(state_, a, b, near, 1., gradient);
  return true;
}

}  // namespace kinegraph
