#include "kinegraph/common/text.h"

#include <locale.h>
#include <stdlib.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdint>

namespace kinegraph {

void appendNumber(std::string& text, double value) {
  std::array<char, 32> buffer;
  const auto [end, error] =
      std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::general, 6);
  (void)error;
  text.append(buffer.data(), end);
}

std::string numberText(double value, int digits) {
  std::array<char, 64> buffer;
  const auto [end, error] =
      std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::general, digits);
  (void)error;
  return {buffer.data(), end};
}

double readNumber(const char* text, const char** end) {
  static const locale_t kClassic = newlocale(LC_ALL_MASK, "C", locale_t{});
  char* behind = nullptr;
  const double number = strtod_l(text, &behind, kClassic);
  if (end) *end = behind;
  return number;
}

std::string exact(double value) {
  std::array<char, 32> buffer;
  const auto [end, error] = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  (void)error;
  return {buffer.data(), end};
}

std::string join(const std::vector<std::string>& words, std::string_view separator) {
  std::string out;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (i) out += separator;
    out += words[i];
  }
  return out;
}

double editDistance(std::string_view a, std::string_view b) {
  const auto lower = [](char c) { return std::tolower(static_cast<unsigned char>(c)); };
  const auto replace = [&](char x, char y) { return x == y ? 0. : lower(x) == lower(y) ? .1 : 1.; };
  std::vector<double> before(b.size() + 1), previous(b.size() + 1), current(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) previous[j] = double(j);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    current[0] = double(i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      current[j] = std::min({previous[j] + 1, current[j - 1] + 1, previous[j - 1] + replace(a[i - 1], b[j - 1])});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
        current[j] = std::min(current[j], before[j - 2] + 1);
      }
    }
    before = previous;
    previous = current;
  }
  return previous[b.size()];
}

bool isWithinEditDistance(std::string_view a, std::string_view b, double limit) {
  if (std::abs(double(a.size()) - double(b.size())) > limit) return false;
  const auto letters = [](std::string_view word) {
    std::uint32_t set = 0;
    for (char c : word) set |= 1u << (static_cast<unsigned char>(c) & 31);  // ignores case
    return set;
  };
  const int other_letters = std::popcount(letters(a) ^ letters(b));  // one replacement changes two of them
  return other_letters <= 2. * limit && editDistance(a, b) <= limit;
}

std::vector<std::string> similarNames(std::string_view word, const std::vector<std::string>& candidates,
                                      std::size_t at_most) {
  std::vector<std::pair<double, std::string>> near;
  for (const std::string& candidate : candidates) {
    if (candidate.empty() || word.empty()) continue;
    const bool contains = candidate.find(word) != std::string::npos || word.find(candidate) != std::string_view::npos;
    const double longest = double(std::max(word.size(), candidate.size())), limit = std::max(1., longest / 3.);
    const double difference = longest - double(std::min(word.size(), candidate.size()));  // at most the distance
    double distance = difference > limit ? difference : editDistance(word, candidate);
    const bool nothing_in_common = distance >= longest;
    if ((distance > limit || nothing_in_common) && !(contains && std::min(word.size(), candidate.size()) >= 3))
      continue;
    if (contains) distance = std::min(distance, limit);
    near.emplace_back(distance, candidate);
  }
  std::stable_sort(near.begin(), near.end(), [](const auto& x, const auto& y) { return x.first < y.first; });
  std::vector<std::string> words;
  for (auto& [distance, candidate] : near) {
    if (words.size() == at_most) break;
    if (std::find(words.begin(), words.end(), candidate) == words.end()) words.push_back(std::move(candidate));
  }
  return words;
}

std::string similarHint(std::string_view word, const std::vector<std::string>& candidates) {
  const std::vector<std::string> words = similarNames(word, candidates);
  return words.empty() ? "" : cat("; similar names: ", join(words));
}

}  // namespace kinegraph
