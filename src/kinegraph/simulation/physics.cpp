#include "kinegraph/simulation/physics.h"

namespace kinegraph::inline simulation_internal {

const Physics& physics() {
  static const Physics functions = [] {
    const DynamicLibrary library(KINEGRAPH_MUJOCO_LIBRARY, "a simulation", "mj_step");
    Physics functions;
    KINEGRAPH_PHYSICS_FUNCTIONS(KINEGRAPH_LIBRARY_LOAD)
    return functions;
  }();
  return functions;
}

}  // namespace kinegraph::inline simulation_internal
