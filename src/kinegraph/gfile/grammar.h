#pragma once

#include <string>
#include <string_view>

#include "kinegraph/gfile/parser.h"
#include "kinegraph/gfile/scanner.h"

namespace kinegraph::inline gfile_internal {

/// Recursive-descent parser of the .g language and block-style YAML. Braces and indentation may be mixed: a `key:` at
/// the end of its line opens a block if the next line is indented deeper than the key.
class Grammar : private Scanner {
 public:
  Grammar(std::string_view text, const std::string& file);
  ParseResult run();

 private:
  static constexpr std::size_t kNoBrace = std::size_t(-1);

  /// Counts the nesting depth; restores it on destruction, also after a Failure.
  class Level {
   public:
    explicit Level(Grammar& grammar, bool braced = true);
    ~Level();

   private:
    Grammar& grammar_;
    bool braced_;
  };

  void report(Diagnostic::Severity severity, std::size_t at, std::string message);
  bool tooManyErrors() const;  ///< too many errors to continue
  void recover(std::size_t from);

  // grammar.cpp
  void parseEntries(Graph& graph, std::size_t opened_at);
  void parseEntryInto(Graph& graph);
  Node parseEntry();
  std::string parseKey();
  void splitHead(Node& node) const;
  void skipToWrappedArray();
  void skipToBraceOfHead();
  Value parseValue();

  // grammar_arrays.cpp
  struct ArrayParts;
  Value parseArray();
  Value parseElement(ArrayParts& parts);
  void endRow(ArrayParts& parts, std::size_t opened_at) const;

  // grammar_blocks.cpp
  bool blockFollows(std::size_t key_at, std::size_t& indent);
  Value parseBlock(std::size_t indent);
  void parseBlockEntries(Graph& graph, std::size_t indent);
  Value parseSequence(std::size_t indent);
  bool startsItem() const;  ///< "- " of a YAML sequence
  Value parseScalar();      ///< a value; in YAML files, more words on its line may follow
  bool skipDocumentMark();

  bool yaml_;  ///< from the file name
  int depth_ = 0, braces_ = 0, errors_ = 0;
  ParseResult result_;
};

}  // namespace kinegraph::inline gfile_internal
