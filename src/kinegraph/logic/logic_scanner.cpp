#include "kinegraph/logic/logic_scanner.h"

#include <cctype>

#include "kinegraph/common/text.h"

namespace kinegraph::inline logic_internal {

namespace {

bool isWordPart(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '-' || c == '?' || c == '.' || c == '/' ||
         c == '$' || c == '%' || c == '@' || c == '+' || c == '\'' || (static_cast<unsigned char>(c) & 0x80);
}

bool isNumber(const std::string& text) {
  std::size_t digits = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (std::isdigit(static_cast<unsigned char>(text[i]))) {
      ++digits;
    } else if (text[i] != '.' && !((text[i] == '-' || text[i] == '+') && i == 0)) {
      return false;
    }
  }
  return digits > 0;
}

}  // namespace

std::string LogicScanner::Token::str() const { return kind == Kind::end ? "the end" : cat("'", text, "'"); }

LogicScanner::LogicScanner(std::string_view text, std::string file, char comment)
    : text_(text), file_(std::move(file)), comment_(comment) {
  advance();
}

void LogicScanner::step() {
  if (text_[place_] == '\n') {
    ++line_;
    column_ = 0;
  }
  ++column_;
  ++place_;
}

void LogicScanner::skipBlanks() {
  while (place_ < text_.size()) {
    const char c = text_[place_];
    if (c == comment_) {
      while (place_ < text_.size() && text_[place_] != '\n') step();
    } else if (std::isspace(static_cast<unsigned char>(c))) {
      step();
    } else {
      return;
    }
  }
}

void LogicScanner::advance() {
  skipBlanks();
  token_ = {Token::Kind::end, "", {file_, line_, column_}};
  if (place_ >= text_.size()) return;
  const std::size_t begin = place_;
  if (isWordPart(text_[place_])) {
    while (place_ < text_.size() && isWordPart(text_[place_])) step();
    token_.text = std::string(text_.substr(begin, place_ - begin));
    token_.kind = isNumber(token_.text) ? Token::Kind::number : Token::Kind::word;
  } else if (text_[place_] == '"') {
    step();
    while (place_ < text_.size() && text_[place_] != '"') step();
    if (place_ >= text_.size()) throw ParseError(token_.where, "a string begins here and does not end");
    token_.text = std::string(text_.substr(begin + 1, place_ - begin - 1));
    token_.kind = Token::Kind::text;
    step();
  } else {
    token_.text = std::string(1, text_[place_]);
    token_.kind = Token::Kind::mark;
    step();
  }
}

LogicScanner::Token LogicScanner::take() {
  Token taken = token_;
  if (token_.kind != Token::Kind::end) advance();
  return taken;
}

bool LogicScanner::takeIf(char mark) {
  if (!token_.is(mark)) return false;
  take();
  return true;
}

LogicScanner::Token LogicScanner::expect(char mark, const char* what) {
  if (!token_.is(mark)) fail(cat("'", mark, "' ", what));
  return take();
}

LogicScanner::Token LogicScanner::expectWord(const char* what) {
  if (!token_.isWord()) fail(what);
  return take();
}

void LogicScanner::fail(const std::string& expected) const {
  throw ParseError(token_.where, cat("expected ", expected, ", found ", token_.str()));
}

}  // namespace kinegraph::inline logic_internal
