#pragma once

#include <string>

#include "bindings.h"
#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"

namespace kinegraph::python {

/// The parameter set by `params_add`, or `otherwise`. Throws ValueError with the expected type. Requires the GIL.
template <class T>
T parameter(const char* name, const T& otherwise, const char* expected) {
  const nb::object set = nb::module_::import_("kinegraph.compatibility.parameters").attr("params_get")();
  const nb::object value = set.attr("get")(name, nb::cast(otherwise));
  try {
    return nb::cast<T>(value);
  } catch (const nb::cast_error&) {
    throw ValueError(cat("parameter ", name, " is ", nb::cast<std::string>(nb::repr(value)), "; expected ", expected));
  }
}

}  // namespace kinegraph::python
