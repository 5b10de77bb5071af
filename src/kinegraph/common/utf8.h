#pragma once

#include <string>
#include <string_view>

namespace kinegraph {

/// `text` with a mark for every byte that is not part of a UTF-8 character; `replaced` counts them, where given.
std::string validUtf8(std::string_view text, std::size_t* replaced = nullptr, std::string_view mark = "?");

}  // namespace kinegraph
