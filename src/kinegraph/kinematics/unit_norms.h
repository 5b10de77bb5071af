#pragma once

#include "kinegraph/kinematics/kinematic_model.h"

namespace kinegraph::inline kinematics_internal {

/// Scales the quaternions and circles among the dofs to length 1; a zero one becomes the identity.
inline void scaleToUnitNorms(const std::vector<KinematicModel::DofRange>& unit_norms, Eigen::Ref<VectorXd> q) {
  for (const auto& [first, count] : unit_norms) {
    auto part = q.segment(first, count);
    const double norm = part.norm();
    if (norm > 1e-9) {
      part /= norm;
    } else {
      part = VectorXd::Unit(count, 0);
    }
  }
}

}  // namespace kinegraph::inline kinematics_internal
