#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "kinegraph/common/errors.h"

namespace kinegraph {

/// A predicate with arguments, `(on table cup)`, or its negation, `(on table cup)!`. Arguments are constants or
/// variables of the rule. `(height cup)=2` is the predicate `height=` with the value as the last argument.
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

/// Whether a predicate has a value, `(height cup)=2`.
inline bool hasValue(std::string_view predicate) { return predicate.size() > 1 && predicate.ends_with('='); }

/// A condition in negation normal form: what PDDL has beyond a list of literals.
struct Formula {
  enum class Kind { literal, all, any, forall, exists };
  Kind kind = Kind::all;
  Literal literal = {};                                 ///< of Kind::literal
  std::vector<Formula> parts = {};                      ///< one for quantifiers; `all` without parts is true
  std::vector<std::string> variables = {}, types = {};  ///< of quantifiers; a type "" means any object

  /// `(or (on table cup) (not (exists ...)))`, as in PDDL
  std::string str() const;
  bool operator==(const Formula&) const = default;
};

/// Effects that apply if a condition holds before the action, for all values of own variables.
struct ConditionalEffect {
  std::vector<std::string> variables = {}, types = {};
  Formula when = {};
  std::vector<Literal> eff = {};
  bool operator==(const ConditionalEffect&) const = default;
};

/// An action (a decision), a rule that fires automatically, or the definition of a derived predicate. If the
/// precondition holds, the effects apply in order.
struct LogicRule {
  std::string name;
  std::vector<std::string> variables;
  std::vector<std::string> types = {};  ///< unary predicates, one per variable, "": any object; empty: all untyped
  std::vector<Literal> pre, eff;
  bool is_decision = true;
  SourcePosition where = {};
  // PDDL only
  bool is_derived = false;  ///< no decision: `eff`, one fact, holds exactly while a rule for it holds (:derived)
  std::vector<Formula> conditions = {};             ///< they hold in addition to `pre`
  std::vector<ConditionalEffect> conditional = {};  ///< simultaneous with `eff`; an added fact is not deleted
  double cost = 0;                                  ///< the constant part
  std::vector<Literal> cost_functions = {};         ///< their values in the problem are added
};

/// A predicate or a function with its arguments, `(on ?p - place ?x)`.
struct Signature {
  std::string name;
  std::vector<std::string> variables = {}, types = {};  ///< a type "" means any object
  bool operator==(const Signature&) const = default;
};

/// Actions and rules, with their predicates and constants.
struct LogicDomain {
  std::string name = "domain";
  std::vector<std::string> symbols;  ///< predicates and constants, in the order of declaration
  std::vector<LogicRule> rules;
  std::vector<std::pair<std::string, std::string>> types;  ///< type, supertype or ""; PDDL only; several per type
  std::vector<Literal> start;                              ///< initial facts of every problem
  bool distinct_variables = true;                          ///< different variables are different objects; false in PDDL
  // PDDL only
  std::vector<std::string> constants = {};
  std::vector<Signature> predicates = {}, functions = {};
};

/// Begins the name of a type that has the name of a predicate: types and predicates of PDDL have separate names.
inline constexpr std::string_view kTypePrefix = "type:";

/// The value of a function, as the cost `(= (length a b) 3)`.
struct FunctionValue {
  Literal function;
  double value = 0;
};

/// A domain, objects, initial facts, and a goal.
struct LogicProblem {
  std::string name = "problem";
  LogicDomain domain;
  std::vector<std::string> constants;
  std::vector<Literal> start;  ///< those of the domain included
  std::vector<Literal> goal;
  // PDDL only
  std::vector<Formula> goal_conditions = {};  ///< they hold in addition to `goal`
  std::vector<FunctionValue> values = {};
  bool minimize_cost = false;  ///< the sum of the actions' costs; false: the number of actions
};

/// Reads a domain in the language of `.fol` files:
///
///     on  busy  is_gripper                     # symbols
///     START_STATE { (busy left) }
///     DecisionRule pick { Obj, From, Hand,
///       { (is_gripper Hand) (on From Obj) (busy Hand)! }
///       { (on From Obj)! (on Hand Obj) (busy Hand) } }
///     Rule chain { A, B, { (on A B) (moves A) } { (moves B) } }
///
/// Commas and line breaks are spaces; `pre:` and `eff:` may precede the blocks. ANY matches any constant: some fact in
/// a precondition, all facts in a delete. `Include = 'words.g'` reads a file relative to this one. `(height cup)=2` is
/// a fact with a value, and an effect replaces the value. Facts of one predicate with different numbers of arguments
/// are different facts. FOL_World and REWARD are read and ignored. Throws ParseError with file:line:column, the
/// expectation and similar names: for undeclared words, for variables that no positive literal of the precondition
/// binds, and for probabilities and `aggregate`, which are not supported.
LogicDomain readFol(std::string_view text, const std::string& file = {});

/// Reads a domain from a file; also throws FileError.
LogicDomain readFolFile(const std::string& path);

/// Reads a list of literals, as a goal: `(on tray cup) (busy left)!`
std::vector<Literal> readLiterals(std::string_view text, const std::string& file = {});

/// Adds an action, with its precondition and effects as lists of literals. Unknown words become symbols. Throws
/// ParseError as readFol does.
///
///     addAction(domain, "show", {"Obj", "Hand"}, "(is_gripper Hand) (on Hand Obj)", "(shown Obj)");
void addAction(LogicDomain& domain, const std::string& name, const std::vector<std::string>& variables,
               std::string_view pre, std::string_view eff);

/// Writes a domain in the same language. Throws ValueError for conditions and effects of PDDL that it lacks.
std::string writeFol(const LogicDomain& domain);

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
std::string writePddlProblem(const LogicProblem& problem);  ///< the same for a problem

}  // namespace kinegraph
