#pragma once

#include "kinegraph/common/cancellation.h"
#include "kinegraph/komo/objective.h"
#include "kinegraph/komo/path/path_motion.h"

namespace kinegraph {

// Which motions between slices the constraints of a problem forbid to collide: those on the way to slices, and those
// between two slices in both of which a collision is forbidden. It is that of all shapes, or of pairs: those of the
// named frames of accumulatedCollisions and pairCollisions, and the two frames of an inequality on their distance. Where
// slices are waypoints, one per phase, what is said of them says nothing of the motion.

/// The motions of which there is anything to say, with the pairs that count.
std::vector<SliceMotion> constrainedMotions(const Path& path, const std::vector<Objective>& objectives);

/// Is there any? Looks at no values.
bool constrainsAnyMotion(const Path& path, const std::vector<Objective>& objectives);

/// Are they free, to 1e-5 m? Names the deepest contact. `cancellation` is called between motions, and may throw.
ValidityReport judge(const std::vector<SliceMotion>& motions, const CancellationToken& cancellation);

}  // namespace kinegraph
