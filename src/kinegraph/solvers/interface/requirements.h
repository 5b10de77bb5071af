#pragma once

#include "kinegraph/nlp/nlp.h"

namespace kinegraph::inline solvers_internal {

/// Throws ValueError unless `x0` has the size of the problem and finite entries.
void requireStart(const Nlp& nlp, const VectorXd& x0);

/// Throws ValueError with the method and the first constraint if the problem has constraints.
void requireNoConstraints(const Nlp& nlp, const char* method);

}  // namespace kinegraph::inline solvers_internal
