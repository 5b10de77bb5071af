#pragma once

#include <nanobind/nanobind.h>

namespace kinegraph::python {

/// Makes all functions of the module and its classes explain arguments that they do not accept, with suggestions; see
/// `kinegraph.call_errors.explain`. Call it after all bindings are registered.
void explainWrongArguments(nanobind::module_& m);

}  // namespace kinegraph::python
