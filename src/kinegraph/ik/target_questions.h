#pragma once

#include <optional>
#include <string>

#include "kinegraph/ik/ik_task.h"

namespace kinegraph::inline ik_internal {

/// The rotation that four numbers in the order w x y z mean if they are read as x y z w.
Quaterniond readAsXyzw(const Quaterniond& rotation);

/// Asks whether the quaternion of a target is in the order x y z w: so read, it is nearly the present rotation of the
/// frame, from which the target is far. "" otherwise.
std::string askAboutOrder(const IkTask& task, const State& present);

/// Asks whether the position of a missed target is in millimeters. "" if it is near, or missed by little.
std::string askAboutLength(const Vector3d& position, double missed_by);

}  // namespace kinegraph::inline ik_internal
