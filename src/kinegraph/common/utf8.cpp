#include "kinegraph/common/utf8.h"

#include <cstdint>

namespace kinegraph::inline common_internal {

namespace {

/// Returns the number of bytes of the first character of `text`; 0 if it is invalid.
std::size_t characterLength(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned first = byte(0);
  if (first < 0x80) return 1;
  const std::size_t length = first >= 0xC2 && first < 0xE0   ? 2
                             : first >= 0xE0 && first < 0xF0 ? 3
                             : first >= 0xF0 && first < 0xF5 ? 4
                                                             : 0;
  if (length == 0 || text.size() < length) return 0;
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xC0) != 0x80) return 0;
  }
  const unsigned second = byte(1);  // excludes overlong forms, surrogates, and values above U+10FFFF
  if ((first == 0xE0 && second < 0xA0) || (first == 0xED && second > 0x9F)) return 0;
  if ((first == 0xF0 && second < 0x90) || (first == 0xF4 && second > 0x8F)) return 0;
  return length;
}

void appendUtf8(std::uint32_t code, std::string& out) {
  if (code < 0x80) {
    out += char(code);
  } else if (code < 0x800) {
    out += {char(0xC0 | code >> 6), char(0x80 | (code & 0x3F))};
  } else if (code < 0x10000) {
    out += {char(0xE0 | code >> 12), char(0x80 | (code >> 6 & 0x3F)), char(0x80 | (code & 0x3F))};
  } else {
    out += {char(0xF0 | code >> 18), char(0x80 | (code >> 12 & 0x3F)), char(0x80 | (code >> 6 & 0x3F)),
            char(0x80 | (code & 0x3F))};
  }
}

std::string fromUtf16(std::string_view bytes, bool big_endian) {
  std::string out;
  const auto unit = [&](std::size_t i) {
    const auto first = static_cast<unsigned char>(bytes[i]), second = static_cast<unsigned char>(bytes[i + 1]);
    return std::uint32_t(big_endian ? first << 8 | second : second << 8 | first);
  };
  for (std::size_t i = 0; i + 1 < bytes.size(); i += 2) {
    std::uint32_t code = unit(i);
    if (code == 0xFEFF) continue;  // byte order mark
    const bool high = code >= 0xD800 && code < 0xDC00 && i + 3 < bytes.size();
    const std::uint32_t low = high ? unit(i + 2) : 0;
    if (low >= 0xDC00 && low < 0xE000) {
      code = 0x10000 + ((code - 0xD800) << 10) + (low - 0xDC00);
      i += 2;
    }
    appendUtf8(code, out);
  }
  return out;
}

/// Whether an XML declaration names ISO-8859-1.
bool declaresLatin1(std::string_view bytes) {
  if (!bytes.starts_with("<?xml")) return false;
  std::string declaration(bytes.substr(0, bytes.find("?>")).substr(0, 200));
  for (char& c : declaration) c = c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c;
  for (const char* name : {"iso-8859-1", "latin1", "latin-1", "windows-1252"}) {
    if (declaration.find(name) != std::string::npos) return true;
  }
  return false;
}

}  // namespace

std::string toUtf8(std::string_view bytes) {
  if (bytes.starts_with("\xEF\xBB\xBF")) return std::string(bytes.substr(3));
  if (bytes.starts_with("\xFF\xFE") || bytes.starts_with(std::string_view("<\0", 2))) return fromUtf16(bytes, false);
  if (bytes.starts_with("\xFE\xFF") || bytes.starts_with(std::string_view("\0<", 2))) return fromUtf16(bytes, true);
  std::size_t replaced = 0;
  if (declaresLatin1(bytes)) validUtf8(bytes, &replaced);
  if (replaced == 0) return std::string(bytes);
  std::string out;
  for (const char c : bytes) appendUtf8(static_cast<unsigned char>(c), out);
  return out;
}

std::string validUtf8(std::string_view text, std::size_t* replaced, std::string_view mark) {
  std::string valid;
  valid.reserve(text.size());
  std::size_t count = 0;
  std::size_t begin = 0;  // start of the characters that are not copied yet
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = characterLength(text.substr(i));
    if (length == 0) {
      valid.append(text, begin, i - begin).append(mark);
      begin = i + 1;
      ++count;
    }
    i += length == 0 ? 1 : length;
  }
  valid.append(text, begin);
  if (replaced) *replaced = count;
  return valid;
}

}  // namespace kinegraph::inline common_internal
