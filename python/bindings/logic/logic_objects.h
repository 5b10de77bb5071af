#pragma once

#include <memory>

#include "bindings.h"
#include "kinegraph/logic/plan_search.h"

namespace kinegraph::python {

/// A search whose plans are lists of words; Ctrl-C ends it.
struct PyPlanSearch {
  std::shared_ptr<PlanSearch> search;

  const GroundProblem& ground() const { return search->problem(); }
};

void bindDomainCopies(nb::class_<LogicDomain>& domain);  ///< copy.copy and pickle

}  // namespace kinegraph::python
