#pragma once

#include <string_view>

namespace kinegraph {

/// Returns the browser client: a self-contained HTML page, embedded when the library is built.
std::string_view clientPage();

}  // namespace kinegraph
