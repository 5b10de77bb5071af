#pragma once

#include <string>

#include "kinegraph/math/pose.h"

namespace kinegraph {

/// Two frames that touch.
struct Contact {
  std::string frame_a, frame_b;  ///< "ground" for the plane at z = 0
  Vector3d position;             ///< world, m
  Vector3d normal;               ///< unit, from a to b
  double distance;               ///< m, negative: they overlap
  Vector3d force;                ///< that a exerts on b, world, N
};

}  // namespace kinegraph
