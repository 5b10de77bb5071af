#pragma once

#include <string>
#include <string_view>

#include "kinegraph/logic/domain.h"

namespace kinegraph {

/// Reads a domain in PDDL: types, constants, `either`; and, or, not, imply, forall, exists and = in conditions; and,
/// not, when, forall and (increase (total-cost) ...) in effects; derived predicates. Requirements do not matter. Names
/// are compared without case and keep their first spelling. A type is a unary predicate; if a predicate has its name,
/// it begins with kTypePrefix. The text may contain the problem, too. Throws ParseError with file:line:column, the
/// expectation and similar names: for unknown predicates and types, variables that are no parameters, wrong numbers of
/// arguments, effects on derived predicates, and other parts of the language (numbers besides costs, durations,
/// preferences).
LogicDomain readPddlDomain(std::string_view text, const std::string& file = {});

/// Reads a problem of a domain, with (:metric minimize (total-cost)). Throws ParseError, also for unknown objects and
/// for the problem of another domain.
LogicProblem readPddlProblem(std::string_view text, const LogicDomain& domain, const std::string& file = {});

/// Write domains and problems in PDDL, so that they are read as the same. ANY becomes a quantifier. A predicate with
/// several numbers of arguments gets a name for each, `on` and `on-3`. Throw ValueError for automatic rules, and for
/// names that differ in case alone.
std::string writePddlDomain(const LogicDomain& domain);
std::string writePddlProblem(const LogicProblem& problem);

}  // namespace kinegraph
