#pragma once

#include <optional>

#include "kinegraph/komo/path/path_motion.h"

namespace kinegraph::inline komo_internal {

/// Computes an initial guess in another homotopy class: the variables of a path with the same ends and a different
/// route between them. Equal numbers give equal paths. Returns nothing if no joint can be varied. Restores the given
/// path.
///
/// If all slices show one scene, two trees (RRT-Connect) search for a path between the ends, phase by phase. The result
/// is continuously collision-free: its corners are slices, so all motions between slices are pieces of checked edges.
/// The path keeps the distance `apart` (m), or half of the clearance of the ends if that is less, and up to 16 times as
/// much if possible.
///
/// With modes, with an end in collision, or if the trees fail, the path is q(s) = q_0(s) + d(s), 0 <= s <= 1. The
/// offset d is piecewise linear between d(0) = 0, four configurations, and d(1) = 0. These are sampled at random and
/// improved by random moves that minimize how much sampled configurations violate the distance `apart`. Such a path may
/// still collide.
std::optional<VectorXd> alternativePath(Path& path, double apart, MotionProbe& probe, int number);

}  // namespace kinegraph::inline komo_internal
