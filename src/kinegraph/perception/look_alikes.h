#pragma once

#include <vector>

#include "kinegraph/perception/registration.h"

namespace kinegraph::inline perception_internal {

/// Tells things that look alike apart, by the distances of the points and of the last poses. Equal things had to move
/// least, in sum. Changes the poses of `things` and the entries of `is_seen`. `anywhere`: a thing may be at the place
/// of another one, however far it is away.
///
/// Returns for each thing the others with which it may be confused: those that may have moved to its place, while
/// it moved to theirs, perhaps in a circle over several things, or while it is not seen. `unclear` gets the pairs for
/// which the movements say little: where exchanged things would have moved less than twice as far.
std::vector<std::vector<int>> tellApart(std::vector<Thing>& things, const Registration& registration, bool anywhere,
                                        std::vector<bool>& is_seen, std::vector<std::pair<int, int>>& unclear);

}  // namespace kinegraph::inline perception_internal
