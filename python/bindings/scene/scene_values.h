#pragma once

#include "bindings.h"

namespace kinegraph::python {

/// Converts a value of the .g language to a Python object, and back. `name` is its name in messages.
nb::object fromValue(const Value& value);
Value toValue(nb::handle value, const std::string& name);
nb::dict toDict(const Graph& graph);

/// "<Frame 'table': ssBox, parent 'world'>"
std::string describe(const Frame& frame);

}  // namespace kinegraph::python
