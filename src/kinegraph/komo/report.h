#pragma once

#include <string>
#include <vector>

#include "kinegraph/komo/komo.h"

namespace kinegraph {

struct Objective;

/// Residuals of a trajectory optimization problem at its present path, summed by objective and slice.
struct PathErrors {
  std::vector<double> per_objective;  ///< sum over its slices
  MatrixXd per_slice;                 ///< T x objectives
  ErrorSums totals;                   ///< see sumErrors
};

/// Computes the errors of the present path. A residual counts with its square (sos, and ineqP if positive), its
/// absolute value (eq), its positive part (ineq, ineqB), or its value (f).
PathErrors measurePath(const Komo& komo);

/// Returns a short name such as "F_qItself/acc[#14]" or "F_PositionDiff[l_gripper,target]".
std::string objectiveTag(const Komo& komo, const Objective& objective);

/// Returns the tag of the objective of each residual.
std::vector<std::string> residualTags(const Komo& komo);

/// Lists the objectives with an error above 1e-4 in a slice, largest first, one per line. `per_slice` as in PathErrors.
std::string sliceErrors(const Komo& komo, int slice, const MatrixXd& per_slice);

/// Lists the pairs of shapes closer than `margin` (m) in a slice, one per line.
std::string sliceCollisions(const Komo& komo, int slice, double margin);

}  // namespace kinegraph
