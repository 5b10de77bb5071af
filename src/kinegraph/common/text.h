#pragma once

#include <locale>
#include <sstream>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace kinegraph {

/// Appends a number with six digits, in the format of streams.
void appendNumber(std::string& text, double value);

/// Appends a value that streams can write.
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
    out.imbue(std::locale::classic());
    out << value;
    text += out.str();
  }
}

/// Concatenates values that streams can write.
template <class... Args>
std::string cat(const Args&... args) {
  std::string text;
  (appendText(text, args), ...);
  return text;
}

/// Returns a number with the given count of digits, in the format of streams.
std::string numberText(double value, int digits);

/// Reads a number at the beginning of a text as std::strtod does, but always in the C locale. `end` is set behind it;
/// to `text` if there is none.
double readNumber(const char* text, const char** end = nullptr);

/// Returns the shortest decimal text that parses to exactly `value`.
std::string exact(double value);
/// Returns the words as one text, with a separator between them.
std::string join(const std::vector<std::string>& words, std::string_view separator = ", ");

/// Returns the number of insertions, deletions, replacements and swaps of neighbors that transform `a` into `b`.
/// Differences of upper and lower case have a small cost: `Box` is close to `box`.
double editDistance(std::string_view a, std::string_view b);

/// Whether editDistance(a, b) is at most `limit`. Fast for very different words.
bool isWithinEditDistance(std::string_view a, std::string_view b, double limit);

/// Returns the candidates closest to `word`, best first: typing mistakes away, or containing it.
std::vector<std::string> similarNames(std::string_view word, const std::vector<std::string>& candidates,
                                      std::size_t at_most = 3);

/// Returns "; similar names: a, b" for the end of error messages, or "" if no name is close.
std::string similarHint(std::string_view word, const std::vector<std::string>& candidates);

}  // namespace kinegraph
