#include "kinegraph/gfile/grammar.h"

#include <algorithm>
#include <cctype>
#include <limits>

#include "kinegraph/common/text.h"

namespace kinegraph::inline gfile_internal {

namespace {

constexpr int kMaxDepth = 200;   // nesting of braces, brackets and blocks
constexpr int kMaxErrors = 100;  // per text

using Data = decltype(Value::data);

Data interpretWord(const std::string& word) {
  if (word == "true" || word == "True") return true;
  if (word == "false" || word == "False") return false;
  if (word == "inf") return std::numeric_limits<double>::infinity();
  if (word == "nan") return std::numeric_limits<double>::quiet_NaN();
  return word;
}

std::vector<std::string> splitWords(std::string_view text) {
  std::vector<std::string> words;
  std::size_t start = 0;
  while ((start = text.find_first_not_of(' ', start)) != std::string_view::npos) {
    const std::size_t end = std::min(text.find(' ', start), text.size());
    words.emplace_back(text.substr(start, end - start));
    start = end;
  }
  return words;
}

}  // namespace

Grammar::Grammar(std::string_view text, const std::string& file)
    : Scanner(text, file), yaml_(file.ends_with(".yml") || file.ends_with(".yaml")) {}

Grammar::Level::Level(Grammar& grammar, bool braced) : grammar_(grammar), braced_(braced) {
  if (grammar_.depth_ == kMaxDepth) grammar_.fail(grammar_.at_, cat("nested deeper than ", kMaxDepth, " levels"));
  ++grammar_.depth_;
  grammar_.braces_ += braced_;
}

Grammar::Level::~Level() {
  --grammar_.depth_;
  grammar_.braces_ -= braced_;
}

ParseResult Grammar::run() {
  skipSeparators();
  const std::size_t start = at_;
  if (peek() != '{') {
    parseEntries(result_.graph, kNoBrace);
    return std::move(result_);
  }
  ++at_;
  ++braces_;
  parseEntries(result_.graph, start);
  --braces_;
  skipSeparators();
  if (!atEnd()) {  // not a brace around the whole file, but a first entry without a name
    result_ = {};
    errors_ = 0;
    at_ = start;
    parseEntries(result_.graph, kNoBrace);
  }
  return std::move(result_);
}

void Grammar::report(Diagnostic::Severity severity, std::size_t at, std::string message) {
  result_.diagnostics.push_back({severity, position(at), std::move(message)});
  errors_ += severity == Diagnostic::Severity::error;
}

bool Grammar::tooManyErrors() const { return errors_ >= kMaxErrors; }

/// Continues after the line of an error, or after the braces that it opens, unless they are never closed.
void Grammar::recover(std::size_t from) {
  at_ = tooManyErrors() ? text_.size() : std::max(at_, from);
  const std::size_t line_end = std::min(text_.find('\n', at_), text_.size());
  int open = 0;
  std::size_t at = at_;
  for (; at < text_.size() && (open > 0 || at < line_end); ++at) {
    if (text_[at] == '{') ++open;
    if (text_[at] == '}' && --open < 0) break;
  }
  at_ = open > 0 ? line_end : at;
  if (peek() == '\n') ++at_;
}

/// Parses entries up to the closing brace of `opened_at`, or to the end of the text.
void Grammar::parseEntries(Graph& graph, std::size_t opened_at) {
  for (;;) {
    skipSeparators();
    if (atEnd()) {
      if (opened_at != kNoBrace && !tooManyErrors()) {
        report(Diagnostic::Severity::warning, opened_at, "this '{' is never closed; the end of the file closes it");
      }
      return;
    }
    if (peek() == '}' && opened_at != kNoBrace) {
      ++at_;
      return;
    }
    if (opened_at != kNoBrace || !skipDocumentMark()) parseEntryInto(graph);
  }
}

/// Parses one entry and reports an error in it.
void Grammar::parseEntryInto(Graph& graph) {
  const std::size_t start = at_;
  if (peek() == '}') {
    report(Diagnostic::Severity::error, at_++, "this '}' closes nothing; is an earlier '}' superfluous?");
    return;
  }
  try {
    graph.nodes.push_back(parseEntry());
  } catch (const Failure& failure) {
    report(Diagnostic::Severity::error, failure.at, failure.message);
    recover(std::max(start, std::min(failure.at, text_.size())));
  }
}

Node Grammar::parseEntry() {
  Node node;
  node.where = position(at_);
  const std::size_t start = at_;
  const bool negated = peek() == '!';
  if (negated) ++at_;
  node.key = parseKey();
  skipBlanks();
  if (peek() == '(') node.parents = parseNames();
  skipBlanks();
  bool marked = false;  // has a : or =
  std::size_t indent = 0;
  if (peek() == ':' || peek() == '=') {
    marked = true;
    ++at_;
    skipBlanks();
    if (blockFollows(start, indent)) {
      node.value = parseBlock(indent);
      splitHead(node);
      return node;
    }
    skipToWrappedArray();
  }
  if (!marked) skipToBraceOfHead();
  node.value.where = position(at_);
  const bool flag = atEnd() || isOneOf(peek(), "\n,;}#") || (!marked && !isOneOf(peek(), "{[<'\"!~"));
  if (!flag) {
    node.value = yaml_ && braces_ == 0 ? parseScalar() : parseValue();
  } else if (start == at_) {
    fail(at_, cat("'", peek(), "' cannot start an entry; expected a name, or 'key: value'"));
  } else if (!marked && !node.key.empty() &&
             (std::isdigit(static_cast<unsigned char>(node.key[0])) || node.key[0] == '.')) {
    report(Diagnostic::Severity::warning, start,
           cat("'", node.key, "' has no key and is read as a flag of that name; write a list of numbers in [ ]"));
  }
  if (negated) node.value.data = false;
  splitHead(node);
  return node;
}

/// A value follows its key on the same line; an array may also start on the next line because no entry starts with
/// '['.
void Grammar::skipToWrappedArray() {
  std::size_t next = at_;
  while (next < text_.size() && isSpace(text_[next])) ++next;
  if (next < text_.size() && text_[next] == '[') at_ = next;
}

/// Outside of braces a flag has no meaning, so a '{' on the next line is the value of this key.
void Grammar::skipToBraceOfHead() {
  std::size_t next = at_;
  while (next < text_.size() && isSpace(text_[next])) ++next;
  if (braces_ == 0 && next < text_.size() && text_[next] == '{') at_ = next;
}

std::string Grammar::parseKey() {
  const std::size_t start = at_;
  if (peek() == '"') return parseQuoted('"');
  static constexpr CharSet kEnds(":\t\n\r,;[]{}()<=!~'\"#");
  while (!atEnd() && !kEnds[peek()]) ++at_;
  std::size_t end = at_;
  while (end > start && text_[end - 1] == ' ') --end;
  return std::string(text_.substr(start, end - start));
}

/// For a graph: words before the last one of the key are tags, and a quoted key may contain the parents: "a(b)": {}.
void Grammar::splitHead(Node& node) const {
  if (!node.value.as<Graph>()) return;
  const std::size_t open = node.key.find('(');
  if (node.parents.empty() && open != std::string::npos && node.key.ends_with(")")) {
    std::string names = node.key.substr(open + 1, node.key.size() - open - 2);
    std::replace(names.begin(), names.end(), ',', ' ');
    node.parents = splitWords(names);
    node.key.resize(open);
  }
  std::vector<std::string> words = splitWords(node.key);
  node.key = words.empty() ? "" : words.back();
  if (!words.empty()) words.pop_back();
  node.tags = std::move(words);
}

Value Grammar::parseValue() {
  const char c = peek();
  Value value;
  value.where = position(at_);
  if (c == '{') {
    const Level level(*this);
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
    static constexpr CharSet kEnds(" \t\r\n,;}#)");
    value.data = parseNumber(kEnds);
  } else if (startsWord(c)) {
    static constexpr CharSet kEnds(" \t\r\n,;}");
    value.data = interpretWord(parseWord(kEnds));
  } else {
    fail(at_, cat("'", c, "' cannot start a value; expected a number, a name, \"text\", [array], {graph} or <file>"));
  }
  return value;
}

}  // namespace kinegraph::inline gfile_internal
