#pragma once

#include <string>
#include <string_view>

#include "kinegraph/simulation/world.h"

namespace kinegraph {

/// A world's state as bytes: all bits of all numbers. For the same version of the library on the same kind of machine.
std::string stateToBytes(const WorldState& state);

/// The state that stateToBytes wrote of such a world. Throws ValueError for other bytes, and for those of another model.
WorldState stateFromBytes(std::string_view bytes, const World& world);

}  // namespace kinegraph
