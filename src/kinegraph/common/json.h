#pragma once

#include <boost/json.hpp>
#include <cmath>
#include <concepts>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "kinegraph/common/utf8.h"

namespace kinegraph::inline common_internal {

// Values of Boost.JSON for browsers and glTF files. Include only in sources: Boost.JSON compiles slowly.

/// Converts a number: null if it is not finite; integers have no exponent.
boost::json::value jsonOf(double number);

inline boost::json::value jsonOf(std::integral auto number) { return std::int64_t(number); }

/// Converts a text; bytes that are not UTF-8 become U+FFFD, since JSON parsers reject them.
inline boost::json::value jsonOf(std::string_view text) {
  return boost::json::string(validUtf8(text, nullptr, "\xef\xbf\xbd"));
}

inline boost::json::value jsonOf(const std::string& text) { return jsonOf(std::string_view(text)); }

template <class T>
boost::json::value jsonOf(const std::vector<T>& list) {
  boost::json::array values;
  values.reserve(list.size());
  for (const T& entry : list) values.push_back(jsonOf(entry));
  return values;
}

template <class T>
boost::json::value jsonOf(const std::optional<T>& value) {
  return value ? jsonOf(*value) : boost::json::value();
}

}  // namespace kinegraph::inline common_internal
