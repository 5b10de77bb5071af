#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "kinegraph/common/errors.h"

namespace kinegraph::inline logic_internal {

/// A word of PDDL, or a list of words and lists.
struct PddlExpression {
  std::string word;  ///< as written; empty: a list
  std::vector<PddlExpression> list;
  SourcePosition where;

  bool isList() const { return word.empty(); }

  /// The word in small letters: PDDL has one case.
  std::string key() const;

  /// The key of the first word of a list, empty if there is none.
  std::string head() const;
};

/// Returns a text in small letters.
std::string lowerCase(std::string_view text);

/// Reads all `(define ...)` of a text. Throws ParseError with file:line:column.
std::vector<PddlExpression> readPddlDefinitions(std::string_view text, const std::string& file);

/// Throws ParseError: expected this, found that.
[[noreturn]] void refusePddl(const PddlExpression& at, const std::string& expected);

/// Returns the word; throws ParseError for a list.
const std::string& pddlWord(const PddlExpression& at, const char* expected);

/// A name with the types behind it; `a b - t`, `c - (either t u)`.
struct PddlTyped {
  std::string name;
  std::vector<std::string> types;  ///< none: untyped
  SourcePosition where;
};

/// Returns the names of a list from an index on.
std::vector<PddlTyped> pddlTypedNames(const PddlExpression& list, std::size_t from, const char* what);

}  // namespace kinegraph::inline logic_internal
