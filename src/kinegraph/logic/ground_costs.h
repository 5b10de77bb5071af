#pragma once

#include "kinegraph/logic/grounding.h"

namespace kinegraph::inline logic_internal {

/// Sets the costs of all actions from the functions of the problem, as whole multiples of a power of ten, so that their
/// sums are exact. Throws ParseError for a function without value or with a negative one, and ValueError for costs with
/// more than 6 decimals or above 1e9 units.
void setActionCosts(GroundProblem& ground);

}  // namespace kinegraph::inline logic_internal
