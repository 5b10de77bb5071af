#pragma once

#include <optional>

#include "kinegraph/kinematics/kinematic_model.h"

namespace kinegraph {

/// By how much q may pass a limit and still counts as within: rad or m. Files round (single precision: 1e-7), and so do
/// those who write +-3.14159 for a full turn.
inline constexpr double kLimitTolerance = 1e-5;

/// A dof that leaves its limits on a motion of q.
struct LimitPassed {
  double time = 0.;    ///< in [0, 1]: where it passes them; 0 if it begins beyond
  int dof = 0;         ///< entry of q
  double beyond = 0.;  ///< then, rad or m: more than 0 only at time 0
};

/// Are all dofs within their limits, to kLimitTolerance?
bool withinLimits(const KinematicModel& model, const double* q);

/// The first dof that the straight motion between two q brings beyond its limits by more than kLimitTolerance.
std::optional<LimitPassed> firstLimitPassed(const KinematicModel& model, const double* from, const double* to);

/// The frame whose joint has a dof of q.
int frameOfDof(const KinematicModel& model, int dof);

}  // namespace kinegraph
