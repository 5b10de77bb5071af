#pragma once

#include <vector>

#include "kinegraph/komo/objective.h"
#include "kinegraph/nlp/nlp.h"

namespace kinegraph {

/// Where a residual of a motion problem comes from.
struct PathRow {
  int objective;  ///< its place among the objectives of the Komo
  int slice;
  int row;  ///< among those that the objective has in the slice
};

/// Of all residuals of a problem that was made from a Komo, or of its separate form. Empty for other problems.
std::vector<PathRow> pathRows(const Nlp& nlp);

/// An objective in a slice, as such a problem evaluates it.
struct PathTerm {
  int objective, slice;
  int first_row, rows;
  bool is_linear;       ///< of joints only
  bool comes_and_goes;  ///< rows may be left out of the Jacobian
};
std::vector<PathTerm> pathTerms(const Nlp& nlp);

/// Evaluates some of these at the present path, among them all or none that come and go; other rows are left as they are.
void evaluatePathTerms(Nlp& nlp, const std::vector<int>& terms, VectorXd& phi, Jacobian& J);

/// Its objectives, as they were when it was made from a Komo; null for other problems. Of its separate form: as they
/// are there.
const std::vector<Objective>* objectivesOf(const Nlp& nlp);

}  // namespace kinegraph
