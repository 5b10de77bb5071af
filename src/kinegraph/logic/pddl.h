#pragma once

#include <string>
#include <string_view>

#include "kinegraph/logic/domain.h"

namespace kinegraph {

/// Reads a domain in PDDL: STRIPS with types, constants, negative preconditions and equality. A type is a unary
/// predicate. Throws ParseError with file:line:column, the expectation and similar names: for unknown predicates and
/// types, variables that are no parameters, wrong numbers of arguments, and other parts of the language.
LogicDomain readPddlDomain(std::string_view text, const std::string& file = {});

/// Reads a problem of a domain. Throws ParseError, also for unknown objects and for the problem of another domain.
LogicProblem readPddlProblem(std::string_view text, const LogicDomain& domain, const std::string& file = {});

/// Write domains and problems in PDDL. Throw ValueError for automatic rules and for ANY, which PDDL lacks.
std::string writePddlDomain(const LogicDomain& domain);
std::string writePddlProblem(const LogicProblem& problem);

}  // namespace kinegraph
