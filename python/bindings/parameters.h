#pragma once

#include <string>

#include "bindings.h"
#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"

namespace kinegraph::python {

/// A parameter that `params_add` has set; `otherwise` where it has not. Throws ValueError, with what is expected. Needs the
/// interpreter lock.
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
