#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "kinegraph/common/errors.h"

namespace kinegraph {

/// A predicate of some arguments, `(on table cup)`, or that it does not hold, `(on table cup)!`. Arguments are constants,
/// or variables of the rule that it is part of.
struct Literal {
  std::string predicate;
  std::vector<std::string> arguments = {};
  bool negated = false;
  SourcePosition where = {};

  /// `(on table cup)!`
  std::string str() const;
  bool operator==(const Literal& other) const {
    return predicate == other.predicate && arguments == other.arguments && negated == other.negated;
  }
};

/// `(a b) (c)!`
std::string str(const std::vector<Literal>& literals);

/// What matches any constant, where it stands for an argument.
inline constexpr std::string_view kAny = "ANY";

/// The predicate of two arguments that holds if they are the same; it is not written by effects.
inline constexpr std::string_view kEqual = "=";

/// What can be done (a decision), or what follows by itself: where the precondition holds, the effects happen, in their
/// order.
struct LogicRule {
  std::string name;
  std::vector<std::string> variables;
  std::vector<std::string> types = {};  ///< of the variables, each a predicate of one argument; empty: none has one
  std::vector<Literal> pre, eff;
  bool is_decision = true;
  SourcePosition where = {};
};

/// Actions and rules, and the words that they are made of.
struct LogicDomain {
  std::string name = "domain";
  std::vector<std::string> symbols;  ///< predicates and constants, in the order in which they were declared
  std::vector<LogicRule> rules;
  std::vector<std::pair<std::string, std::string>> types;  ///< type, supertype; PDDL only
  std::vector<Literal> start;                              ///< facts that every problem begins with
  bool distinct_variables = true;  ///< different variables of a rule are different things; not so in PDDL
};

/// A domain, what there is, what holds at the start, and what shall hold at the end.
struct LogicProblem {
  std::string name = "problem";
  LogicDomain domain;
  std::vector<std::string> constants;
  std::vector<Literal> start;  ///< those of the domain included
  std::vector<Literal> goal;
};

}  // namespace kinegraph
