#include "kinegraph/kinematics/constant_rotation.h"

#include <cmath>

namespace kinegraph {

ConstantRotation classifyRotation(const double* R) {
  ConstantRotation turn;
  bool moves = false;
  for (int k = 0; k < 3; ++k) {
    int ones = 0;
    for (int i = 0; i < 3; ++i) {
      const double entry = R[3 * k + i], nearest = std::round(entry);
      if (!(std::abs(entry - nearest) < 1e-15)) return {ConstantRotation::general};
      if (nearest == 0.) continue;
      ++ones;
      turn.column[k] = static_cast<unsigned char>(i);
      turn.sign[k] = nearest;
    }
    if (ones != 1) return {ConstantRotation::general};
    moves = moves || turn.column[k] != k || turn.sign[k] < 0;
  }
  turn.kind = moves ? ConstantRotation::quarters : ConstantRotation::none;
  return turn;
}

}  // namespace kinegraph
