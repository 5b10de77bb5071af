#pragma once

#include <vector>

namespace kinegraph {

class Komo;

/// Limits the motion of each joint between consecutive slices to `step` (rad, m), in the slices that `times` selects.
/// Adds two inequalities per dof, in rad or m. Throws ValueError for a step that is not positive, and for a Komo of
/// order 0.
void addStepLimit(Komo& komo, double step, const std::vector<double>& times = {});

}  // namespace kinegraph
