#pragma once

#include "kinegraph/trajectories/b_spline.h"

namespace kinegraph {

/// What a motion of degree 3 or less does from one time until a later one, as a spline of degree 3 that begins and ends
/// there. What is appended to it goes on with its velocity. Before its start and after its end a motion stands still.
/// Throws ValueError for other degrees, and if the times do not rise.
BSpline cubicPart(const BSpline& motion, double from, double until);

}  // namespace kinegraph
