#pragma once

#include <string>
#include <string_view>

#include "kinegraph/logic/domain.h"

namespace kinegraph {

/// Reads a domain in PDDL: STRIPS with types, constants, negative preconditions and equality. A type is a predicate of one
/// argument. Throws ParseError with file:line:column, what was expected and what is near: unknown predicates and types,
/// variables that are no parameters, another number of arguments, and what is beyond this part of the language.
LogicDomain readPddlDomain(std::string_view text, const std::string& file = {});

/// Reads a problem of a domain. Throws ParseError; also for objects that are not there and for the problem of another
/// domain.
LogicProblem readPddlProblem(std::string_view text, const LogicDomain& domain, const std::string& file = {});

/// Write what the readers read. Throw ValueError for rules that fire by themselves and for ANY, which PDDL does not have.
std::string writePddlDomain(const LogicDomain& domain);
std::string writePddlProblem(const LogicProblem& problem);

}  // namespace kinegraph
