#pragma once

#include "kinegraph/simulation/recording.h"
#include "kinegraph/viewer/messages/shown_motion.h"

namespace kinegraph {

/// A recorded run as the page plays it, evenly in time: 50 slices per second, or fewer so that there are 1500 at most. Where time was
/// set back meanwhile, it goes on. Throws ValueError for a recording without steps.
ShownMotion recordedMotion(const Recording& recording);

}  // namespace kinegraph
