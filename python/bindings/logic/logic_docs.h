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

inline constexpr char fromPddl[] = R"(Reads a domain from a PDDL file: STRIPS, types, negative preconditions, equality.

)" KINEGRAPH_OF_FILE;

inline constexpr char fromPddlText[] =
    R"(Reads a domain from text in PDDL: STRIPS, types, negative preconditions, equality.

)" KINEGRAPH_OF_TEXT;

inline constexpr char toPddl[] = R"(Writes the domain in PDDL.

Returns:
    The text.
Raises:
    ArgumentError: The domain has automatic rules, or ANY.)";

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

inline constexpr char problemFromPddl[] = R"(Reads a problem from a PDDL file.

Args:
    domain: The domain.
    file: The file's name.
Returns:
    The problem.
Raises:
    FileError: It cannot be read.
    ParseError: The file is invalid; the message begins with file:line:column.)";

inline constexpr char problemToPddl[] = R"(Writes the problem in PDDL.

Returns:
    The text.
Raises:
    ArgumentError: The problem has ANY.)";

inline constexpr char search[] = R"(Prepares the enumeration of the plans of a problem, the shortest first.

Args:
    problem: The problem.
    max_expansions: Maximum number of states that are expanded.
Raises:
    ParseError: A word of the goal is unknown, or a predicate has inconsistent numbers of arguments.
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
