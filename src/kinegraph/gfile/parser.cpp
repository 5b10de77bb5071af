#include "kinegraph/gfile/parser.h"

#include <algorithm>

#include "kinegraph/common/text.h"
#include "kinegraph/gfile/grammar.h"

namespace kinegraph::inline gfile_internal {

ParseResult parseAll(std::string_view text, const std::string& file) { return Grammar(text, file).run(); }

Graph parse(std::string_view text, const std::string& file, std::vector<std::string>* warnings) {
  ParseResult result = parseAll(text, file);
  const Diagnostic* first = nullptr;
  std::string message;
  for (const Diagnostic& diagnostic : result.diagnostics) {
    if (diagnostic.severity == Diagnostic::Severity::warning) {
      if (warnings) warnings->push_back(cat(diagnostic.where.str(), ": ", diagnostic.message));
      continue;
    }
    message += first ? cat("\n", diagnostic.where.str(), ": ") : "";
    message += cat(diagnostic.message, "\n", excerpt(text, diagnostic.where));
    if (!first) first = &diagnostic;
  }
  if (first) throw ParseError(first->where, message);
  return std::move(result.graph);
}

namespace {

constexpr std::size_t kAround = 60;  ///< characters of a long line that are shown on each side of a place

/// Keeps the part of a long line around a column, such as of a file without line breaks.
void shorten(std::string& line, std::size_t& column) {
  const std::string cut = "...";
  if (line.size() > column + kAround + cut.size()) line = line.substr(0, column + kAround) + cut;
  if (column <= kAround + cut.size()) return;
  line = cut + line.substr(std::min(column - kAround, line.size()));
  column = kAround + cut.size();
}

}  // namespace

std::string excerpt(std::string_view text, const SourcePosition& where) {
  if (!where.known()) return "";
  std::size_t start = 0;
  for (int line = 1; line < where.line; ++line) {
    start = text.find('\n', start);
    if (start == std::string_view::npos) return "";
    ++start;
  }
  const std::size_t end = std::min(text.find_first_of("\r\n", start), text.size());
  std::string line(text.substr(start, end - start));
  std::size_t column = std::size_t(std::max(where.column - 1, 0));
  shorten(line, column);
  std::string caret(column, ' ');
  for (std::size_t i = 0; i < caret.size() && i < line.size(); ++i) {
    if (line[i] == '\t') caret[i] = '\t';
  }
  return cat("    ", line, "\n    ", caret, "^");
}

}  // namespace kinegraph::inline gfile_internal
