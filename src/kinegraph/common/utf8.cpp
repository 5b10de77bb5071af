#include "kinegraph/common/utf8.h"

namespace kinegraph {

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

}  // namespace

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

}  // namespace kinegraph
