#pragma once

#include "kinegraph/common/cancellation.h"
#include "kinegraph/planning/search/path_search.h"

namespace kinegraph {

/// A way, and what it was shortened to.
struct ShortcutResult {
  Way way;
  std::vector<VectorXd> points;
  double cost = std::numeric_limits<double>::infinity();  ///< weighted length
  long evaluations = 0;
};

struct ImprovePathOptions {
  int tries = 4;
  int first_try = 0;  ///< number of the first of them, of which its random numbers come; try 0 is the way that is given
  VectorXd weight = {};         ///< per dof, what length means
  CancellationToken late = {};  ///< true ends further tries; any thread may ask
  double taut_below = 0.;       ///< ways that are shortened to less than this are pulled taut, each of them
  int refinements = 0;          ///< of their corners (RopeShortcutOptions)
};

/// Shortens a way, and others that are searched as `request` says, each with random numbers of its own. The best one
/// counts, at any number of threads; it has no points if no way was found.
ShortcutResult improvePath(const Way& first, const PathQuery& request, const ImprovePathOptions& options,
                           SteeringContexts& contexts);

/// Pulls it taut, around corners of so many refinements (RopeShortcutOptions).
void tighten(ShortcutResult& best, const PathQuery& request, const VectorXd& weight, int refinements,
             SteeringContexts& contexts);

}  // namespace kinegraph
