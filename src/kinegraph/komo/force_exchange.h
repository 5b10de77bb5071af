#pragma once

#include <string>
#include <vector>

#include "kinegraph/komo/motion_problem.h"

namespace kinegraph {

/// What a contact that moves along both surfaces does to the bodies.
enum class ForceExchange {
  slide,          ///< they touch; the force is along the normal
  stick,          ///< they touch and do not slide; at kOrder 0 the force is within the cone of friction
  complementary,  ///< they do not overlap; the force is along the normal where they touch, and zero elsewhere
  bounce,         ///< they touch in the first of the slices and fly apart with 0.9 of the speed; kOrder 2
};

/// slide, stick, complementary or bounce. Throws NameError for other names, with those that are near.
ForceExchange forceExchangeFromName(const std::string& name);

struct ForceExchangeSpec {
  std::vector<double> times;
  std::string object, from;
  ForceExchange kind;
  double friction = .5;  ///< coefficient
};

/// In the slices that its times select, `object` and `from` may push each other: six more dofs per slice, the point
/// where they do and the force on `object` there. Adds what the kind demands, and small costs on both. Returns the name
/// of the point. Throws FrameNotFound and ValueError.
std::string addForceExchange(MotionProblem& motion, const ForceExchangeSpec& demand);

}  // namespace kinegraph
