#pragma once

#include "kinegraph/kinematics/program.h"

namespace kinegraph {

/// Calls visit(column) for the twist columns of a Program that move frame a and not b, or b and not a; -1 is the world.
template <class Visit>
void forColumnsBetween(const Program& program, int a, int b, const Visit& visit) {
  const auto last = [&](int frame) { return frame < 0 ? -1 : program.last_column[program.frame_link[frame]]; };
  int column_a = last(a), column_b = last(b);
  while (column_a != column_b) {  // from the one that comes last to the one where they meet
    int& later = column_a > column_b ? column_a : column_b;
    visit(later);
    later = program.column_before[later];
  }
}

}  // namespace kinegraph
