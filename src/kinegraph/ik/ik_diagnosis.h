#pragma once

#include <string>

#include "kinegraph/ik/ik_iterate.h"

namespace kinegraph::inline ik_internal {

/// Describes why a job has no answer: the targets that are missed at the iterate, the pairs that collide, and the
/// joints at limits. Recomputes the iterate's Jacobian.
std::string describeFailure(const IkProblem& problem, const IkJob& job, IkIterate& iterate);

}  // namespace kinegraph::inline ik_internal
