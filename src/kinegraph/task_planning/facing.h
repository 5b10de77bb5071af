#pragma once

#include <string>

#include "kinegraph/scene/config.h"

namespace kinegraph::inline task_planning_internal {

/// Returns q of a scene, with the arm of a hand rotated towards a point if it faces away: the first hinge of the arm
/// whose axis is vertical turns until the hand is on the side of the point. Solvers that begin there find a
/// configuration that reaches ahead, instead of one that bends over backwards. The same q if the hand is less than
/// 115 degrees beside the point, there is no such hinge, or its limits forbid the rotation.
VectorXd facing(const Config& C, const std::string& hand, const Vector3d& point);

}  // namespace kinegraph::inline task_planning_internal
