#pragma once

#include <string>

#include "kinegraph/math/pose.h"

namespace kinegraph {

/// A contact point between two frames.
struct Contact {
  std::string frame_a, frame_b;  ///< "ground" for the plane at z = 0
  Vector3d position;             ///< world, m
  Vector3d normal;               ///< unit, from a to b
  double distance;               ///< m; negative if the shapes overlap
  Vector3d force;                ///< exerted by a on b, world, N
};

}  // namespace kinegraph
