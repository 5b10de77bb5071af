#pragma once

#include "kinegraph/nlp/nlp.h"

namespace kinegraph::inline nlp_internal {

/// Prepares an evaluation: resizes phi. Throws ValueError unless x and J (which may be null) have the sizes of the
/// problem.
void prepareEvaluation(const Nlp& nlp, const VectorXd& x, VectorXd& phi, const Jacobian* J);

}  // namespace kinegraph::inline nlp_internal
