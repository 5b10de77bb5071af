#pragma once

#include <span>
#include <string>

namespace kinegraph {

/// Why these are no limits of a joint with `limits.size() / 2` dofs: all lower ones, then all upper ones. "" if they are.
/// Files of earlier years have the lower and the upper limit of each dof in turn; the message then says how they are
/// written today. [-1 1 -1 1] is taken for such: it would hold every dof where it is.
std::string limitsMistake(std::span<const double> limits);

}  // namespace kinegraph
