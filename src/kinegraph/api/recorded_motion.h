#pragma once

#include "kinegraph/simulation/simulation_data.h"
#include "kinegraph/viewer/messages/shown.h"

namespace kinegraph {

/// Converts a recorded run to a motion with equal time steps: 50 slices per second, at most 1500. If the simulation's
/// time was set back, the motion's time continues. Throws ValueError for a recording without steps.
ShownMotion recordedMotion(const Recording& recording);

}  // namespace kinegraph
