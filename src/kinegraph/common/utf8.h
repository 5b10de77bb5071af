#pragma once

#include <string>
#include <string_view>

namespace kinegraph {

/// Returns `text` with a mark for each byte that is not part of a UTF-8 character; `replaced` counts these bytes.
std::string validUtf8(std::string_view text, std::size_t* replaced = nullptr, std::string_view mark = "?");

}  // namespace kinegraph
