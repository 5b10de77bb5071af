#include "kinegraph/viewer/access.h"

#include <algorithm>
#include <random>

#include "kinegraph/common/text.h"

namespace kinegraph::inline viewer_internal {

namespace {

bool isLoopbackName(std::string_view host) {
  const std::size_t colon = host.starts_with('[') ? host.find("]:") : host.rfind(':');
  std::string_view name = host.substr(0, host.starts_with('[') && colon != host.npos ? colon + 1 : colon);
  return name == "localhost" || name == "127.0.0.1" || name == "[::1]";
}

bool isPageOf(std::string_view host, std::string_view origin) {
  return origin == cat("http://", host) || origin == cat("https://", host);
}

/// Compares in constant time, so that the time does not reveal the length of the common prefix.
bool isSame(std::string_view a, std::string_view b) {
  if (a.size() != b.size()) return false;
  unsigned difference = 0;
  for (std::size_t i = 0; i < a.size(); ++i) difference |= static_cast<unsigned>(a[i] ^ b[i]);
  return difference == 0;
}

}  // namespace

bool Access::allows(const RequestedAccess& request) const {
  if (loopback_only && token.empty() && !isLoopbackName(request.host)) return false;
  if (!request.origin.empty() && !isPageOf(request.host, request.origin) &&
      (request.forwarded_host.empty() || !isPageOf(request.forwarded_host, request.origin))) {
    return false;
  }
  const std::string_view query = request.target.substr(std::min(request.target.find('?'), request.target.size()));
  return token.empty() || isSame(query, cat("?token=", token));
}

std::string_view framePolicy() {
  return "frame-ancestors 'self' http://localhost:* https://localhost:* http://127.0.0.1:* https://127.0.0.1:* "
         "vscode-webview:";
}

std::string randomToken() {
  std::random_device random;
  std::string token;
  for (int i = 0; i < 32; ++i) token += "0123456789abcdef"[random() % 16];
  return token;
}

}  // namespace kinegraph::inline viewer_internal
