#pragma once

#include <string>
#include <vector>

#include "kinegraph/nlp/nlp.h"

namespace kinegraph {

/// What residuals of one name do to a problem at a point.
struct LagrangeGradient {
  std::string name;
  ObjectiveType type = ObjectiveType::none;
  double error = 0.;  ///< f: phi, sos: phi^2, else the violation; their sum
  double gradient =
      0.;  ///< length of their part of the Lagrangian's gradient: J for f, 2 phi J for sos, dual J for constraints
};

/// The residuals by name and type, the largest gradient first; those without error are left out. `dual` has an entry
/// per residual, or none: then those of constraints are taken as 0. `names`: one per residual; empty: the objectives'
/// names. Throws ValueError for sizes that do not fit.
std::vector<LagrangeGradient> lagrangeGradients(Nlp& nlp, const VectorXd& x, const VectorXd& dual,
                                                const std::vector<std::string>& names = {});

}  // namespace kinegraph
