#pragma once

#include <string>
#include <vector>

#include "kinegraph/komo/komo.h"

namespace kinegraph {

/// How large the residuals of a motion problem are at its present path.
struct PathErrors {
  std::vector<double> per_objective;  ///< sum over its slices
  MatrixXd per_slice;                 ///< T x objectives
  ErrorSums totals;                   ///< see sumErrors
};

/// A residual counts with its square (sos, and ineqP where it is positive), its absolute value (eq), what is above zero
/// (ineq, ineqB), or as it is (f).
PathErrors measurePath(const Komo& komo);

/// A short name: "F_qItself/acc[#14]", "F_PositionDiff[l_gripper,target]".
std::string objectiveTag(const Komo& komo, const Objective& objective);

/// The tag of its objective for each residual of the problem.
std::vector<std::string> residualTags(const Komo& komo);

/// The objectives with an error above 1e-4 in a slice, largest first, a line each. `per_slice` as in PathErrors.
std::string sliceErrors(const Komo& komo, int slice, const MatrixXd& per_slice);

/// The pairs of shapes that are nearer than `margin` (m) in a slice, a line each.
std::string sliceCollisions(const Komo& komo, int slice, double margin);

}  // namespace kinegraph
