#pragma once

#include "kinegraph/planning/steering/clearance_check.h"
#include "kinegraph/planning/steering/manifold.h"
#include "kinegraph/rrt/search_space.h"

namespace kinegraph::inline planning_internal {

/// The constraints that a motion has to satisfy: one value for all threads.
struct PlanningConstraints {
  const State* scene;       ///< any State of the scene; must outlive its users
  const JointSpace* space;  ///< must outlive its users
  Clearance clearance = {};
  std::vector<MotionConstraint> constraints = {};
  double constraint_tolerance = 1e-3;  ///< of each constraint row, in its own unit
};

/// The search space of the planners (SearchSpace): samples, distances, and checked connections of configurations.
/// Unconstrained connections are straight edges; under constraints they are short edges along the manifold. Every
/// thread has its own.
class Steering {
 public:
  static constexpr bool kVerifiesExtensions = false;
  static constexpr double kSpacing = .02;  ///< between configurations at which constraints are evaluated first

  explicit Steering(const PlanningConstraints& constraints)
      : check_(*constraints.scene, *constraints.space, constraints.clearance),
        manifold_(*constraints.scene, *constraints.space, constraints.constraints, constraints.constraint_tolerance) {}

  const JointSpace& space() const { return check_.space(); }
  ClearanceCheck& check() { return check_; }
  Manifold& manifold() { return manifold_; }
  bool isConstrained() const { return !manifold_.isEmpty(); }

  /// Evaluations of the collision check and of the constraints so far; budgets count them.
  long evaluations() const { return check_.evaluations + manifold_.evaluations; }

  int dofs() const { return space().dofs(); }
  double squaredDistance(const double* a, const double* b) const { return space().squaredDistance(a, b); }
  VectorXd difference(const VectorXd& from, const VectorXd& to) const { return space().difference(from, to); }
  void normalize(VectorXd& q) const { space().normalize(q); }

  /// Samples uniformly, and projects onto the constraints. None if the projection fails.
  std::optional<VectorXd> sample(Rng& rng, const VectorXd& like);

  /// Samples at most `radius` away from a configuration.
  std::optional<VectorXd> sampleNear(Rng& rng, const VectorXd& center, double radius);

  /// Extends from a configuration towards `target` by at most `range`. Edges are checked at samples only.
  Extension extend(const VectorXd& from, const VectorXd& target, double range);

  /// Whether the straight edge is continuously collision-free. Does not evaluate constraints.
  bool isEdgeFree(const VectorXd& from, const VectorXd& to) { return check_.isMotionFree(from, to); }

  /// Whether the straight edge is continuously collision-free and satisfies the constraints (Manifold::holdsAlong).
  bool isFree(const VectorXd& from, const VectorXd& to);

  /// Connects two configurations, and returns those between them: none if the straight edge is valid, else
  /// configurations on the manifold. All edges are continuously collision-free. None if it fails.
  std::optional<std::vector<VectorXd>> connect(const VectorXd& from, const VectorXd& to);

 private:
  std::optional<VectorXd> projected(VectorXd q);
  Extension alongManifold(const VectorXd& from, const VectorXd& target, double range);

  ClearanceCheck check_;
  Manifold manifold_;
};

/// A Steering per worker, constructed on first use.
class SteeringContexts {
 public:
  explicit SteeringContexts(int workers) : of_(std::size_t(workers)) {}

  /// The worker's Steering. From call to call, constraints may differ in their clearance only.
  Steering& of(int worker, const PlanningConstraints& constraints) {
    std::unique_ptr<Steering>& steering = of_[std::size_t(worker)];
    if (!steering) steering = std::make_unique<Steering>(constraints);
    steering->check().setClearance(constraints.clearance);
    return *steering;
  }

 private:
  std::vector<std::unique_ptr<Steering>> of_;
};

}  // namespace kinegraph::inline planning_internal
