#pragma once

#include <optional>

namespace kinegraph {

struct KinematicModel;

/// Tolerance of joint limits, rad or m. Files round: single precision by 1e-7, and 3.14159 for pi by 3e-6.
inline constexpr double kLimitTolerance = 1e-5;

/// A dof that leaves its limits along an edge.
struct LimitPassed {
  double time = 0.;    ///< in [0, 1]: when it leaves them; 0 if it begins outside
  int dof = 0;         ///< entry of q
  double beyond = 0.;  ///< excess at that time, rad or m; positive only at time 0
};

/// Whether all dofs are within their limits, to kLimitTolerance.
bool withinLimits(const KinematicModel& model, const double* q);

/// The first dof that exceeds its limits by more than kLimitTolerance along the edge between two q.
std::optional<LimitPassed> firstLimitPassed(const KinematicModel& model, const double* from, const double* to);

/// The frame of the joint of a dof.
int frameOfDof(const KinematicModel& model, int dof);

}  // namespace kinegraph
