#pragma once

#include <functional>
#include <memory>
#include <string>

#include "kinegraph/common/cancellation.h"
#include "kinegraph/komo/komo.h"

namespace kinegraph::inline task_planning_internal {

/// Returns the constraint that conflicts with the others at the current path of a problem, as "cup and table overlap by
/// 3 mm"; "" if all hold. `cancellation` is queried at every evaluation, and may throw.
std::string violatedConstraint(const std::shared_ptr<Komo>& komo, const CancellationToken& cancellation = {});

}  // namespace kinegraph::inline task_planning_internal
