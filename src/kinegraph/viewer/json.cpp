#include "kinegraph/viewer/json.h"

#include <cstdio>

namespace kinegraph {

namespace {

/// Length of the character that `text` begins with, in bytes; 0 if it is not UTF-8 (RFC 3629).
std::size_t characterLength(std::string_view text) {
  const auto byte = [&](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u; };
  const unsigned first = byte(0);
  if (first < 0x80) return 1;
  const std::size_t length = first >= 0xc2 && first <= 0xdf   ? 2
                             : (first & 0xf0) == 0xe0         ? 3
                             : first >= 0xf0 && first <= 0xf4 ? 4
                                                              : 0;
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xc0) != 0x80) return 0;
  }
  // too long a form, half of a surrogate pair, beyond the last character
  if ((first == 0xe0 && byte(1) < 0xa0) || (first == 0xed && byte(1) > 0x9f)) return 0;
  if ((first == 0xf0 && byte(1) < 0x90) || (first == 0xf4 && byte(1) > 0x8f)) return 0;
  return length;
}

}  // namespace

void JsonWriter::appendString(std::string_view value) {
  text_ += '"';
  for (std::size_t i = 0; i < value.size();) {
    const char c = value[i];
    const std::size_t length = characterLength(value.substr(i));
    if (c == '"' || c == '\\') {
      text_ += '\\';
      text_ += c;
    } else if (static_cast<unsigned char>(c) < 0x20) {
      char escape[8];
      std::snprintf(escape, sizeof escape, "\\u%04x", static_cast<unsigned>(c));
      text_ += escape;
    } else if (length == 0) {
      text_ += "\xef\xbf\xbd";
    } else {
      text_ += value.substr(i, length);
    }
    i += length ? length : 1;
  }
  text_ += '"';
}

}  // namespace kinegraph
