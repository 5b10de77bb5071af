#pragma once

#include "kinegraph/komo/komo.h"
#include "kinegraph/komo/objective.h"

namespace kinegraph::inline komo_internal {

/// Returns the problem of a Komo with at least one slice, with these objectives instead of its own.
std::shared_ptr<Nlp> makeNlp(std::shared_ptr<Komo> komo, std::vector<Objective> objectives);

}  // namespace kinegraph::inline komo_internal
