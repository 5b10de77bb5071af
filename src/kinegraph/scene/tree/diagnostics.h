#pragma once

#include <map>
#include <string>
#include <vector>

#include "kinegraph/gfile/parser.h"

namespace kinegraph::inline scene_internal {

/// Errors and warnings found while reading a scene, with their positions and the source texts.
class SceneDiagnostics {
 public:
  /// Stores a text for excerpts in messages.
  void addText(const std::string& file, std::string text) { texts_[file] = std::move(text); }
  const std::map<std::string, std::string>& texts() const { return texts_; }

  void add(Diagnostic diagnostic);
  void error(const SourcePosition& where, std::string message);
  void warning(const SourcePosition& where, std::string message);

  bool failed() const { return errors_ > 0; }
  bool flooded() const { return errors_ >= kMaxErrors; }  ///< later errors are only counted

  /// "file:line:column: message"; each warning appears once.
  std::vector<std::string> warnings() const;

  /// All findings in order: "file:line:column: error: message" (or warning), the line and a caret.
  std::vector<std::string> report() const;
  int count(Diagnostic::Severity severity) const;

  /// Throws one ParseError that lists all errors, if there are any. With `strict`, warnings count as errors.
  void throwErrors(bool strict = false) const;

 private:
  static constexpr int kMaxErrors = 50;
  static constexpr std::size_t kMaxStored = 1000;  ///< errors and warnings

  std::string withExcerpt(const Diagnostic& diagnostic) const;

  std::map<std::string, std::string> texts_;
  std::vector<Diagnostic> found_;
  int errors_ = 0;
};

}  // namespace kinegraph::inline scene_internal
