#pragma once

#include "kinegraph/nlp/nlp.h"

namespace kinegraph {

/// For the beginning of an `evaluate`: sizes phi, and throws ValueError if x or J (which may be null) do not have the
/// sizes of the problem.
void prepareEvaluation(const Nlp& nlp, const VectorXd& x, VectorXd& phi, const Jacobian* J);

}  // namespace kinegraph
