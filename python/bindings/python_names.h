#pragma once

#include <span>
#include <string>
#include <string_view>

namespace kinegraph::python {

/// Translates a message of the core to Python's names: `NlpSolver` becomes NLP_Solver, `OptMethod::newton`
/// OptMethod.newton, `first=false` first=False. Text in '...' or after "similar names:" and the names `users` come from
/// the user and stay unchanged. Errors, warnings and messages of results pass through this function when they leave
/// C++.
std::string inPython(std::string_view whole, std::span<const std::string> users = {});

}  // namespace kinegraph::python
