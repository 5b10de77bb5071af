#pragma once

#include <string>
#include <string_view>

#include "kinegraph/common/errors.h"

namespace kinegraph {

/// Cuts a text of the logic languages into words and marks; knows where each is. Comments are skipped.
class LogicScanner {
 public:
  struct Token {
    enum class Kind { word, number, mark, text, end };
    Kind kind = Kind::end;
    std::string text;  ///< of a mark: one character
    SourcePosition where = {};
    bool is(char mark) const { return kind == Kind::mark && text[0] == mark; }
    bool isWord() const { return kind == Kind::word; }
    std::string str() const;  ///< "'on'", "the end"
  };

  /// `comment`: what a comment that goes to the end of its line begins with, # or ;
  LogicScanner(std::string_view text, std::string file, char comment);

  const Token& peek() const { return token_; }
  Token take();                                               ///< the next one
  bool takeIf(char mark);                                     ///< takes it, if it is this mark
  Token expect(char mark, const char* what);                  ///< throws ParseError if it is another one
  Token expectWord(const char* what);                         ///< the same
  [[noreturn]] void fail(const std::string& expected) const;  ///< at the next one

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

}  // namespace kinegraph
