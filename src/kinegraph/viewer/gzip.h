#pragma once

#include <string>
#include <string_view>

namespace kinegraph::inline viewer_internal {

/// Compresses data in the format of RFC 1952, for browsers that accept `gzip`.
std::string gzipped(std::string_view data);

}  // namespace kinegraph::inline viewer_internal
