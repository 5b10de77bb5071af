#pragma once

#include <vector>

#include "kinegraph/common/random.h"
#include "kinegraph/komo/path/path_records.h"
#include "kinegraph/math/pose.h"

namespace kinegraph::inline komo_internal {

class Path;

// Initial values of a path for a solver. All functions throw ValueError for numbers that do not fit the path.

void initializePath(Path& path, const MatrixXd& configurations);  ///< T x n
void initializeConstant(Path& path, const VectorXd& q);           ///< n numbers, or T*n for a path
void initializeFromStart(Path& path);                             ///< the initial configuration in all slices
void initializeRandom(Path& path, Rng& rng);                      ///< samples as Config::setRandom does, slice by slice

/// Writes waypoint i into the slice at phase time (i+1) / per_phase: either the initial configuration's dofs, or all
/// dofs that the slice owns. Returns the slices.
std::vector<int> initializeWaypoints(Path& path, const std::vector<VectorXd>& waypoints,
                                     const WaypointOptions& options);

/// Writes configurations into the slices of a phase, for the joints of these frames. `resample` accepts any number of
/// configurations.
void initializePhase(Path& path, int phase, const std::vector<int>& frames, const MatrixXd& configurations,
                     bool resample);

}  // namespace kinegraph::inline komo_internal
