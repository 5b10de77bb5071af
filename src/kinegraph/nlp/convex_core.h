#pragma once

#include <memory>

#include "kinegraph/nlp/nlp.h"

namespace kinegraph {

/// The problem MinimalConvexCore: an ellipsoid of 18 corners v_i (half axes .08, .2 and .3, around (0, 0, .5)) is to be
/// the hull of 18 balls of radius r = .01 whose centers x_i coincide where they can. 54 variables x_0 .. x_17;
///     f      sum over the edges of each of 32 triangles of  y(|x_a - x_b| / 1e-4)
///     ineq   |v_i - x_i| - r                                       18
///     sos    0                                                     54, where the package robotic has a weight of 0
/// y(s) = s / (1 + s) - .0972.. counts neighbors that are apart; below s = .2 it goes on as a parabola with its vertex
/// at 0.
std::shared_ptr<Nlp> makeMinimalConvexCore();

}  // namespace kinegraph
