#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "kinegraph/logic/domain.h"

namespace kinegraph {

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

}  // namespace kinegraph
