#pragma once

#include <string>
#include <vector>

#include "bindings.h"
#include "kinegraph/ik/solve_ik.h"

NB_MAKE_OPAQUE(std::vector<kinegraph::IkResult>)  // a separate Python type instead of a list

namespace kinegraph::python {

/// Results of a batch.
using IkResults = std::vector<IkResult>;

/// Return the texts that Python prints for results.
std::string resultText(const IkResult& result);
std::string resultsText(const IkResults& results);

/// Sets options by name and validates them; `tolerance` sets the tolerances of positions and rotations. Throws
/// ValueError.
void setFields(IkOptions& options, nb::dict given);

void bindIkOptions(nb::module_& m);
void bindIkResults(nb::module_& m);

}  // namespace kinegraph::python
