#pragma once

#include "kinegraph/motion/way_search.h"

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
  VectorXd weight = {};   ///< per dof, what length means
  MotionWatch late = {};  ///< true ends further tries; any thread may ask
};

/// Shortens a way, and others that are searched as `request` says, each with random numbers of its own. The best one
/// counts, at any number of threads.
ShortWay improveWay(const Way& first, const WayRequest& request, const ImproveOptions& options, SteeringCrew& crew);

/// Pulls it taut, around corners of so many refinements (TautOptions).
void tighten(ShortWay& best, const WayRequest& request, const VectorXd& weight, int refinements, SteeringCrew& crew);

}  // namespace kinegraph
