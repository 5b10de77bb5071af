#pragma once

#include "kinegraph/planning/plan_motions.h"
#include "option_class.h"

namespace kinegraph::python {

/// A plan, and the scene that it was made in, as it was then.
struct PyMotionPlan : MotionPlan {
  std::shared_ptr<const Config> config;
};

/// The plans, and their scene.
struct PyMotionPlans {
  std::shared_ptr<const Config> config;
  MotionPlans plans;
};

/// Options of planMotion by name.
const OptionClass<PlanOptions>& planOptionClass();

/// copy.copy and pickle.
void bindPlanCopies(nb::class_<MotionConstraint>& constraint, nb::class_<PyMotionPlan>& plan);

}  // namespace kinegraph::python
