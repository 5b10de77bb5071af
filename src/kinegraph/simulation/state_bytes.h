#pragma once

#include <string>
#include <string_view>

#include "kinegraph/simulation/world.h"

namespace kinegraph::inline simulation_internal {

/// Writes a world's state with all bits of all numbers, for the same version of the library on the same kind of
/// machine.
std::string stateToBytes(const WorldState& state);

/// Reads a state that stateToBytes wrote for `world`'s model. Throws ValueError for other bytes or another model.
WorldState stateFromBytes(std::string_view bytes, const World& world);

}  // namespace kinegraph::inline simulation_internal
