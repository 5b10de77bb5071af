#pragma once

#include "kinegraph/scene/config.h"

namespace kinegraph {

/// Returns the scene with the fingers of its hands as far open as their limits allow, also around held objects. A hand
/// opens less if its fingers would overlap something else. Fingers are joints that are no part of q: one joint with one
/// dof and limits, and those that mimic it, on the link of the hand.
Config withOpenHands(const Config& C);

}  // namespace kinegraph
