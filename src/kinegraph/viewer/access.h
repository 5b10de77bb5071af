#pragma once

#include <string>
#include <string_view>

namespace kinegraph::inline viewer_internal {

/// The origin and target of a browser's request.
struct RequestedAccess {
  std::string_view host;            ///< header Host
  std::string_view forwarded_host;  ///< header X-Forwarded-Host of a proxy; empty: none. Pages cannot set it
  std::string_view origin;          ///< header Origin; empty: none
  std::string_view target;          ///< path and query
};

/// Access control of a viewer.
struct Access {
  bool loopback_only = true;
  std::string token;  ///< empty: no token required

  /// Returns whether a request is allowed. Pages of other sites must not control a local viewer: their Origin differs,
  /// or their Host is a foreign name that resolves to this machine. Behind a proxy (TLS ends there, the Origin is
  /// https) any host is allowed if a token is required.
  bool allows(const RequestedAccess& request) const;
};

/// Returns the header Content-Security-Policy with the sources that may embed a viewer's page: the viewer itself, and
/// notebooks on this machine or in an editor.
std::string_view framePolicy();

std::string randomToken();

}  // namespace kinegraph::inline viewer_internal
