#pragma once

#include "kinegraph/planning/search/path_search.h"

namespace kinegraph {

/// A way, and what it was shortened to.
struct ShortWay {
  Way way;
  std::vector<VectorXd> points;
  double cost = std::numeric_limits<double>::infinity();  ///< weighted length
  long evaluations = 0;
};

struct ImproveOptions {
  int tries = 4;
  int first_try = 0;  ///< number of the first of them, of which its random numbers come; try 0 is the way that is given
  VectorXd weight = {};    ///< per dof, what length means
  MotionWatch late = {};   ///< true ends further tries; any thread may ask
  double taut_below = 0.;  ///< ways that are shortened to less than this are pulled taut, each of them
  int refinements = 0;     ///< of their corners (TautOptions)
};

/// Shortens a way, and others that are searched as `request` says, each with random numbers of its own. The best one
/// counts, at any number of threads; it has no points if no way was found.
ShortWay improveWay(const Way& first, const WayRequest& request, const ImproveOptions& options, SteeringCrew& crew);

/// Pulls it taut, around corners of so many refinements (TautOptions).
void tighten(ShortWay& best, const WayRequest& request, const VectorXd& weight, int refinements, SteeringCrew& crew);

}  // namespace kinegraph
