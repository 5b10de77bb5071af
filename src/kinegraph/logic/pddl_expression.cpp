#include "kinegraph/logic/pddl_expression.h"

#include <cctype>

#include "kinegraph/common/text.h"

namespace kinegraph::inline logic_internal {

namespace {

constexpr int kDeepest = 200;  ///< lists in lists

/// Splits a text into lists and words. A word is all that has no blanks, parentheses or semicolons.
class PddlScanner {
 public:
  PddlScanner(std::string_view text, std::string file) : text_(text), where_{std::move(file), 1, 1} { skipBlanks(); }

  bool isAtEnd() const { return place_ >= text_.size(); }
  const SourcePosition& where() const { return where_; }

  PddlExpression read(int depth = 0) {
    if (isAtEnd()) throw ParseError(where_, "expected a word, '(' or ')', found the end");
    if (depth > kDeepest) throw ParseError(where_, cat("lists are nested more than ", kDeepest, " deep"));
    PddlExpression made;
    made.where = where_;
    if (text_[place_] == ')') throw ParseError(where_, "expected a word or '(', found ')'");
    if (text_[place_] != '(') {
      while (!isAtEnd() && isWordPart(text_[place_])) {
        made.word += text_[place_];
        step();
      }
      skipBlanks();
      return made;
    }
    step();
    skipBlanks();
    while (isAtEnd() || text_[place_] != ')') {
      if (isAtEnd()) throw ParseError(where_, cat("expected ')' of the list at ", made.where.str(), ", found the end"));
      made.list.push_back(read(depth + 1));
    }
    step();
    skipBlanks();
    return made;
  }

 private:
  static bool isBlank(char c) { return std::isspace(static_cast<unsigned char>(c)) || c == '\0'; }
  static bool isWordPart(char c) { return !isBlank(c) && c != '(' && c != ')' && c != ';'; }

  void step() {
    if (text_[place_++] == '\n') {
      ++where_.line;
      where_.column = 1;
    } else {
      ++where_.column;
    }
  }

  void skipBlanks() {
    if (place_ == 0 && text_.starts_with("\xef\xbb\xbf")) place_ = 3;  // a byte order mark
    while (!isAtEnd()) {
      if (text_[place_] == ';') {
        while (!isAtEnd() && text_[place_] != '\n') step();
      } else if (isBlank(text_[place_])) {
        step();
      } else {
        return;
      }
    }
  }

  std::string_view text_;
  SourcePosition where_;
  std::size_t place_ = 0;
};

}  // namespace

std::string lowerCase(std::string_view text) {
  std::string lower(text);
  for (char& c : lower) c = char(std::tolower(static_cast<unsigned char>(c)));
  return lower;
}

std::string PddlExpression::key() const { return lowerCase(word); }

std::string PddlExpression::head() const { return list.empty() ? std::string() : list.front().key(); }

std::vector<PddlExpression> readPddlDefinitions(std::string_view text, const std::string& file) {
  PddlScanner scan(text, file);
  if (scan.isAtEnd()) throw ParseError(scan.where(), "expected (define ...), found the end");
  std::vector<PddlExpression> all;
  while (!scan.isAtEnd()) {
    all.push_back(scan.read());
    if (all.back().head() != "define") refusePddl(all.back(), "(define ...)");
  }
  return all;
}

void refusePddl(const PddlExpression& at, const std::string& expected) {
  throw ParseError(at.where,
                   cat("expected ", expected, at.isList() ? ", found a list" : cat(", found '", at.word, "'")));
}

const std::string& pddlWord(const PddlExpression& at, const char* expected) {
  if (at.isList()) refusePddl(at, expected);
  return at.word;
}

std::vector<PddlTyped> pddlTypedNames(const PddlExpression& list, std::size_t from, const char* what) {
  std::vector<PddlTyped> names;
  std::size_t untyped = 0;
  for (std::size_t i = from; i < list.list.size(); ++i) {
    const std::string& word = pddlWord(list.list[i], what);
    if (word != "-") {
      names.push_back({word, {}, list.list[i].where});
      continue;
    }
    if (++i >= list.list.size()) throw ParseError(list.where, "a type is missing behind '-'");
    std::vector<std::string> types;
    const PddlExpression& type = list.list[i];
    if (!type.isList()) {
      types.push_back(type.word);
    } else if (type.head() == "either" && type.list.size() > 1) {
      for (std::size_t k = 1; k < type.list.size(); ++k) types.push_back(pddlWord(type.list[k], "a type"));
    } else {
      refusePddl(type, "a type or (either a b)");
    }
    for (; untyped < names.size(); ++untyped) names[untyped].types = types;
  }
  return names;
}

}  // namespace kinegraph::inline logic_internal
