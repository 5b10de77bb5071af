#pragma once

#include <cstdint>

#include "kinegraph/common/cancellation.h"
#include "kinegraph/planning/search/path_search.h"
#include "kinegraph/scene/config.h"

namespace kinegraph {

struct RefineOptions {
  double margin = 0.;      ///< m, that all collidable pairs keep
  double blend = .05;      ///< rad or m, by which smooth may miss corners, in every dof
  std::uint64_t seed = 0;  ///< of the places that shortcut joins
  CancellationToken cancellation = {};
};

/// A shorter path between the same ends, rows of `path` (K, n), free at all times. Throws ValueError for a path of
/// another width, and for one that is not free itself, saying where.
MatrixXd shortcut(const Config& config, const MatrixXd& path, const RefineOptions& options = {});

/// Postures along the same path with rounded corners, where that is free at all times. Throws as shortcut.
MatrixXd smooth(const Config& config, const MatrixXd& path, const RefineOptions& options = {});

}  // namespace kinegraph
