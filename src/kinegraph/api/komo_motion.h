#pragma once

#include "kinegraph/komo/komo.h"
#include "kinegraph/viewer/messages/shown_motion.h"

namespace kinegraph {

/// The path as a motion of the scene as it is before it, with the slices of the prefix; texts tell the objectives that
/// are violated in a slice, and frames that this is about are marked; of pairs of shapes, where they touch.
ShownMotion motionOf(const Komo& komo);

}  // namespace kinegraph
