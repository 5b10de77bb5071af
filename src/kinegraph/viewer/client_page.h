#pragma once

#include <string_view>

namespace kinegraph::inline viewer_internal {

/// Returns the browser client: a self-contained HTML page, embedded when the library is built.
std::string_view clientPage();

}  // namespace kinegraph::inline viewer_internal
