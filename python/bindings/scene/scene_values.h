#pragma once

#include "bindings.h"

namespace kinegraph::python {

/// A value of the .g language as Python object, and back. `name` is what messages call it.
nb::object fromValue(const Value& value);
Value toValue(nb::handle value, const std::string& name);
nb::dict toDict(const Graph& graph);

/// "<Frame 'table': ssBox, parent 'world'>"
std::string describe(const Frame& frame);

}  // namespace kinegraph::python
