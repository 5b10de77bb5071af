#pragma once

#include <string>
#include <string_view>

#include "kinegraph/common/errors.h"

namespace kinegraph::inline logic_internal {

/// Splits a text of the logic languages into words and marks with their positions. Comments are skipped.
class LogicScanner {
 public:
  struct Token {
    enum class Kind { word, number, mark, text, end };
    Kind kind = Kind::end;
    std::string text;  ///< a mark has one character
    SourcePosition where = {};
    bool is(char mark) const { return kind == Kind::mark && text[0] == mark; }
    bool isWord() const { return kind == Kind::word; }
    std::string str() const;  ///< "'on'", "the end"
  };

  /// `comment`: the character that begins a comment, # or ;
  LogicScanner(std::string_view text, std::string file, char comment);

  const Token& peek() const { return token_; }
  Token take();                                               ///< returns the next token
  bool takeIf(char mark);                                     ///< takes the next token if it is this mark
  Token expect(char mark, const char* what);                  ///< throws ParseError for another token
  Token expectWord(const char* what);                         ///< the same
  [[noreturn]] void fail(const std::string& expected) const;  ///< throws ParseError at the next token

 private:
  void advance();
  char at(std::size_t i) const { return i < text_.size() ? text_[i] : '\0'; }
  void step();
  void skipBlanks();

  std::string_view text_;
  std::string file_;
  char comment_;
  std::size_t place_ = 0;
  int line_ = 1, column_ = 1;
  Token token_;
};

}  // namespace kinegraph::inline logic_internal
