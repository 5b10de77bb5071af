#pragma once

#include <string>
#include <vector>

#include "kinegraph/planning/steering/steering.h"

namespace kinegraph {

/// A start or goal of a motion, and what is wrong with it.
struct Endpoint {
  VectorXd q;                   ///< within the limits
  std::string problem;          ///< "" if a motion can begin or end there; else why not, as "the start collides: ..."
  double verified_margin = 0.;  ///< least distance of a pair, m; the margin and more count as the margin
  std::vector<ClearanceCheck::Nearest> near;  ///< pairs nearer than the margin, the deepest first

  bool isFree() const { return problem.empty(); }
};

/// Looks at a posture of which `what` is the name, as "start". Within 1e-5 beyond a limit it is moved to the limit;
/// a wrong length and numbers that are not finite throw ValueError with `who` in front. Pairs may keep less than the
/// margin, as long as they keep the lesser of it and 0.
Endpoint checkEndpoint(Steering& steering, const KinematicModel& model, const VectorXd& q, double margin,
                       const std::string& what, const char* who);

/// The demands with margins that hold around the ends that keep less.
Clearance clearanceAround(double margin, const std::vector<const Endpoint*>& ends);

/// "'hand' and 'table' overlap by 12 mm, ...": of the deepest pairs.
std::string describePairs(const KinematicModel& model, const std::vector<ClearanceCheck::Nearest>& pairs);

/// A frame that motions ended at.
struct MetObstacle {
  int frame;  ///< id
  std::string name;
  double share;                 ///< of all motions that were not free
  std::vector<std::string> by;  ///< frames that ran into it
};

/// The obstacles of these pairs, those first that most motions ended at. Of a pair, it is the one that moves less.
std::vector<MetObstacle> obstaclesMet(const KinematicModel& model, const PairCounts& hits);

/// "'wall' (70 %, by 'hand', 'finger'), ..."
std::string describeObstacles(const std::vector<MetObstacle>& obstacles);

/// "12 mm", "3.4 um", "1.5 m"
std::string formatLength(double length);

}  // namespace kinegraph
