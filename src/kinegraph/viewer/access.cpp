#include "kinegraph/viewer/access.h"

#include <algorithm>
#include <random>

#include "kinegraph/base/text.h"

namespace kinegraph {

namespace {

bool isLoopbackName(std::string_view host) {
  const std::size_t colon = host.starts_with('[') ? host.find("]:") : host.rfind(':');
  std::string_view name = host.substr(0, host.starts_with('[') && colon != host.npos ? colon + 1 : colon);
  return name == "localhost" || name == "127.0.0.1" || name == "[::1]";
}

/// In a time that does not tell how much of them is the same.
bool isSame(std::string_view a, std::string_view b) {
  if (a.size() != b.size()) return false;
  unsigned difference = 0;
  for (std::size_t i = 0; i < a.size(); ++i) difference |= static_cast<unsigned>(a[i] ^ b[i]);
  return difference == 0;
}

}  // namespace

bool Access::allows(std::string_view host, std::string_view origin, std::string_view target) const {
  if (loopback_only && !isLoopbackName(host)) return false;
  if (!origin.empty() && origin != cat("http://", host)) return false;
  return token.empty() || isSame(target.substr(std::min(target.find('?'), target.size())), cat("?token=", token));
}

std::string randomToken() {
  std::random_device random;
  std::string token;
  for (int i = 0; i < 32; ++i) token += "0123456789abcdef"[random() % 16];
  return token;
}

}  // namespace kinegraph
