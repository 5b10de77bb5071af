#pragma once

#include <vector>

#include "kinegraph/common/random.h"
#include "kinegraph/komo/path/path.h"

namespace kinegraph {

// Where a solver starts: calls that fill a path with values. All throw ValueError for numbers that do not fit it.

void startAtPath(Path& path, const MatrixXd& rows);   ///< T x n
void startAtConstant(Path& path, const VectorXd& q);  ///< n numbers, or T*n for a path
void startAsGiven(Path& path);                        ///< all slices as the given configuration
void startAtRandom(Path& path, Rng& rng);             ///< as Config::setRandom, slice after slice

/// How waypoints are joined.
struct WaypointOptions {
  int per_phase = 1;
  bool interpolate = false;  ///< between them: a cosine blend; else the one before
  double towards_home = 0.;  ///< 0..1: the blend is moved towards home in the middle
};

/// Puts waypoint i into the slice at phase time (i+1) / per_phase: the given configuration's dofs, or all that the
/// slice owns. Returns the slices.
std::vector<int> startAtWaypoints(Path& path, const std::vector<VectorXd>& waypoints, const WaypointOptions& options);

/// Writes `rows` into the slices of a phase, for the joints of these frames. `resample`: whatever their number.
void startPhaseAt(Path& path, int phase, const std::vector<int>& frames, const MatrixXd& rows, bool resample);

}  // namespace kinegraph
