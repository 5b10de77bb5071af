#pragma once

#include <string>
#include <utility>
#include <vector>

#include "kinegraph/gfile/parser.h"

namespace kinegraph::inline parsers_internal {

/// Collects the errors and warnings of a reader.
class Findings {
 public:
  explicit Findings(std::vector<Diagnostic>& found) : found_(found) {}

  void error(const SourcePosition& where, std::string message) {
    found_.push_back({Diagnostic::Severity::error, where, std::move(message)});
    failed_ = true;
  }
  void warn(const SourcePosition& where, std::string message) {
    found_.push_back({Diagnostic::Severity::warning, where, std::move(message)});
  }
  bool failed() const { return failed_; }

 private:
  std::vector<Diagnostic>& found_;
  bool failed_ = false;
};

}  // namespace kinegraph::inline parsers_internal
