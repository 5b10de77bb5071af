#pragma once

#include <span>
#include <string>
#include <string_view>

namespace kinegraph::python {

/// A message of the core in the names that Python has for things: `NlpSolver` is NLP_Solver, `OptMethod::newton` is
/// OptMethod.newton, `first=false` is first=False. What stands in '...' or after "similar names:" is the
/// user's, and stays, and so do `users`. All messages go through here where they leave C++: errors, warnings, and those
/// of results.
std::string inPython(std::string_view whole, std::span<const std::string> users = {});

}  // namespace kinegraph::python
