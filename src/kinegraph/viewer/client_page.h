#pragma once

#include <string_view>

namespace kinegraph {

/// The browser client: one HTML page with everything in it, embedded when the library is built.
std::string_view clientPage();

}  // namespace kinegraph
