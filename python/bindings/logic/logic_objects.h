#pragma once

#include <memory>

#include "kinegraph/logic/plan_search.h"

namespace kinegraph::python {

/// Plans in words; Ctrl-C ends the search.
struct PyPlanSearch {
  std::shared_ptr<PlanSearch> search;

  const GroundProblem& ground() const { return search->problem(); }
};

}  // namespace kinegraph::python
