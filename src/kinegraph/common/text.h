#pragma once

#include <sstream>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace kinegraph {

/// Appends a number with six digits, as streams write it.
void appendNumber(std::string& text, double value);

/// Appends what streams.
template <class T>
void appendText(std::string& text, const T& value) {
  if constexpr (std::is_convertible_v<const T&, std::string_view>) {
    text += std::string_view(value);
  } else if constexpr (std::is_same_v<T, char>) {
    text += value;
  } else if constexpr (std::is_floating_point_v<T>) {
    appendNumber(text, value);
  } else if constexpr (std::is_same_v<T, int> || std::is_same_v<T, long> || std::is_same_v<T, std::size_t>) {
    text += std::to_string(value);
  } else {
    std::ostringstream out;
    out << value;
    text += out.str();
  }
}

/// Concatenates anything that streams.
template <class... Args>
std::string cat(const Args&... args) {
  std::string text;
  (appendText(text, args), ...);
  return text;
}

/// The shortest decimal text that reads back as exactly `value`.
std::string exact(double value);

std::string join(const std::vector<std::string>& words, std::string_view separator = ", ");

/// Number of insertions, deletions, replacements and swaps of neighbors that turn `a` into `b`.
/// Upper and lower case count as equal up to a small cost, so that `Box` is near `box`.
double editDistance(std::string_view a, std::string_view b);

/// Is editDistance(a, b) at most `limit`? Words that differ much are told at once.
bool isWithinEditDistance(std::string_view a, std::string_view b, double limit);

/// The candidates nearest to `word`, best first: those that a typing mistake away or that contain it.
std::vector<std::string> similarNames(std::string_view word, const std::vector<std::string>& candidates,
                                      std::size_t at_most = 3);

/// "; similar names: a, b", or "" if nothing is near. Appended to error messages.
std::string similarHint(std::string_view word, const std::vector<std::string>& candidates);

}  // namespace kinegraph
