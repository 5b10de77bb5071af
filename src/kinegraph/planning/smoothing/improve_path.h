#pragma once

#include "kinegraph/common/cancellation.h"
#include "kinegraph/planning/search/path_search.h"

namespace kinegraph::inline planning_internal {

/// A path that a search found, and its shortened version.
struct ShortcutResult {
  PathSearchResult found;
  std::vector<VectorXd> points;                           ///< of the shortened path
  double cost = std::numeric_limits<double>::infinity();  ///< its weighted length
  long evaluations = 0;
};

struct ImprovePathOptions {
  int paths = 4;                ///< that are searched and shortened
  int first_number = 0;         ///< of these paths; the number selects the random numbers. Number 0 is the given path
  VectorXd weight = {};         ///< per dof, of the weighted length
  CancellationToken late = {};  ///< ends further searches; called from any thread
  double tighten_below = 0.;    ///< shortened paths of less cost are tightened, too
  int refinements = 0;          ///< RopeShortcutOptions
};

/// Shortens a path, and further paths that are searched by the query with other random numbers. Returns the best one,
/// independent of the number of threads; it has no points if no path was found.
ShortcutResult improvePath(const PathSearchResult& first, const PathQuery& query, const ImprovePathOptions& options,
                           SteeringContexts& contexts);

/// Tightens the shortened path around obstacles (tightenPath).
void tighten(ShortcutResult& best, const PathQuery& query, const VectorXd& weight, int refinements,
             SteeringContexts& contexts);

}  // namespace kinegraph::inline planning_internal
