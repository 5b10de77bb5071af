#pragma once

#include "kinegraph/komo/komo.h"
#include "kinegraph/viewer/messages/shown.h"

namespace kinegraph::inline api_internal {

/// Returns the path as a motion, including the slices of the prefix. Texts name the objectives that a slice violates;
/// the frames concerned are marked, and touching pairs are shown as lines.
ShownMotion motionOf(const Komo& komo);

}  // namespace kinegraph::inline api_internal
