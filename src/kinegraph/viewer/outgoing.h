#pragma once

#include <memory>
#include <string>

namespace kinegraph::inline viewer_internal {

/// A message for a browser. Large ones are shared by all browsers.
struct Outgoing {
  std::shared_ptr<const std::string> data;
  bool binary;
};

}  // namespace kinegraph::inline viewer_internal
