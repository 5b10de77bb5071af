#pragma once

#include <string>

namespace kinegraph {

/// A planar arm of three joints that turn about z: two capsules of .5 m and a ball, `tip`. The arm's own parts do not
/// collide with each other. A .g text.
inline std::string planarArm() {
  return R"(
base: {}
j1 (base): { joint: hingeZ, limits: [-3 3] }
l1 (j1): { shape: capsule, size: [.5 .03], Q: [.25 0 0 .7071068 0 .7071068 0], contact: 1 }
j2 (j1): { joint: hingeZ, pre: [.5 0 0], limits: [-3 3] }
l2 (j2): { shape: capsule, size: [.5 .03], Q: [.25 0 0 .7071068 0 .7071068 0], contact: -1 }
j3 (j2): { joint: hingeZ, pre: [.5 0 0], limits: [-3 3] }
tip (j3): { shape: sphere, size: [.05], Q: [.3 0 0], contact: -1 }
)";
}

}  // namespace kinegraph
