#pragma once

#include <cmath>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "kinegraph/common/utf8.h"

namespace kinegraph::inline viewer_internal {

/// Reads the fields of a command from a browser in order: int32, float64, arrays as length and float64s, texts as
/// length and UTF-8. Returns false for missing fields and for numbers that are not finite.
class CommandReader {
 public:
  explicit CommandReader(std::string_view data) : rest_(data) {}

  bool read(int& value) {
    std::int32_t number;
    if (!take(&number, sizeof number)) return false;
    value = number;
    return true;
  }
  bool read(double& value) { return take(&value, sizeof value) && std::isfinite(value); }
  bool read(std::vector<double>& values) {
    int count;
    if (!read(count) || count < 0 || std::size_t(count) > rest_.size() / sizeof(double)) return false;
    values.resize(std::size_t(count));
    for (double& value : values) {
      if (!read(value)) return false;
    }
    return true;
  }
  /// Bytes that are not UTF-8 become U+FFFD.
  bool read(std::string& text) {
    int size;
    if (!read(size) || size < 0 || std::size_t(size) > rest_.size()) return false;
    text = validUtf8(rest_.substr(0, std::size_t(size)), nullptr, "\xef\xbf\xbd");
    rest_.remove_prefix(std::size_t(size));
    return true;
  }
  bool atEnd() const { return rest_.empty(); }

 private:
  bool take(void* to, std::size_t size) {
    if (rest_.size() < size) return false;
    std::memcpy(to, rest_.data(), size);
    rest_.remove_prefix(size);
    return true;
  }

  std::string_view rest_;
};

/// Reads a command with these fields, in this order; returns nothing if the data has another size.
template <class Command, class... Fields>
std::optional<Command> readFields(CommandReader& reader, Fields Command::*... fields) {
  Command command;
  if (!(reader.read(command.*fields) && ...) || !reader.atEnd()) return std::nullopt;
  return command;
}

}  // namespace kinegraph::inline viewer_internal
