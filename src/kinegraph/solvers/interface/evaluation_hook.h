#pragma once

#include <functional>

#include "kinegraph/nlp/nlp.h"

namespace kinegraph {

/// Called at every evaluated point; returning false stops the solver.
using EvaluationHook = std::function<bool(const VectorXd& x, const VectorXd& phi)>;

}  // namespace kinegraph
