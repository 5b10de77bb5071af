#pragma once

#include <memory>

#include "kinegraph/nlp/nlp.h"

namespace kinegraph::inline nlp_internal {

/// Returns the test problem MinimalConvexCore: 18 balls of radius r = .01 m cover the 18 corners v_i of an ellipsoid
/// (half axes .08, .2 and .3 m, center (0, 0, .5)). As many as possible of their centers x_i coincide.
///
/// The 54 variables are x_0 .. x_17; the residuals are
///     f      sum over the edges of each of 32 triangles of  y(|x_a - x_b| / 1e-4)
///     ineq   |v_i - x_i| - r                                       18 residuals
///     sos    0                                                     54 residuals, of weight 0 in the package robotic
/// The function y(s) = s / (1 + s) - .0972.. approximates the number of neighbors that do not coincide. Below s = .2 a
/// parabola with its vertex at 0 replaces it.
std::shared_ptr<Nlp> makeMinimalConvexCore();

}  // namespace kinegraph::inline nlp_internal
