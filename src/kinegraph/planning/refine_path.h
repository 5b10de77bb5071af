#pragma once

#include <cstdint>

#include "kinegraph/common/cancellation.h"
#include "kinegraph/scene/config.h"

namespace kinegraph {

struct RefineOptions {
  double margin = 0.;      ///< least distance of all collidable pairs, m
  double blend = .05;      ///< largest deviation of `smooth` from the path in every dof, rad or m
  std::uint64_t seed = 0;  ///< of the random shortcuts
  CancellationToken cancellation = {};
};

/// Shortens a path (K, n) between the same ends; the result is continuously collision-free. Throws ValueError for a
/// path of another width, and for a path in collision; the message says between which rows.
MatrixXd shortcut(const Config& config, const MatrixXd& path, const RefineOptions& options = {});

/// Rounds the corners of a path as far as that is continuously collision-free. Errors as `shortcut`.
MatrixXd smooth(const Config& config, const MatrixXd& path, const RefineOptions& options = {});

}  // namespace kinegraph
