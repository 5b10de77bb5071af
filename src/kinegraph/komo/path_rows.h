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

/// Its objectives, as they were when it was made from a Komo; null for other problems. Of its separate form: as they
/// are there.
const std::vector<Objective>* objectivesOf(const Nlp& nlp);

}  // namespace kinegraph
