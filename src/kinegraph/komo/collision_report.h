#pragma once

#include "kinegraph/common/cancellation.h"
#include "kinegraph/komo/objective.h"
#include "kinegraph/komo/path/path_motion.h"

namespace kinegraph::inline komo_internal {

// Collects the motions between slices that the constraints of a problem require to be collision-free, and checks them.
// A motion counts if an objective constrains the motions between slices, or if the objectives forbid a collision in
// both of its slices. A constraint concerns either all shapes or certain pairs: those of the frames named in
// accumulatedCollisions or pairCollisions, and the two frames of an inequality on their distance. With one slice per
// phase the slices are waypoints, and constraints in slices imply nothing about the motions between them.

/// Returns the constrained motions, with the pairs that count.
std::vector<SliceMotion> constrainedMotions(const Path& path, const std::vector<Objective>& objectives);

/// Returns true if constrainedMotions would find any. Depends only on the objectives, not on the present path.
bool constrainsAnyMotion(const Path& path, const std::vector<Objective>& objectives);

/// Checks that the motions are collision-free up to 1e-5 m; the report names the deepest contact. `cancellation` is
/// polled between motions, and may throw.
ValidityReport reportCollisions(const std::vector<SliceMotion>& motions, const CancellationToken& cancellation);

}  // namespace kinegraph::inline komo_internal
