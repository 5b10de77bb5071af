#pragma once

#include <vector>

#include "kinegraph/komo/objective.h"
#include "kinegraph/nlp/nlp.h"

namespace kinegraph::inline komo_internal {

/// Origin of a residual component of a trajectory optimization problem.
struct PathComponent {
  int objective;  ///< index among the objectives of the Komo
  int slice;
  int row;  ///< index among the components of the objective in this slice
};

/// Returns the origins of all residuals of a problem made from a Komo, or of its separate form. Empty for other
/// problems.
std::vector<PathComponent> pathComponents(const Nlp& nlp);

/// An objective in a slice, the unit in which such a problem is evaluated.
struct PathTerm {
  int objective, slice;
  int first_row, rows;
  bool is_linear;  ///< depends on joints only, linearly
  bool is_sparse;  ///< zero rows are omitted from the Jacobian
};
std::vector<PathTerm> pathTerms(const Nlp& nlp);

/// Evaluates some of these terms at the present path and leaves other rows unchanged. `terms` contains either all
/// sparse terms or none.
void evaluatePathTerms(Nlp& nlp, const std::vector<int>& terms, VectorXd& phi, Jacobian& J);

/// Returns the objectives of a problem made from a Komo, as they were then, or those of its separate form; null for
/// other problems.
const std::vector<Objective>* objectivesOf(const Nlp& nlp);

}  // namespace kinegraph::inline komo_internal
