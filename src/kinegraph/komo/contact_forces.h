#pragma once

#include <string>
#include <vector>

#include "kinegraph/komo/motion_problem.h"

namespace kinegraph::inline komo_internal {

/// Specification of a force at a point fixed on an object, in some slices.
struct ContactSpec {
  std::vector<double> times;
  std::string object, from;
  double friction;       ///< friction coefficient
  double mass;           ///< kg; forces are in units of its weight
  bool is_free = false;  ///< three dofs per slice; otherwise one, along the z axis of the point
  double distance = 0.;  ///< initial distance of the point from the object, m
};

/// Lets `from` push `object` at a point of contact, in the slices that the times select. The force is constrained to
/// the friction cone. The point is a frame on the object, the same in all slices. Returns its name. Throws
/// FrameNotFound and ValueError.
std::string addContactForce(MotionProblem& motion, const ContactSpec& spec);

}  // namespace kinegraph::inline komo_internal
