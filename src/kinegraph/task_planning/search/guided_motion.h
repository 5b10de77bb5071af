#pragma once

#include <vector>

#include "kinegraph/planning/steering/manifold.h"
#include "kinegraph/task_planning/task_doors.h"

namespace kinegraph {

/// By how much a hand may miss where it holds a handle, m, along a motion that is looked for; plans allow kOffPlace.
inline constexpr double kSlip = 5e-4;

/// What a hand asks of a motion that holds a handle as it does in the scene as it is; 1e-3 of it is a tenth of a millimeter.
std::vector<MotionConstraint> gripConstraints(const Config& C, const std::string& hand, const std::string& handle);

/// Postures from q0 to q1 at which constraints hold to a tenth of a millimeter, .02 rad or m or less from one to the next:
/// those on the straight line, each brought to the nearest one at which they hold. Empty where there are none, or they jump.
MatrixXd guidedConfigurations(const Config& C, const VectorXd& q0, const VectorXd& q1,
                              const std::vector<MotionConstraint>& constraints);

/// How a hand has moved on the handle since it took it: m, and the cosine of the turn that its grip does not allow.
struct Slip {
  double distance = 0., cosine = 1.;
};

/// Between two states of a scene, `taken` and `now`.
Slip slipOf(const Config& taken, const Config& now, const std::string& hand, const std::string& handle);

/// The most along a path: at its rows, in the middles between them, and every .02 rad or m.
Slip mostSlip(const Config& taken, const MatrixXd& path, const std::string& hand, const std::string& handle);

}  // namespace kinegraph
