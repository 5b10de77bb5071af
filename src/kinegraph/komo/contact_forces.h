#pragma once

#include <string>
#include <vector>

#include "kinegraph/komo/motion_problem.h"

namespace kinegraph {

/// A force at a point that is fixed on an object, in some slices.
struct ContactSpec {
  std::vector<double> times;
  std::string object, from;
  double friction;       ///< coefficient
  double mass;           ///< kg; forces are in units of its weight
  bool is_free = false;  ///< three dofs per slice; else one, along the z axis of the point
  double distance = 0.;  ///< m: how far off the object the point starts
};

/// In the slices that its times select, `from` pushes `object` at a point where they touch, within the cone of friction.
/// The point is a frame on the object, the same in all slices; its name is returned. Throws FrameNotFound and
/// ValueError.
std::string addContactForce(MotionProblem& motion, const ContactSpec& demand);

}  // namespace kinegraph
