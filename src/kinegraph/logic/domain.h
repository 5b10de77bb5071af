#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "kinegraph/common/errors.h"

namespace kinegraph {

/// A predicate with arguments, `(on table cup)`, or its negation, `(on table cup)!`. Arguments are constants or
/// variables of the rule.
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

/// The argument that matches any constant.
inline constexpr std::string_view kAny = "ANY";

/// The equality predicate; effects must not contain it.
inline constexpr std::string_view kEqual = "=";

/// An action (a decision), or a rule that fires automatically. If the precondition holds, the effects apply in order.
struct LogicRule {
  std::string name;
  std::vector<std::string> variables;
  std::vector<std::string> types = {};  ///< unary predicates, one per variable; empty: untyped
  std::vector<Literal> pre, eff;
  bool is_decision = true;
  SourcePosition where = {};
};

/// Actions and rules, with their predicates and constants.
struct LogicDomain {
  std::string name = "domain";
  std::vector<std::string> symbols;  ///< predicates and constants, in the order of declaration
  std::vector<LogicRule> rules;
  std::vector<std::pair<std::string, std::string>> types;  ///< type, supertype; PDDL only
  std::vector<Literal> start;                              ///< initial facts of every problem
  bool distinct_variables = true;                          ///< different variables are different objects; false in PDDL
};

/// A domain, objects, initial facts, and a goal.
struct LogicProblem {
  std::string name = "problem";
  LogicDomain domain;
  std::vector<std::string> constants;
  std::vector<Literal> start;  ///< those of the domain included
  std::vector<Literal> goal;
};

}  // namespace kinegraph
