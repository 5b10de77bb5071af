#pragma once

#include <span>
#include <string>

namespace kinegraph {

/// Explains why `limits` are not the limits of a joint with `limits.size() / 2` dofs (all lower, then all upper); "" if
/// they are valid. Older files alternate lower and upper limits; the message then shows the current order. [-1 1 -1 1]
/// counts as such a list: read in the current order, it would fix every dof.
std::string limitsError(std::span<const double> limits);

}  // namespace kinegraph
