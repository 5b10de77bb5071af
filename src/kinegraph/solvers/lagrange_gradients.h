#pragma once

#include <string>
#include <vector>

#include "kinegraph/nlp/nlp.h"

namespace kinegraph::inline solvers_internal {

/// The contribution of residuals of one name to the gradient of the Lagrangian at a point.
struct LagrangeGradient {
  std::string name;
  ObjectiveType type = ObjectiveType::none;
  double error = 0.;     ///< sum of phi (f), phi^2 (sos), or violations
  double gradient = 0.;  ///< norm of their sum of J (f), 2 phi J (sos), or dual J (constraints)
};

/// Returns the contributions of residuals with an error or a multiplier, by name and type, the largest gradient first.
/// An active constraint has no error but a multiplier. `dual`: one multiplier per residual, or empty for zeros.
/// `names`: one per residual, or empty for the names of the objectives. Throws ValueError for other sizes.
std::vector<LagrangeGradient> lagrangeGradients(Nlp& nlp, const VectorXd& x, const VectorXd& dual,
                                                const std::vector<std::string>& names = {});

}  // namespace kinegraph::inline solvers_internal
