#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "kinegraph/gfile/value.h"

namespace kinegraph {

/// Something that the parser has to say about a text. `message` is without the place.
struct Diagnostic {
  enum class Severity { warning, error };
  Severity severity;
  SourcePosition where;
  std::string message;
};

/// A text that was read, and the file that it was read from.
struct SourceText {
  std::string file, text;
};

struct ParseResult {
  Graph graph;
  std::vector<Diagnostic> diagnostics = {};  ///< in the order of the text
  std::vector<SourceText> included = {};     ///< further files that were read: none in the .g language
};

/// Parses text of the .g language, all dialects of its grammar. Goes on behind an error, so that all are reported.
ParseResult parseAll(std::string_view text, const std::string& file);

/// The same; throws ParseError with all errors (each with its line and a caret) if there are any.
/// Warnings are appended to `warnings` where given, each with its place.
Graph parse(std::string_view text, const std::string& file, std::vector<std::string>* warnings = nullptr);

/// The line of `text` at `where`, and a caret below the column:
///     a: { shape: bax }
///                 ^
std::string excerpt(std::string_view text, const SourcePosition& where);

}  // namespace kinegraph
