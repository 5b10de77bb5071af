#pragma once

#include <cmath>
#include <cstdio>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "kinegraph/base/text.h"

namespace kinegraph {

/// Writes JSON text. A type T takes part by a function writeJson(JsonWriter&, const T&).
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
  void appendString(std::string_view value) {
    text_ += '"';
    for (const char c : value) {
      if (c == '"' || c == '\\') {
        text_ += '\\';
        text_ += c;
      } else if (static_cast<unsigned char>(c) < 0x20) {
        char escape[8];
        std::snprintf(escape, sizeof escape, "\\u%04x", c);
        text_ += escape;
      } else {
        text_ += c;
      }
    }
    text_ += '"';
  }

  std::string text_;
  bool first_ = true;
};

}  // namespace kinegraph
