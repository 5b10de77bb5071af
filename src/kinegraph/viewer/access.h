#pragma once

#include <string>
#include <string_view>

namespace kinegraph {

/// Who may connect to a viewer.
struct Access {
  bool loopback_only = true;
  std::string token;  ///< empty: none is asked for

  /// `host`, `origin` (empty: none) and `target` are those of a request. A page from elsewhere must not drive a viewer
  /// on this machine: its Origin, or a Host that merely resolves to it, differs.
  bool allows(std::string_view host, std::string_view origin, std::string_view target) const;
};

std::string randomToken();

}  // namespace kinegraph
