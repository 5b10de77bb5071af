#include "kinegraph/simulation/physics.h"

#include "kinegraph/base/dynamic_library.h"

namespace kinegraph {

const Physics& physics() {
  static const Physics functions = [] {
    const DynamicLibrary library(KINEGRAPH_MUJOCO_LIBRARY, "a simulation");
    Physics loaded;
#define KINEGRAPH_LOAD(name) library.load(loaded.name, #name);
    KINEGRAPH_PHYSICS_FUNCTIONS(KINEGRAPH_LOAD)
#undef KINEGRAPH_LOAD
    return loaded;
  }();
  return functions;
}

}  // namespace kinegraph
