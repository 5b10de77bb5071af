#pragma once

#include <string>
#include <vector>

#include "kinegraph/komo/motion_problem.h"

namespace kinegraph {

/// Physical behavior of a contact that may move along both surfaces.
enum class ForceExchange {
  slide,          ///< the bodies touch; the force is along the normal
  stick,          ///< the bodies touch without sliding; at kOrder 0 the force is within the friction cone
  complementary,  ///< the bodies do not overlap; the force is along the normal, and zero unless they touch
  bounce,         ///< the bodies touch in the first slice and separate with 0.9 of the speed; requires kOrder 2
};

/// Parses slide, stick, complementary or bounce. Throws NameError for other names and suggests similar ones.
ForceExchange forceExchangeFromName(const std::string& name);

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

}  // namespace kinegraph
