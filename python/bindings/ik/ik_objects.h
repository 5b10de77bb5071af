#pragma once

#include <string>
#include <vector>

#include "bindings.h"
#include "kinegraph/ik/solve_ik.h"

NB_MAKE_OPAQUE(std::vector<kinegraph::IkResult>)  // a type of its own in Python, and no list

namespace kinegraph::python {

/// Answers of a batch.
using IkResults = std::vector<IkResult>;

/// What Python prints of them.
std::string resultText(const IkResult& result);
std::string resultsText(const IkResults& results);

/// Sets options by name, and checks them; `tolerance` sets that of positions and of rotations. Throws ValueError.
void setFields(IkOptions& options, nb::dict given);

void bindIkOptions(nb::module_& m);
void bindIkResults(nb::module_& m);

}  // namespace kinegraph::python
