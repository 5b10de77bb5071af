#pragma once

#include "kinegraph/komo/objective.h"
#include "kinegraph/komo/path_motion.h"

namespace kinegraph {

// A motion that is to be free at all times is a problem with infinitely many constraints. It is solved with those of
// the slices, and then again with those of the instants between them at which the solution is not free, until it is.
// Source: Blankenship, Falk, Infinitely constrained optimization problems, 1976; Hauser, Semi-infinite programming for
// trajectory optimization with non-convex obstacles, 2021.

inline constexpr double kFreeTolerance = 1e-5;  ///< of checks of motions, m

/// Looks at the motions to the slices of an objective that is `on_the_way`, and adds instants at which pairs are nearer
/// than its margin. Returns by how much at most, m; 0 if there are none. Where the path begins nearer than that, the
/// first motion keeps half of what the beginning has.
double addInstants(Objective& objective, const Path& path, MotionProbe& probe);

/// The objectives, those on the way with the instants at which the path violates them.
std::vector<Objective> withInstants(std::vector<Objective> objectives, const Path& path);

}  // namespace kinegraph
