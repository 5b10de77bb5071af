#pragma once

#include "kinegraph/kinematics/kinematic_model.h"

namespace kinegraph {

/// Does test(column) hold for any of the twist columns of a Program that move frame a and not b, or b and not a? It is asked
/// until one does; -1 is the world.
template <class Test>
bool anyColumnBetween(const KinematicModel& model, int a, int b, const Test& test) {
  const auto last = [&](int frame) { return frame < 0 ? -1 : model.last_column[model.frame_link[frame]]; };
  int column_a = last(a), column_b = last(b);
  while (column_a != column_b) {  // from the one that comes last to the one where they meet
    int& later = column_a > column_b ? column_a : column_b;
    if (test(later)) return true;
    later = model.column_before[later];
  }
  return false;
}

/// Calls visit(column) for all of them.
template <class Visit>
void forColumnsBetween(const KinematicModel& model, int a, int b, const Visit& visit) {
  anyColumnBetween(model, a, b, [&](int column) { return visit(column), false; });
}

}  // namespace kinegraph
