#pragma once

#include <string>
#include <vector>

#include "bindings.h"
#include "kinegraph/planning/plan_options.h"

namespace kinegraph::python {

/// The calls that take the options of planMotion as keyword arguments.
enum class PlanCall { plan, plans, replan };

/// "margin: float = 0.0, optimize: ...": the options of a call, for its signature. Those of `replan` are optional: None
/// keeps the option of the running motion.
std::string planArguments(PlanCall call);

/// An entry per option for the Args section of a docstring, in the same order.
std::string planArgumentDocs(PlanCall call);

/// Reads the keyword arguments of a call into options. Throws ValueError with similar names for an unknown option.
PlanOptions planOptionsFrom(nb::kwargs arguments, PlanCall call, PlanOptions options = {});

}  // namespace kinegraph::python
