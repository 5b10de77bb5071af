#pragma once

#include <string>
#include <string_view>

namespace kinegraph::inline common_internal {

/// Returns `text` with a mark for each byte that is not part of a UTF-8 character; `replaced` counts these bytes.
std::string validUtf8(std::string_view text, std::size_t* replaced = nullptr, std::string_view mark = "?");

/// Returns a text as UTF-8 without a byte order mark. Recognizes UTF-16 by its mark or by its first character '<', and
/// ISO-8859-1 (also under its names latin1 and windows-1252) by an XML declaration. Other texts are returned as they
/// are.
std::string toUtf8(std::string_view bytes);

}  // namespace kinegraph::inline common_internal
