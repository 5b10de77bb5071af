#pragma once

#include <string>
#include <vector>

#include "kinegraph/scene/config.h"

namespace kinegraph::inline compatibility_internal {

// Methods of earlier releases, kept for existing scripts.

/// Activates exactly the joints at frames with one of these attributes, or with `not_those` all others. Throws
/// ValueError for an attribute that no frame with a joint has.
void selectJointsByTag(Config& config, const std::vector<std::string>& attributes, bool not_those = false);

/// Makes objects free: the nearest joint at or above each of these frames becomes a free joint at its current pose; a
/// root is attached to the first frame of the configuration. Throws FrameNotFound, and ValueError for that first
/// frame.
void makeObjectsFree(Config& config, const std::vector<std::string>& names);

/// Advances q by the time `tau` (s) under the forces `u` (N m, N), from the velocity `velocity`, with one step of the
/// classical Runge-Kutta method, and returns the new velocity. `noise` is the standard deviation of random
/// accelerations that are added. Throws ValueError.
VectorXd stepDynamics(Config& config, const VectorXd& velocity, const VectorXd& u, double tau, double noise,
                      bool gravity, Rng& rng);

}  // namespace kinegraph::inline compatibility_internal
