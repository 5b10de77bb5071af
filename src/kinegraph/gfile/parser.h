#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "kinegraph/gfile/value.h"

namespace kinegraph::inline gfile_internal {

/// An error or warning about a text. `message` excludes the position.
struct Diagnostic {
  enum class Severity { warning, error };
  Severity severity;
  SourcePosition where;
  std::string message;
};

/// A text and the file that contains it.
struct SourceText {
  std::string file, text;
};

struct ParseResult {
  Graph graph;
  std::vector<Diagnostic> diagnostics = {};  ///< in text order
  std::vector<SourceText> included = {};     ///< further files read: none in the .g language
};

/// Parses a text of the .g language in all dialects of its grammar. Continues after errors, to report all of them.
ParseResult parseAll(std::string_view text, const std::string& file);

/// Parses a text. Throws ParseError with all errors, each with its line and a caret. Appends warnings with their
/// positions to `warnings`, if given.
Graph parse(std::string_view text, const std::string& file, std::vector<std::string>* warnings = nullptr);

/// The line of `text` at `where`, and a caret below the column:
///     a: { shape: bax }
///                 ^
std::string excerpt(std::string_view text, const SourcePosition& where);

}  // namespace kinegraph::inline gfile_internal
