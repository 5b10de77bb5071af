#pragma once

#include <nanobind/nanobind.h>

namespace kinegraph::python {

/// Functions of the module, and of its classes, say what is wrong with arguments that they do not take, and what may have been
/// meant: `kinegraph.call_errors.explain`. To be called once all are bound.
void explainWrongArguments(nanobind::module_& m);

}  // namespace kinegraph::python
