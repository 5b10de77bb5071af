#pragma once

#include "kinegraph/nlp/nlp.h"

namespace kinegraph {

/// Throws ValueError if `x0` has another size than the problem, or numbers that are not finite.
void requireStart(const Nlp& nlp, const VectorXd& x0);

/// Throws ValueError if there are constraints, naming the method and the first of them.
void requireNoConstraints(const Nlp& nlp, const char* method);

}  // namespace kinegraph
