#pragma once

#include <string>
#include <vector>

#include "kinegraph/planning/motion_plan.h"
#include "kinegraph/planning/steering/steering.h"

namespace kinegraph::inline planning_internal {

/// A start or goal of a motion, and whether it is valid.
struct Endpoint {
  VectorXd q;                                 ///< within the limits
  std::string problem;                        ///< "" if it is valid, else why not, as "the start collides: ..."
  double clearance = 0.;                      ///< least distance of a pair, m, at most the margin
  std::vector<ClearanceCheck::Nearest> near;  ///< pairs closer than the margin, the deepest first

  bool isFree() const { return problem.empty(); }
};

/// Checks a configuration, called `what` in messages, as "start". Moves it to a limit that it exceeds by up to 1e-5.
/// Pairs may be closer than the margin if they keep the lesser of the margin and 0. Throws ValueError for a wrong
/// length and for values that are not finite; `who` names the caller.
Endpoint checkEndpoint(Steering& steering, const KinematicModel& model, const VectorXd& q, double margin,
                       const std::string& what, const char* who);

/// The clearance to keep: `margin`, and around endpoints that keep less, their own clearance.
Clearance clearanceAround(double margin, const std::vector<const Endpoint*>& ends);

/// The constraints of a motion with these endpoints. `scene` and `space` must outlive their users.
PlanningConstraints constraintsAround(const State& scene, const JointSpace& space, const PlanOptions& options,
                                      const std::vector<const Endpoint*>& ends);

/// "'hand' and 'table' overlap by 12 mm, ...", for the deepest pairs.
std::string describePairs(const KinematicModel& model, const std::vector<ClearanceCheck::Nearest>& pairs);

/// A sentence on an endpoint that keeps less than the margin, called `what` in it; "" if it keeps the margin.
std::string marginWarning(const KinematicModel& model, const Endpoint& end, double margin, const std::string& what);

/// Counts the obstacles of colliding pairs, the most frequent first. The obstacle of a pair is the frame closer to the
/// world.
std::vector<MetObstacle> obstaclesMet(const KinematicModel& model, const PairCounts& hits);

/// "'wall' (70 %, by 'hand', 'finger'), ..."
std::string describeObstacles(const std::vector<MetObstacle>& obstacles);

/// "12 mm", "3.4 um", "1.5 m"
std::string formatLength(double length);

}  // namespace kinegraph::inline planning_internal
