#pragma once

#include <string>
#include <vector>

#include "kinegraph/komo/path/path_records.h"

namespace kinegraph::inline komo_internal {

struct MotionProblem;

struct ForceExchangeSpec {
  std::vector<double> times;
  std::string object, from;
  ForceExchange kind;
  double friction = .5;  ///< friction coefficient
};

/// Lets `object` and `from` push each other in the slices that the times select. Adds six dofs per slice: the point of
/// contact and the force on `object`; and adds the constraints of the kind and small costs on the dofs. Returns the
/// name of the point. Throws FrameNotFound and ValueError.
std::string addForceExchange(MotionProblem& motion, const ForceExchangeSpec& spec);

}  // namespace kinegraph::inline komo_internal
