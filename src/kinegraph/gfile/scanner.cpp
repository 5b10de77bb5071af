#include "kinegraph/gfile/scanner.h"

#include <algorithm>
#include <charconv>

#include "kinegraph/common/text.h"

namespace kinegraph::inline gfile_internal {

bool startsWord(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || c == '/' || c == '$' ||
         static_cast<unsigned char>(c) >= 0x80;
}

Scanner::Scanner(std::string_view text, const std::string& file) : text_(text), file_(file) {
  line_starts_.push_back(0);
  for (std::size_t end = 0; (end = text.find('\n', end)) != std::string_view::npos;) line_starts_.push_back(++end);
  if (text_.starts_with("\xEF\xBB\xBF")) at_ = 3;  // byte-order mark
}

/// Reading proceeds line by line, so the line of a position is usually that of the previous query or the next.
std::size_t Scanner::lineOf(std::size_t at) const {
  std::size_t line = last_line_;
  const auto startOf = [&](std::size_t i) { return i < line_starts_.size() ? line_starts_[i] : text_.size() + 1; };
  for (int step = 0; step < 4 && at >= startOf(line + 1); ++step) ++line;
  if (at < startOf(line) || at >= startOf(line + 1)) {
    line = std::size_t(std::upper_bound(line_starts_.begin(), line_starts_.end(), at) - line_starts_.begin()) - 1;
  }
  return last_line_ = line;
}

SourcePosition Scanner::position(std::size_t at) const {
  const std::size_t line = lineOf(at);
  return {file_, int(line) + 1, int(at - line_starts_[line]) + 1};
}

bool Scanner::startsLine(std::size_t at, std::size_t& indent) const {
  const std::size_t start = line_starts_[lineOf(at)];
  indent = at - start;
  return std::all_of(text_.begin() + start, text_.begin() + at, isBlank);
}

void Scanner::skipBlanks() {
  while (!atEnd() && isBlank(peek())) ++at_;
}

void Scanner::skipComment() { at_ = std::min(text_.find('\n', at_), text_.size()); }

void Scanner::skipSeparators() {
  static constexpr CharSet kSeparators(" \t\r\n,;#");
  while (!atEnd() && kSeparators[peek()]) {
    if (peek() == '#') {
      skipComment();
    } else {
      ++at_;
    }
  }
}

void Scanner::skipInArray() {
  static constexpr CharSet kSeparators(" \t\r\n,#");
  while (!atEnd() && kSeparators[peek()]) {
    if (peek() == '#') {
      skipComment();
    } else {
      ++at_;
    }
  }
}

std::string Scanner::parseWord(const CharSet& stop) {
  const std::size_t start = at_;
  while (!atEnd() && !stop[peek()]) ++at_;
  return std::string(text_.substr(start, at_ - start));
}

std::string Scanner::parseQuoted(char quote) {
  const std::size_t opened_at = at_++;
  const std::size_t end = text_.find(quote, at_);
  if (end == std::string_view::npos) fail(opened_at, cat("this ", quote, " is never closed"));
  std::string content(text_.substr(at_, end - at_));
  at_ = end + 1;
  return content;
}

std::string Scanner::parseAngle() {
  const std::size_t opened_at = at_++;
  const std::size_t end = text_.find_first_of(">\n", at_);
  if (end == std::string_view::npos || text_[end] == '\n') fail(opened_at, "this '<' is never closed on its line");
  std::string content(text_.substr(at_, end - at_));
  at_ = end + 1;
  return content;
}

double Scanner::parseNumber(const CharSet& stop) {
  const std::size_t start = at_;
  const char* first = text_.data() + at_;
  const char* last = text_.data() + text_.size();
  if (*first == '+') ++first;
  double number = 0.;
  const auto [end, error] = std::from_chars(first, last, number);
  const bool complete = end == last || stop[*end];
  if (error == std::errc::invalid_argument || !complete) {
    const std::string word = parseWord(stop);
    const char* hint = "";
    if (word.find_first_of("})") != std::string::npos) hint = "; is a ']' missing?";
    const std::string_view unit =
        std::string_view(word).substr(std::min<std::size_t>(word.size(), std::size_t(end - text_.data()) - start));
    static constexpr std::string_view kUnits[] = {"m", "cm", "mm", "kg", "g", "s", "ms", "deg", "rad"};
    if (std::find(std::begin(kUnits), std::end(kUnits), unit) != std::end(kUnits))
      hint = "; numbers have no units: lengths are in m, masses in kg, times in s, angles in rad";
    fail(start, cat("'", word, "' is not a number", hint));
  }
  if (error == std::errc::result_out_of_range) {
    fail(start, cat("'", std::string(first, end), "' is outside the range of a double"));
  }
  at_ = std::size_t(end - text_.data());
  return number;
}

std::vector<std::string> Scanner::parseNames() {
  const std::size_t opened_at = at_++;
  static constexpr CharSet kEnds(" \t\r\n,(){}[]<:=\"'");
  std::vector<std::string> names;
  for (;;) {
    while (!atEnd() && (isSpace(peek()) || peek() == ',')) ++at_;
    if (atEnd()) fail(opened_at, "this '(' is never closed");
    if (peek() == ')') {
      ++at_;
      return names;
    }
    if (peek() == '"') {
      names.push_back(parseQuoted('"'));
      continue;
    }
    const std::size_t start = at_;
    while (!atEnd() && !kEnds[peek()]) ++at_;
    if (at_ == start) fail(at_, cat("'", peek(), "' in a list of names (a b)"));
    names.emplace_back(text_.substr(start, at_ - start));
  }
}

}  // namespace kinegraph::inline gfile_internal
