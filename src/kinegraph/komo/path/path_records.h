#pragma once

#include <string>

#include "kinegraph/math/pose.h"

namespace kinegraph {

/// Two shapes that come too close in the motion between two slices.
struct PathContact {
  int slice = 0;         ///< number of the motion's last slice
  double time = 0.;      ///< phase time at which they first come too close
  std::string a, b;      ///< names of their frames
  double distance = 0.;  ///< smallest distance until the slice, m; negative: penetration depth
  double deepest = 0.;   ///< phase time of the smallest distance

  std::string str() const;  ///< such as "'a' and 'b' overlap by 3.1 mm at phase time 0.52, between slices 7 and 8"
};

/// A contact force in a slice.
struct Interaction {
  int slice;
  std::string object, from;
  Vector3d point;  ///< m, in the world
  Vector3d force;  ///< N, on the object, in the world
};

/// Interpolation of waypoints.
struct WaypointOptions {
  int per_phase = 1;
  bool interpolate = false;  ///< cosine blend between waypoints; otherwise piecewise constant
  double towards_home = 0.;  ///< 0..1: pulls the middle of the blend towards home
};

}  // namespace kinegraph
