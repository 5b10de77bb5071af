#include "kinegraph/scene/tree/diagnostics.h"

#include <algorithm>

#include "kinegraph/common/text.h"

namespace kinegraph::inline scene_internal {

void SceneDiagnostics::add(Diagnostic diagnostic) {
  if (diagnostic.severity == Diagnostic::Severity::error && ++errors_ > kMaxErrors) return;
  if (diagnostic.severity == Diagnostic::Severity::warning && found_.size() >= kMaxStored) return;
  const auto same = [&](const Diagnostic& other) {
    return other.severity == diagnostic.severity && other.message == diagnostic.message &&
           other.where.str() == diagnostic.where.str();
  };
  if (std::none_of(found_.begin(), found_.end(), same)) found_.push_back(std::move(diagnostic));
}

void SceneDiagnostics::error(const SourcePosition& where, std::string message) {
  add({Diagnostic::Severity::error, where, std::move(message)});
}

void SceneDiagnostics::warning(const SourcePosition& where, std::string message) {
  add({Diagnostic::Severity::warning, where, std::move(message)});
}

std::vector<std::string> SceneDiagnostics::warnings() const {
  std::vector<std::string> list;
  for (const Diagnostic& d : found_) {
    if (d.severity == Diagnostic::Severity::warning) list.push_back(ParseError(d.where, d.message).what());
  }
  return list;
}

std::vector<std::string> SceneDiagnostics::report() const {
  std::vector<std::string> list;
  for (const Diagnostic& d : found_) {
    const char* severity = d.severity == Diagnostic::Severity::error ? "error: " : "warning: ";
    list.push_back(ParseError(d.where, severity + withExcerpt(d)).what());
  }
  return list;
}

int SceneDiagnostics::count(Diagnostic::Severity severity) const {
  if (severity == Diagnostic::Severity::error) return errors_;
  return int(std::count_if(found_.begin(), found_.end(), [&](const Diagnostic& d) { return d.severity == severity; }));
}

void SceneDiagnostics::throwErrors(bool strict) const {
  const Diagnostic* first = nullptr;
  std::string message;
  for (const Diagnostic& d : found_) {
    if (d.severity != Diagnostic::Severity::error && !strict) continue;
    message += first ? cat("\n", ParseError(d.where, withExcerpt(d)).what())
                     : withExcerpt(d);  // the exception adds the position
    if (!first) first = &d;
  }
  if (errors_ > kMaxErrors) message += cat("\n... and ", errors_ - kMaxErrors, " more errors");
  if (first) throw ParseError(first->where, message);
}

std::string SceneDiagnostics::withExcerpt(const Diagnostic& diagnostic) const {
  const auto text = texts_.find(diagnostic.where.file);
  if (text == texts_.end() || !diagnostic.where.known()) return diagnostic.message;
  return cat(diagnostic.message, "\n", excerpt(text->second, diagnostic.where));
}

}  // namespace kinegraph::inline scene_internal
