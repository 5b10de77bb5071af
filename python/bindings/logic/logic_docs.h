#pragma once

/// The manual of what bind_logic.cpp binds.
namespace kinegraph::python::docs::logic {

// What several of them say.
#define KINEGRAPH_OF_FILE               \
  "Args:\n"                             \
  "    file: Its name.\n"               \
  "Returns:\n"                          \
  "    The domain.\n"                   \
  "Raises:\n"                           \
  "    FileError: It cannot be read.\n" \
  "    ParseError: It is wrong; the message begins with file:line:column."
#define KINEGRAPH_OF_TEXT              \
  "Args:\n"                            \
  "    text: The text.\n"              \
  "    name: What messages call it.\n" \
  "Returns:\n"                         \
  "    The domain.\n"                  \
  "Raises:\n"                          \
  "    ParseError: It is wrong; the message begins with name:line:column."

inline constexpr char fromFol[] = R"(Reads a domain from a .fol file.

)" KINEGRAPH_OF_FILE;

inline constexpr char fromFolText[] = R"(Reads a domain from text in the language of .fol files.

)" KINEGRAPH_OF_TEXT;

inline constexpr char fromPddl[] = R"(Reads a domain from a PDDL file: STRIPS, types, negative preconditions, equality.

)" KINEGRAPH_OF_FILE;

inline constexpr char fromPddlText[] =
    R"(Reads a domain from text in PDDL: STRIPS, types, negative preconditions, equality.

)" KINEGRAPH_OF_TEXT;

inline constexpr char toPddl[] = R"(The domain in PDDL.

Returns:
    The text.
Raises:
    ArgumentError: It has rules that fire by themselves, or ANY.)";

inline constexpr char addAction[] = R"(Adds an action. Words that are not known yet become symbols.

Args:
    name: Its name.
    variables: Names of its variables; a plan has their values in this order.
    pre: Literals that must hold, (on Place Obj) (busy Hand)! for example.
    eff: What it makes true or, with !, false, in this order.
Raises:
    ParseError: The literals are wrong, or no literal that has to hold has a variable.)";

inline constexpr char problem[] = R"(A problem of a domain.

Args:
    domain: The domain.
    start: Literals that hold at the start, besides those of the domain, (on table cup) for example.
    goal: Literals that shall hold, or with ! not hold.
Raises:
    ParseError: The literals are wrong.)";

inline constexpr char problemFromPddl[] = R"(Reads a problem from a PDDL file.

Args:
    domain: The domain.
    file: The file's name.
Returns:
    The problem.
Raises:
    FileError: It cannot be read.
    ParseError: It is wrong; the message begins with file:line:column.)";

inline constexpr char problemToPddl[] = R"(The problem in PDDL.

Returns:
    The text.
Raises:
    ArgumentError: It has ANY.)";

inline constexpr char search[] = R"(Searches the plans of a problem, the shortest first.

Args:
    problem: The problem.
    max_expansions: Maximum number of states that are expanded.
Raises:
    ParseError: A word of the goal is nowhere else, or a predicate has different numbers of arguments.
    ArgumentError: There are too many actions.)";

inline constexpr char next[] = R"(The next plan.

Returns:
    A list of actions, each a list of words: its name and the values of its variables. None where there is no further
    one (Status.exhausted: this is proved), or if the search reached its limit (Status.limit).
Raises:
    KeyboardInterrupt: Ctrl-C was pressed.)";

inline constexpr char forbid[] =
    R"(Makes an action impossible in all states where some facts hold, in plans from now on.

Args:
    action: Its words.
    facts: Literals, (on table cup) for example; none: it is never possible.
Raises:
    ArgumentError: There is no such action, or a fact that can never hold.)";

inline constexpr char forbidBeginning[] = R"(No further plan begins with these actions.

Args:
    actions: A list of actions, each a list of words.
Raises:
    ArgumentError: There is no such action.)";

inline constexpr char states[] = R"(The states that a sequence of actions goes through, the start first.

Args:
    actions: A list of actions, each a list of words.
Returns:
    A list of states, each a list of literals.
Raises:
    ArgumentError: There is no such action, or it is not possible then.)";

inline constexpr char sceneFacts[] =
    R"(What a scene says in logic: the words of frames with `logical: { ... }`, objects, and what is on what.

Args:
    C: The scene.
Returns:
    Literals, (on table cup) for example.)";

#undef KINEGRAPH_OF_FILE
#undef KINEGRAPH_OF_TEXT

}  // namespace kinegraph::python::docs::logic
