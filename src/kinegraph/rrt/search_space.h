#pragma once

#include <concepts>
#include <optional>
#include <vector>

#include "kinegraph/common/random.h"
#include "kinegraph/math/pose.h"

namespace kinegraph::inline rrt_internal {

/// The configurations that an extension of a tree adds, each reached by a straight edge from the one before.
struct Extension {
  std::vector<VectorXd> points;  ///< empty: the tree cannot be extended
  bool reached = false;          ///< the last point is the target
};

/// A configuration space as RrtConnect and Shortcutter see it: the joint space of a planner (Steering), or the dofs of
/// a KOMO path between two slices (komo/collision/rrt_path).
template <class Space>
concept SearchSpace = requires(Space& space, Rng& rng, const VectorXd& q, VectorXd& changed, const double* values) {
  /// Extensions are continuously collision-free. If false, edges are verified only on a candidate path (lazily).
  { Space::kVerifiesExtensions } -> std::convertible_to<bool>;
  { space.dofs() } -> std::convertible_to<int>;
  { space.squaredDistance(values, values) } -> std::convertible_to<double>;
  /// from + difference(from, to) is `to`, or the same configuration by other numbers, as an angle by whole rotations.
  { space.difference(q, q) } -> std::convertible_to<VectorXd>;
  /// Maps endless angles and quaternions to their standard range.
  space.normalize(changed);
  /// A uniform sample; dofs that are not sampled are as in q. None if it cannot be projected onto the constraints.
  { space.sample(rng, q) } -> std::same_as<std::optional<VectorXd>>;
  /// A sample at most a radius away from q.
  { space.sampleNear(rng, q, 1.) } -> std::same_as<std::optional<VectorXd>>;
  /// Goes from q towards a target by at most a range.
  { space.extend(q, q, 1.) } -> std::same_as<Extension>;
  /// Whether the straight edge is continuously collision-free.
  { space.isEdgeFree(q, q) } -> std::convertible_to<bool>;
  /// The configurations between two such that all edges are valid: none if the straight edge is; nullopt if it fails.
  { space.connect(q, q) } -> std::same_as<std::optional<std::vector<VectorXd>>>;
  /// Paths run on a manifold, so that edges are not straight.
  { space.isConstrained() } -> std::convertible_to<bool>;
  /// Collision and constraint checks so far.
  { space.evaluations() } -> std::convertible_to<long>;
};

}  // namespace kinegraph::inline rrt_internal
