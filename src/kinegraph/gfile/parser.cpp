#include "kinegraph/gfile/parser.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "kinegraph/base/text.h"

namespace kinegraph {

namespace {

constexpr int kMaxDepth = 200;  // of nested braces and brackets

bool isBlank(char c) { return c == ' ' || c == '\t' || c == '\r'; }
bool isSpace(char c) { return isBlank(c) || c == '\n'; }
bool isSeparator(char c) { return isSpace(c) || c == ',' || c == ';'; }
bool isOneOf(char c, std::string_view set) { return set.find(c) != std::string_view::npos; }
bool startsNumber(char c) { return (c >= '0' && c <= '9') || isOneOf(c, "+-."); }
bool startsWord(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || isOneOf(c, "_/$") || static_cast<unsigned char>(c) >= 0x80;
}

class Parser {
 public:
  Parser(std::string_view text, const std::string& file) : text_(text), file_(file) {
    line_starts_.push_back(0);
    for (std::size_t i = 0; i < text.size(); ++i) {
      if (text[i] == '\n') line_starts_.push_back(i + 1);
    }
    if (text_.starts_with("\xEF\xBB\xBF")) at_ = 3;
  }

  ParseResult run() {
    skipSeparators();
    const std::size_t start = at_;
    const bool outer_brace = peek() == '{';
    if (outer_brace) ++at_;
    parseEntries(result_.graph, outer_brace ? start : kNoBrace);
    skipSeparators();
    if (outer_brace && !atEnd()) {  // not a brace around the whole file, but a first entry without a name
      result_ = {};
      at_ = start;
      parseEntries(result_.graph, kNoBrace);
    }
    return std::move(result_);
  }

 private:
  static constexpr std::size_t kNoBrace = std::numeric_limits<std::size_t>::max();

  struct Failure {
    std::size_t at;
    std::string message;
  };

  [[noreturn]] void fail(std::size_t at, std::string message) const { throw Failure{at, std::move(message)}; }

  SourcePosition position(std::size_t at) const {
    const auto line = std::upper_bound(line_starts_.begin(), line_starts_.end(), at) - line_starts_.begin();
    return {file_, int(line), int(at - line_starts_[line - 1]) + 1};
  }

  void report(Diagnostic::Severity severity, std::size_t at, std::string message) {
    result_.diagnostics.push_back({severity, position(at), std::move(message)});
  }

  bool atEnd() const { return at_ >= text_.size(); }
  char peek() const { return atEnd() ? '\0' : text_[at_]; }

  void skipBlanks() {
    while (!atEnd() && isBlank(peek())) ++at_;
  }

  void skipSeparators() {
    while (!atEnd()) {
      if (isSeparator(peek())) {
        ++at_;
      } else if (peek() == '#') {
        while (!atEnd() && peek() != '\n') ++at_;
      } else {
        break;
      }
    }
  }

  /// Entries up to the closing brace that belongs to `opened_at`, or to the end of the text.
  void parseEntries(Graph& graph, std::size_t opened_at) {
    for (;;) {
      skipSeparators();
      if (atEnd()) {
        if (opened_at != kNoBrace) {
          report(Diagnostic::Severity::warning, opened_at, "this '{' is never closed; it is taken to end with the file");
        }
        return;
      }
      if (peek() == '}') {
        if (opened_at != kNoBrace) {
          ++at_;
          return;
        }
        report(Diagnostic::Severity::error, at_, "this '}' closes nothing; is there one too many before it?");
        ++at_;
        continue;
      }
      const std::size_t start = at_;
      try {
        graph.nodes.push_back(parseEntry());
      } catch (const Failure& failure) {
        report(Diagnostic::Severity::error, failure.at, failure.message);
        recover(std::max(start, std::min(failure.at, text_.size())));
      }
    }
  }

  /// Goes on behind the line of an error.
  void recover(std::size_t from) {
    at_ = std::max(at_, from);
    while (!atEnd() && peek() != '\n' && peek() != '}') ++at_;
    if (!atEnd() && peek() == '\n') ++at_;
  }

  Node parseEntry() {
    Node node;
    node.where = position(at_);
    const std::size_t start = at_;
    const bool negated = peek() == '!';
    if (negated) ++at_;
    node.key = parseKey();
    skipBlanks();
    const bool has_parents = peek() == '(';
    if (has_parents) node.parents = parseNames();
    skipBlanks();
    bool marked = false;  // by : or =
    if (peek() == ':' || peek() == '=') {
      marked = true;
      ++at_;
      skipBlanks();
      skipToWrappedArray();
    }
    node.value.where = position(at_);
    const bool flag = atEnd() || isOneOf(peek(), "\n,;}#") || (!marked && !isOneOf(peek(), "{[<'\"!~"));
    if (!flag) {
      node.value = parseValue();
    } else if (start == at_) {
      fail(at_, cat("'", peek(), "' cannot start an entry; expected a name, or 'key: value'"));
    } else if (!marked && !node.key.empty() && (std::isdigit(static_cast<unsigned char>(node.key[0])) || node.key[0] == '.')) {
      report(Diagnostic::Severity::warning, start,
             cat("'", node.key, "' stands alone and is taken as a flag of that name; numbers that belong together stand in [ ]"));
    }
    if (negated) node.value.data = false;
    if (node.value.as<Graph>()) splitTags(node);
    return node;
  }

  /// A value stands on the line of its key; but as no entry can start with '[', an array may also follow on the next.
  void skipToWrappedArray() {
    std::size_t next = at_;
    while (next < text_.size() && isSpace(text_[next])) ++next;
    if (next < text_.size() && text_[next] == '[') at_ = next;
  }

  std::string parseKey() {
    const std::size_t start = at_;
    if (peek() == '"') {
      const std::string key = parseQuoted('"');
      return key;
    }
    while (!atEnd() && !isOneOf(peek(), ":\t\n\r,;[]{}()<=!~'\"#")) ++at_;
    std::size_t end = at_;
    while (end > start && text_[end - 1] == ' ') --end;
    return std::string(text_.substr(start, end - start));
  }

  std::vector<std::string> parseNames() {
    const std::size_t opened_at = at_++;
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
      while (!atEnd() && !isSpace(peek()) && !isOneOf(peek(), ",(){}[]<>:=\"'")) ++at_;
      if (at_ == start) fail(at_, cat("'", peek(), "' in a list of names (a b)"));
      names.emplace_back(text_.substr(start, at_ - start));
    }
  }

  Value parseValue() {
    if (++depth_ > kMaxDepth) fail(at_, cat("nested deeper than ", kMaxDepth, " levels"));
    Value value;
    value.where = position(at_);
    const char c = peek();
    if (c == '{') {
      const std::size_t opened_at = at_++;
      Graph graph;
      parseEntries(graph, opened_at);
      value.data = std::move(graph);
    } else if (c == '[') {
      value.data = parseArray().data;
    } else if (c == '<') {
      value.data = AngleText{parseAngle()};
    } else if (c == '"' || c == '\'') {
      std::string text = parseQuoted(c);
      if (text.size() >= 2 && text.front() == '<' && text.back() == '>') {
        value.data = AngleText{text.substr(1, text.size() - 2)};
      } else {
        value.data = std::move(text);
      }
    } else if (c == '(') {
      value.data = NameTuple{parseNames()};
    } else if (c == '!' || c == '~') {
      ++at_;
      value.data = c == '~';
    } else if (startsNumber(c)) {
      value.data = parseNumber(" \t\r\n,;}#)");
    } else if (startsWord(c)) {
      value.data = interpretWord(parseWord(" \t\r\n,;}"));
    } else {
      fail(at_, cat("'", c, "' cannot start a value; expected a number, a word, \"text\", [array], {graph} or <file>"));
    }
    --depth_;
    return value;
  }

  static decltype(Value::data) interpretWord(const std::string& word) {
    if (word == "true" || word == "True") return true;
    if (word == "false" || word == "False") return false;
    if (word == "inf") return std::numeric_limits<double>::infinity();
    if (word == "nan") return std::numeric_limits<double>::quiet_NaN();
    return word;
  }

  std::string parseWord(std::string_view stop) {
    const std::size_t start = at_;
    while (!atEnd() && !isOneOf(peek(), stop)) ++at_;
    return std::string(text_.substr(start, at_ - start));
  }

  std::string parseQuoted(char quote) {
    const std::size_t opened_at = at_++;
    const std::size_t end = text_.find(quote, at_);
    if (end == std::string_view::npos) fail(opened_at, cat("this ", quote, " is never closed"));
    std::string content(text_.substr(at_, end - at_));
    at_ = end + 1;
    return content;
  }

  std::string parseAngle() {
    const std::size_t opened_at = at_++;
    const std::size_t end = text_.find_first_of(">\n", at_);
    if (end == std::string_view::npos || text_[end] == '\n') fail(opened_at, "this '<' is never closed on its line");
    std::string content(text_.substr(at_, end - at_));
    at_ = end + 1;
    return content;
  }

  double parseNumber(std::string_view stop) {
    const std::size_t start = at_;
    const char* first = text_.data() + at_;
    const char* last = text_.data() + text_.size();
    if (*first == '+') ++first;
    double number = 0.;
    const auto [end, error] = std::from_chars(first, last, number);
    const bool complete = end == last || isOneOf(*end, stop);
    if (error == std::errc::invalid_argument || !complete) {
      const std::string word = parseWord(stop);
      fail(start, cat("'", word, "' is not a number"));
    }
    if (error == std::errc::result_out_of_range) {
      fail(start, cat("'", std::string(first, end), "' is too large or too small for a number"));
    }
    at_ = std::size_t(end - text_.data());
    return number;
  }

  void skipInArray() {
    while (!atEnd()) {
      if (isSpace(peek()) || peek() == ',') {
        ++at_;
      } else if (peek() == '#') {
        while (!atEnd() && peek() != '\n') ++at_;
      } else {
        break;
      }
    }
  }

  /// An array: numbers, words, or a list if there are arrays in it.
  Value parseArray() {
    if (++depth_ > kMaxDepth) fail(at_, cat("nested deeper than ", kMaxDepth, " levels"));
    const std::size_t opened_at = at_++;
    skipInArray();
    if (peek() == '<') parseAngle();  // a type and dimensions, as exporters write: the numbers speak for themselves
    NumberArray numbers;
    StringArray strings;
    ValueList list;
    std::size_t row_length = 0, row_start = 0;
    bool first = true, textual = false, nested = false;
    for (;;) {
      skipInArray();
      if (atEnd()) fail(opened_at, "this '[' is never closed");
      const char c = peek();
      if (c == ']') {
        ++at_;
        break;
      }
      if (c == ';') {
        ++at_;
        if (numbers.numbers.size() == row_start) continue;
        endRow(numbers, row_start, row_length, opened_at);
        continue;
      }
      const std::size_t start = at_;
      Value element;
      element.where = position(at_);
      if (c == '[') {
        element.data = parseArray().data;
        nested = true;
      } else if (c == '"' || c == '\'') {
        element.data = parseQuoted(c);
      } else if (c == '{') {
        element = parseValue();
        nested = true;
      } else if (textual && !isOneOf(c, "}()<>:=")) {
        element.data = parseWord(" \t\r\n,;]");
      } else if (startsNumber(c)) {
        element.data = parseNumber(" \t\r\n,;]#");
      } else if (startsWord(c)) {
        const std::string word = parseWord(" \t\r\n,;]");
        if (!first && !textual && (word == "inf" || word == "nan")) {
          element.data = interpretWord(word);
        } else {
          element.data = word;
        }
      } else {
        fail(at_, cat("'", c, "' in an array; expected numbers or words up to ']'"));
      }
      if (element.as<std::string>()) {
        if (!textual && !numbers.numbers.empty()) {
          fail(start, cat("'", *element.as<std::string>(), "' in an array of numbers"));
        }
        textual = true;
        strings.push_back(*element.as<std::string>());
      } else if (const double* number = element.as<double>()) {
        if (textual) {
          fail(start, "a number in an array of words");
        }
        numbers.numbers.push_back(*number);
      }
      list.push_back(std::move(element));
      first = false;
    }
    --depth_;
    Value value;
    if (nested) {
      value.data = std::move(list);
    } else if (textual) {
      value.data = std::move(strings);
    } else {
      if (row_length > 0 && numbers.numbers.size() > row_start) endRow(numbers, row_start, row_length, opened_at);
      if (row_length > 0) numbers.rows = int(numbers.numbers.size() / row_length);
      value.data = std::move(numbers);
    }
    return value;
  }

  void endRow(const NumberArray& numbers, std::size_t& row_start, std::size_t& row_length, std::size_t opened_at) const {
    const std::size_t length = numbers.numbers.size() - row_start;
    if (row_length > 0 && length != row_length) {
      fail(opened_at, cat("rows of different length in an array: ", row_length, " and ", length));
    }
    row_length = length;
    row_start = numbers.numbers.size();
  }

  static void splitTags(Node& node) {
    std::vector<std::string> words;
    std::size_t start = 0;
    while ((start = node.key.find_first_not_of(' ', start)) != std::string::npos) {
      const std::size_t end = std::min(node.key.find(' ', start), node.key.size());
      words.push_back(node.key.substr(start, end - start));
      start = end;
    }
    if (words.size() < 2) return;
    node.key = words.back();
    words.pop_back();
    node.tags = std::move(words);
  }

  std::string_view text_;
  const std::string& file_;
  std::size_t at_ = 0;
  int depth_ = 0;
  std::vector<std::size_t> line_starts_;
  ParseResult result_;
};

}  // namespace

ParseResult parseAll(std::string_view text, const std::string& file) { return Parser(text, file).run(); }

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
  std::string caret(std::size_t(std::max(where.column - 1, 0)), ' ');
  for (std::size_t i = 0; i < caret.size() && i < line.size(); ++i) {
    if (line[i] == '\t') caret[i] = '\t';
  }
  return cat("    ", line, "\n    ", caret, "^");
}

}  // namespace kinegraph
