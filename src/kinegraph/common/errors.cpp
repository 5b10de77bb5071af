#include "kinegraph/common/errors.h"

#include "kinegraph/common/text.h"

namespace kinegraph {

std::string SourcePosition::str() const {
  if (!known()) return file;
  return file.empty() ? cat(line, ":", column) : cat(file, ":", line, ":", column);
}

ParseError::ParseError(SourcePosition where, const std::string& message)
    : Error(where.known() || !where.file.empty() ? cat(where.str(), ": ", message) : message),
      where_(std::move(where)),
      reason_(message) {}

}  // namespace kinegraph
