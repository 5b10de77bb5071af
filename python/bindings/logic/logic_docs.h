#pragma once

/// Docstrings of bind_logic.cpp.
namespace kinegraph::python::docs::logic {

// Shared parts.
#define KINEGRAPH_OF_FILE               \
  "Args:\n"                             \
  "    file: Name of the file.\n"       \
  "Returns:\n"                          \
  "    The domain.\n"                   \
  "Raises:\n"                           \
  "    FileError: It cannot be read.\n" \
  "    ParseError: The file is invalid; the message begins with file:line:column."
#define KINEGRAPH_OF_TEXT             \
  "Args:\n"                           \
  "    text: The text.\n"             \
  "    name: Its name in messages.\n" \
  "Returns:\n"                        \
  "    The domain.\n"                 \
  "Raises:\n"                         \
  "    ParseError: The text is invalid; the message begins with name:line:column."

inline constexpr char fromFol[] = R"(Reads a domain from a .fol file.

)" KINEGRAPH_OF_FILE;

inline constexpr char fromFolText[] = R"(Reads a domain from text in the language of .fol files.

)" KINEGRAPH_OF_TEXT;

inline constexpr char fromPddl[] = R"(Reads a domain from a PDDL file.

Conditions have and, or, not, imply, forall, exists and =; effects and, not, when, forall and (increase (total-cost)
...). Types may have several supertypes, and `either`. Names are compared without case. Requirements are not needed. The
file may contain the problem, too.

)" KINEGRAPH_OF_FILE;

inline constexpr char fromPddlText[] =
    R"(Reads a domain from text in PDDL, as fromPddl does.

)" KINEGRAPH_OF_TEXT;

inline constexpr char toPddl[] = R"(Writes the domain in PDDL, so that fromPddl reads the same domain.

ANY becomes a quantifier. A predicate with several numbers of arguments gets a name for each, as `on` and `on-3`.

Returns:
    The text.
Raises:
    ArgumentError: The domain has automatic rules, or names that differ in case alone.)";

inline constexpr char toFol[] = R"(Writes the domain in the language of .fol files.

Returns:
    The text.
Raises:
    ArgumentError: The domain has or, forall, exists or when, which .fol files lack.)";

inline constexpr char cost[] = R"(Returns the cost of a sequence of actions; their number if the problem has no metric.

Args:
    actions: A list of actions, each a list of words.
Returns:
    The sum of the costs.
Raises:
    ArgumentError: An action is unknown.)";

inline constexpr char addAction[] = R"(Adds an action. Unknown words become symbols.

Args:
    name: Its name.
    variables: Names of its variables; a plan has their values in this order.
    pre: Literals that must hold, as (on Place Obj) (busy Hand)!.
    eff: Literals that the action makes true or, with !, false, in this order.
Raises:
    ParseError: A literal is invalid, or no positive literal of the precondition has a variable.)";

inline constexpr char problem[] = R"(Makes a problem of a domain.

Args:
    domain: The domain.
    start: Initial facts in addition to those of the domain, as (on table cup).
    goal: Literals that shall hold or, with !, not hold.
Raises:
    ParseError: A literal is invalid.)";

inline constexpr char problemFromPddl[] = R"(Reads a problem from a PDDL file, with its goal and metric.

Args:
    domain: The domain.
    file: The file's name.
Returns:
    The problem.
Raises:
    FileError: It cannot be read.
    ParseError: The file is invalid; the message begins with file:line:column.)";

inline constexpr char problemToPddl[] = R"(Writes the problem in PDDL, so that fromPddl reads the same problem.

Returns:
    The text.
Raises:
    ArgumentError: The goal has a predicate that no action has, and does not hold at the start.)";

inline constexpr char search[] = R"(Prepares the enumeration of the plans of a problem.

The shortest plans come first. If the problem has a metric, the cheapest come first, and of equal cost the shortest.

Args:
    problem: The problem.
    max_expansions: Maximum number of states that are expanded.
Raises:
    ParseError: A word of the goal is unknown, or no rule and no fact has its number of arguments.
    ArgumentError: There are too many actions.)";

inline constexpr char next[] = R"(Returns the next plan.

Returns:
    A list of actions, each a list of words: its name and the values of its variables. None if there is no further plan
    (PlanSearchStatus.exhausted, a proof), or if the search reached its limit (PlanSearchStatus.limit).
Raises:
    KeyboardInterrupt: Ctrl-C was pressed.)";

inline constexpr char forbid[] =
    R"(Forbids an action in all states in which some facts hold, in further plans.

Args:
    action: Its words.
    facts: Literals, as (on table cup); none: the action is always forbidden.
Raises:
    ArgumentError: The action is unknown, or a fact can never hold.)";

inline constexpr char forbidBeginning[] = R"(Excludes further plans that begin with these actions.

Args:
    actions: A list of actions, each a list of words.
Raises:
    ArgumentError: An action is unknown.)";

inline constexpr char states[] = R"(Returns the states along a sequence of actions, the initial state first.

Args:
    actions: A list of actions, each a list of words.
Returns:
    A list of states, each a list of literals.
Raises:
    ArgumentError: An action is unknown, or its precondition does not hold.)";

inline constexpr char sceneFacts[] =
    R"(Returns the facts of a scene: labels of frames with `logical: { ... }`, objects, and their places.

Args:
    C: The scene.
Returns:
    Literals, as (on table cup).)";

#undef KINEGRAPH_OF_FILE
#undef KINEGRAPH_OF_TEXT

}  // namespace kinegraph::python::docs::logic
