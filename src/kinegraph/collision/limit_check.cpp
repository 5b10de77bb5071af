#include "kinegraph/collision/limit_check.h"

#include <algorithm>

namespace kinegraph {

namespace {

/// How far beyond its limits a dof is; negative or 0 within.
double beyond(const Program& program, int dof, double value) {
  return std::max(program.lower[dof] - value, value - program.upper[dof]);
}

}  // namespace

bool withinLimits(const Program& program, const double* q) {
  for (int dof = 0; dof < program.dofs; ++dof) {
    if (!(beyond(program, dof, q[dof]) <= kLimitTolerance)) return false;
  }
  return true;
}

std::optional<LimitPassed> firstLimitPassed(const Program& program, const double* from, const double* to) {
  std::optional<LimitPassed> first;
  for (int dof = 0; dof < program.dofs; ++dof) {
    const double at_start = beyond(program, dof, from[dof]);
    if (at_start > kLimitTolerance) {
      if (!first || first->time > 0.) first = {0., dof, at_start};
    } else if (beyond(program, dof, to[dof]) > kLimitTolerance) {
      const double limit = to[dof] > from[dof] ? program.upper[dof] : program.lower[dof];
      const double time = std::clamp((limit - from[dof]) / (to[dof] - from[dof]), 0., 1.);
      if (!first || time < first->time) first = {time, dof, 0.};
    }
  }
  return first;
}

int frameOfDof(const Program& program, int dof) {
  for (std::size_t frame = 0; frame < program.frame_dofs.size(); ++frame) {
    const Program::DofRange& range = program.frame_dofs[frame];
    if (range.first <= dof && dof < range.first + range.count) return int(frame);
  }
  return -1;
}

}  // namespace kinegraph
