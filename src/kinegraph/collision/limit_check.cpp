#include "kinegraph/collision/edge_check.h"

#include <algorithm>

#include "kinegraph/kinematics/kinematic_model.h"

namespace kinegraph {

namespace {

/// The excess of a dof over its limits; negative or 0 within them.
double beyond(const KinematicModel& model, int dof, double value) {
  return std::max(model.lower[dof] - value, value - model.upper[dof]);
}

}  // namespace

bool withinLimits(const KinematicModel& model, const double* q) {
  for (int dof = 0; dof < model.dofs; ++dof) {
    if (!(beyond(model, dof, q[dof]) <= kLimitTolerance)) return false;
  }
  return true;
}

std::optional<LimitPassed> firstLimitPassed(const KinematicModel& model, const double* from, const double* to) {
  std::optional<LimitPassed> first;
  for (int dof = 0; dof < model.dofs; ++dof) {
    const double at_start = beyond(model, dof, from[dof]);
    if (at_start > kLimitTolerance) {
      if (!first || first->time > 0.) first = {0., dof, at_start};
    } else if (beyond(model, dof, to[dof]) > kLimitTolerance) {
      const double limit = to[dof] > from[dof] ? model.upper[dof] : model.lower[dof];
      const double time = std::clamp((limit - from[dof]) / (to[dof] - from[dof]), 0., 1.);
      if (!first || time < first->time) first = {time, dof, 0.};
    }
  }
  return first;
}

int frameOfDof(const KinematicModel& model, int dof) {
  for (std::size_t frame = 0; frame < model.frame_dofs.size(); ++frame) {
    const KinematicModel::DofRange& range = model.frame_dofs[frame];
    if (range.first <= dof && dof < range.first + range.count) return int(frame);
  }
  return -1;
}

}  // namespace kinegraph
