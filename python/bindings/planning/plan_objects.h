#pragma once

#include "kinegraph/planning/plan_motion.h"
#include "option_class.h"

namespace kinegraph::python {

/// A plan with a copy of its scene at the time of the call.
struct PyMotionPlan : MotionPlan {
  PyMotionPlan() = default;
  PyMotionPlan(MotionPlan plan, std::shared_ptr<const Config> config)
      : MotionPlan(std::move(plan)), config(std::move(config)) {}

  std::shared_ptr<const Config> config;
};

using MotionPlanClass = nb::class_<PyMotionPlan, Trajectory>;

/// The sequence of plans with a copy of its scene.
struct PyMotionPlans {
  std::shared_ptr<const Config> config;
  MotionPlans plans;
};

/// The options of planMotion by name.
const OptionClass<PlanOptions>& planOptionClass();

/// Reads a MotionConstraint or a list of them.
std::vector<MotionConstraint> planConstraintsOf(nb::handle value);

/// Binds copying and pickling.
void bindPlanCopies(nb::class_<MotionConstraint>& constraint, MotionPlanClass& plan);

}  // namespace kinegraph::python
