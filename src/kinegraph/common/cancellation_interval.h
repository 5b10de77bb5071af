#pragma once

#include <chrono>

namespace kinegraph::inline common_internal {

/// How often a waiting thread asks its CancellationToken.
inline constexpr std::chrono::milliseconds kCancellationInterval{20};

}  // namespace kinegraph::inline common_internal
