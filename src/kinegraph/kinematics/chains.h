#pragma once

#include "kinegraph/kinematics/kinematic_model.h"

namespace kinegraph::inline kinematics_internal {

/// Returns true if test(column) holds for a twist column that moves frame a but not b, or b but not a. Stops at the
/// first such column; -1 is the world.
template <class Test>
bool anyColumnBetween(const KinematicModel& model, int a, int b, const Test& test) {
  const auto last = [&](int frame) { return frame < 0 ? -1 : model.last_column[model.frame_link[frame]]; };
  int column_a = last(a), column_b = last(b);
  while (column_a != column_b) {  // from the last column down to the first common one
    int& later = column_a > column_b ? column_a : column_b;
    if (test(later)) return true;
    later = model.column_before[later];
  }
  return false;
}

/// Calls visit(column) for all of these columns.
template <class Visit>
void forColumnsBetween(const KinematicModel& model, int a, int b, const Visit& visit) {
  anyColumnBetween(model, a, b, [&](int column) { return visit(column), false; });
}

}  // namespace kinegraph::inline kinematics_internal
