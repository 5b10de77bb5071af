#pragma once

#include "kinegraph/common/cancellation.h"
#include "kinegraph/planning/search/path_search.h"

namespace kinegraph {

struct ShortcutOptions {
  VectorXd weight = {};    ///< per dof, what length means; empty: ones
  int cuts = 200;          ///< tries to cut a corner between random places
  bool corners = true;     ///< are corners cut at the end?
  std::uint64_t seed = 0;  ///< of these places
  CancellationToken cancellation = {};
};

/// Shortens a path whose straight motions are free; so are those of what it returns, at all times, with the same ends.
///
/// First each posture is joined to the last one to which it can be, then random places of the path to each other,
/// nearer and nearer ones, and then corners are cut. Where there are constraints, joints are ways along the manifold.
std::vector<VectorXd> shorten(Steering& steering, std::vector<VectorXd> path, const ShortcutOptions& options = {});

}  // namespace kinegraph
