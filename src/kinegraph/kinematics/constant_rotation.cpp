#include "kinegraph/kinematics/constant_rotation.h"

#include <cmath>

namespace kinegraph::inline kinematics_internal {

ConstantRotation classifyRotation(const double* R) {
  ConstantRotation rotation;
  bool moves = false;
  for (int k = 0; k < 3; ++k) {
    int ones = 0;
    for (int i = 0; i < 3; ++i) {
      const double entry = R[3 * k + i], nearest = std::round(entry);
      if (!(std::abs(entry - nearest) < 1e-15)) return {ConstantRotation::general};
      if (nearest == 0.) continue;
      ++ones;
      rotation.column[k] = static_cast<unsigned char>(i);
      rotation.sign[k] = nearest;
    }
    if (ones != 1) return {ConstantRotation::general};
    moves = moves || rotation.column[k] != k || rotation.sign[k] < 0;
  }
  rotation.kind = moves ? ConstantRotation::quarters : ConstantRotation::none;
  return rotation;
}

}  // namespace kinegraph::inline kinematics_internal
