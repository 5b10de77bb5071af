#pragma once

#include <string>
#include <string_view>

namespace kinegraph {

/// What a request of a browser says of where it comes from and what it wants.
struct RequestedAccess {
  std::string_view host;            ///< header Host
  std::string_view forwarded_host;  ///< header X-Forwarded-Host of a proxy; empty: none. Pages cannot set it
  std::string_view origin;          ///< header Origin; empty: none
  std::string_view target;          ///< path and query
};

/// Who may connect to a viewer.
struct Access {
  bool loopback_only = true;
  std::string token;  ///< empty: none is asked for

  /// A page from elsewhere must not drive a viewer on this machine: its Origin, or a Host that merely resolves to it,
  /// differs. Behind a proxy (TLS ends there, the Origin is https) the host may be any if a token is asked for.
  bool allows(const RequestedAccess& request) const;
};

/// The sources that may show a viewer's page in a frame, as the header Content-Security-Policy says it: the viewer
/// itself, and notebooks on this machine or in an editor.
std::string_view framePolicy();

std::string randomToken();

}  // namespace kinegraph
