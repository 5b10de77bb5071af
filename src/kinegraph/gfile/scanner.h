#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "kinegraph/common/errors.h"

namespace kinegraph::inline gfile_internal {

/// A set of characters with constant-time look-up: `kStops[c]`.
class CharSet {
 public:
  explicit consteval CharSet(std::string_view characters) {
    for (const char c : characters) has_[static_cast<unsigned char>(c)] = true;
  }
  constexpr bool operator[](char c) const { return has_[static_cast<unsigned char>(c)]; }

 private:
  bool has_[256] = {};
};

inline bool isBlank(char c) { return c == ' ' || c == '\t' || c == '\r'; }
inline bool isSpace(char c) { return isBlank(c) || c == '\n'; }
inline bool isOneOf(char c, std::string_view set) { return set.find(c) != std::string_view::npos; }
inline bool startsNumber(char c) { return (c >= '0' && c <= '9') || c == '+' || c == '-' || c == '.'; }
bool startsWord(char c);

/// A position in a text of the .g language, and the tokens that begin there. Independent of entries.
class Scanner {
 public:
  Scanner(std::string_view text, const std::string& file);

  SourcePosition position(std::size_t at) const;
  bool atEnd() const { return at_ >= text_.size(); }
  char peek() const { return atEnd() ? '\0' : text_[at_]; }

 protected:
  /// Thrown at an error and caught by the enclosing entry.
  struct Failure {
    std::size_t at;
    std::string message;
  };
  [[noreturn]] void fail(std::size_t at, std::string message) const { throw Failure{at, std::move(message)}; }

  void skipBlanks();
  void skipComment();     ///< to the end of the line
  void skipSeparators();  ///< between entries: blanks, lines, commas, semicolons, comments
  void skipInArray();     ///< like skipSeparators, without semicolons: they end a row

  /// Returns whether only blanks precede `at` on its line, and their number.
  bool startsLine(std::size_t at, std::size_t& indent) const;

  std::string parseWord(const CharSet& stop);
  std::string parseQuoted(char quote);
  std::string parseAngle();  ///< < ... > on one line
  double parseNumber(const CharSet& stop);
  std::vector<std::string> parseNames();  ///< (a b)

  std::string_view text_;
  const std::string& file_;
  std::size_t at_ = 0;

 private:
  std::size_t lineOf(std::size_t at) const;  ///< 0-based

  std::vector<std::size_t> line_starts_;
  mutable std::size_t last_line_ = 0;  ///< of the previous query: the next one is close
};

}  // namespace kinegraph::inline gfile_internal
