#include "kinegraph/control/target_file.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <fstream>
#include <sstream>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"

namespace kinegraph {

namespace {

constexpr const char* kExpected = "expected t, x, y, z or t, x, y, z, qw, qx, qy, qz";

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

bool hasDigit(std::string_view line) {
  return std::ranges::any_of(line, [](unsigned char character) { return std::isdigit(character) != 0; });
}

/// Parses the numbers of a line, separated by commas.
std::vector<double> numbersOf(std::string_view line, const SourcePosition& at) {
  std::vector<double> numbers;
  for (std::size_t begin = 0; begin <= line.size();) {
    const std::size_t end = std::min(line.find(',', begin), line.size());
    const std::string_view word = trimmed(line.substr(begin, end - begin));
    const std::string_view digits = word.starts_with('+') ? word.substr(1) : word;
    double number = 0.;
    const auto [stop, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
    const std::size_t column = word.empty() ? begin : std::size_t(word.data() - line.data());
    const SourcePosition here{at.file, at.line, int(column) + 1};
    if (error != std::errc() || stop != digits.data() + digits.size())
      throw ParseError(here, cat("'", word, "' is not a number; ", kExpected));
    if (!std::isfinite(number)) throw ParseError(here, cat("'", word, "' is not finite"));
    numbers.push_back(number);
    begin = end + 1;
  }
  return numbers;
}

}  // namespace

TargetFile::TargetFile(const std::string& path) {
  std::ifstream file(path);
  std::ostringstream text;
  if (!file || !(text << file.rdbuf())) throw FileError(cat("TargetFile: cannot read '", path, "'; ", kExpected));
  *this = fromText(text.str(), path);
}

TargetFile TargetFile::fromText(std::string_view text, const std::string& name) {
  TargetFile targets;
  SourcePosition at{name, 0, 1};
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    ++at.line;
    const std::string_view content = trimmed(line);
    const bool is_header = targets.entries_.empty() && !hasDigit(content);
    if (content.empty() || content.front() == '#' || is_header) continue;

    const std::vector<double> numbers = numbersOf(line, at);
    const std::size_t count = numbers.size();
    if (targets.entries_.empty() ? count != 4 && count != 8 : count != std::size_t(targets.entries_[0].pose.size()) + 1)
      throw ParseError(
          at, cat(count, " numbers; ",
                  targets.entries_.empty() ? std::string(kExpected)
                                           : cat("the lines before have ", targets.entries_[0].pose.size() + 1)));
    Entry entry{numbers[0], Eigen::Map<const VectorXd>(&numbers[1], Eigen::Index(count) - 1)};
    if (!targets.entries_.empty() && entry.time <= targets.entries_.back().time)
      throw ParseError(at, cat("time ", entry.time, " does not come after ", targets.entries_.back().time));
    if (entry.pose.size() == 7) {
      auto quaternion = entry.pose.tail<4>();
      const double length = quaternion.stableNorm();
      if (length == 0.) throw ParseError(at, "the quaternion is zero");
      quaternion /= length;
      if (!targets.entries_.empty() && quaternion.dot(targets.entries_.back().pose.tail<4>()) < 0.) quaternion *= -1.;
    }
    targets.entries_.push_back(std::move(entry));
  }
  if (targets.entries_.empty()) throw ParseError({name, at.line + 1, 1}, cat("the text has no poses; ", kExpected));
  return targets;
}

VectorXd TargetFile::operator()(double t) const {
  const auto after = std::ranges::upper_bound(entries_, t, {}, &Entry::time);
  if (after == entries_.begin()) return entries_.front().pose;
  if (after == entries_.end()) return entries_.back().pose;
  const Entry &one = *(after - 1), &other = *after;
  const double s = (t - one.time) / (other.time - one.time);
  VectorXd pose = (1. - s) * one.pose + s * other.pose;
  if (pose.size() == 7) {
    const double angle = std::acos(std::clamp(one.pose.tail<4>().dot(other.pose.tail<4>()), -1., 1.));
    if (angle > 1e-6)
      pose.tail<4>() = std::sin((1. - s) * angle) * one.pose.tail<4>() + std::sin(s * angle) * other.pose.tail<4>();
    pose.tail<4>().normalize();
  }
  return pose;
}

}  // namespace kinegraph
