#pragma once

#include <functional>

#include "kinegraph/nlp/nlp.h"

namespace kinegraph {

/// Receives every evaluated point of a solver. The solver ends if it returns false.
using EvaluationCallback = std::function<bool(const VectorXd& x, const VectorXd& phi)>;

}  // namespace kinegraph
