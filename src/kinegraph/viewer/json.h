#pragma once

#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "kinegraph/base/text.h"

namespace kinegraph {

/// Writes JSON text. Bytes that are not UTF-8, which browsers would refuse, become U+FFFD. A type T takes part by a
/// function writeJson(JsonWriter&, const T&).
class JsonWriter {
 public:
  void beginObject() {
    separate();
    text_ += '{';
    first_ = true;
  }
  void endObject() {
    text_ += '}';
    first_ = false;
  }
  template <class T>
  void field(std::string_view name, const T& value) {
    separate();
    appendString(name);
    text_ += ':';
    first_ = true;
    append(value);
    first_ = false;
  }
  const std::string& text() const { return text_; }

 private:
  void separate() {
    if (!first_) text_ += ',';
    first_ = false;
  }
  void append(const std::string& value) { appendString(value); }
  void append(double value) { text_ += std::isfinite(value) ? exact(value) : "null"; }
  void append(int value) { text_ += std::to_string(value); }
  template <class T>
  void append(const std::vector<T>& values) {
    text_ += '[';
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (i) text_ += ',';
      first_ = true;
      append(values[i]);
    }
    text_ += ']';
  }
  template <class T>
  void append(const std::optional<T>& value) {
    if (value) {
      append(*value);
    } else {
      text_ += "null";
    }
  }
  template <class T>
  void append(const T& value) {
    writeJson(*this, value);
  }
  void appendString(std::string_view value);

  std::string text_;
  bool first_ = true;
};

}  // namespace kinegraph
