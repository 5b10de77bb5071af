#pragma once

#include "kinegraph/planning/steering/clearance_check.h"
#include "kinegraph/planning/steering/manifold.h"

namespace kinegraph {

/// What a motion has to keep to: one value for all threads.
struct PlanningConstraints {
  const State* scene;       ///< any State of it; must stay
  const JointSpace* space;  ///< must stay
  Clearance clearance = {};
  std::vector<MotionConstraint> constraints = {};
  double constraint_tolerance = 1e-3;  ///< of each row, in its own unit
};

/// How planners move from posture to posture: on straight motions, which are checked, and where there are constraints
/// on short ones from one posture at which they hold to the next. Every thread has its own.
class Steering {
 public:
  static constexpr double kSpacing = .02;  ///< between postures at which constraints are looked at first

  explicit Steering(const PlanningConstraints& constraints)
      : check_(*constraints.scene, *constraints.space, constraints.clearance),
        manifold_(*constraints.scene, *constraints.space, constraints.constraints, constraints.constraint_tolerance) {}

  const JointSpace& space() const { return check_.space(); }
  ClearanceCheck& check() { return check_; }
  Manifold& manifold() { return manifold_; }
  bool isConstrained() const { return !manifold_.isEmpty(); }
  /// Of the check, and of the constraints: what effort means.
  long evaluations() const { return check_.evaluations + manifold_.evaluations; }

  /// Postures on the way towards `target`, up to `range` away, each of which seems to be reached freely from the one
  /// before. The last one is `target` if `reached`.
  struct Way {
    std::vector<VectorXd> points;
    bool reached = false;
  };
  Way towards(const VectorXd& from, const VectorXd& target, double range);

  /// Is the straight motion free at all times, and do the constraints hold at all times (see Manifold::holdsAlong)?
  bool isFree(const VectorXd& from, const VectorXd& to);

  /// Postures between two: none if their straight motion is free; with constraints, on the manifold. Nothing if there
  /// is no such way. All motions between the postures are free at all times.
  std::optional<std::vector<VectorXd>> between(const VectorXd& from, const VectorXd& to);

 private:
  Way onManifold(const VectorXd& from, const VectorXd& target, double range);

  ClearanceCheck check_;
  Manifold manifold_;
};

/// A Steering for each worker, made when it is first asked for.
class SteeringContexts {
 public:
  explicit SteeringContexts(int workers) : of_(std::size_t(workers)) {}

  /// For demands that differ from those before by no more than the clearance.
  Steering& of(int worker, const PlanningConstraints& constraints) {
    std::unique_ptr<Steering>& steering = of_[std::size_t(worker)];
    if (!steering) steering = std::make_unique<Steering>(constraints);
    steering->check().setClearance(constraints.clearance);
    return *steering;
  }

 private:
  std::vector<std::unique_ptr<Steering>> of_;
};

}  // namespace kinegraph
