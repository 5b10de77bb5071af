#include <charconv>
#include <cmath>
#include <numbers>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/scene/loading/reader.h"

namespace kinegraph::inline scene_internal {

namespace {

[[noreturn]] void fail(const SourcePosition& where, std::string_view text, const std::string& message) {
  throw ParseError(where, cat("pose \"", text, "\": ", message));
}

/// Reads numbers from `at` on, separated by blanks or commas, up to the first character outside of a number.
std::vector<double> readNumbers(std::string_view text, std::size_t& at, const SourcePosition& where) {
  std::vector<double> numbers;
  for (;;) {
    while (at < text.size() && (std::isspace(static_cast<unsigned char>(text[at])) || text[at] == ',')) ++at;
    if (at >= text.size() || !(std::isdigit(static_cast<unsigned char>(text[at])) || text[at] == '-' ||
                               text[at] == '+' || text[at] == '.')) {
      return numbers;
    }
    double number = 0.;
    const char* first = text.data() + at + (text[at] == '+');
    const auto [end, error] = std::from_chars(first, text.data() + text.size(), number);
    if (error != std::errc{}) fail(where, text, cat("'", text.substr(at), "' is not a number"));
    numbers.push_back(number);
    at = std::size_t(end - text.data());
  }
}

Quaterniond aboutAxis(double angle, const Vector3d& axis) {
  const double norm = axis.norm();
  return norm < 1e-15 ? Quaterniond::Identity() : Quaterniond(Eigen::AngleAxisd(angle, axis / norm));
}

Pose motion(char letter, const std::vector<double>& v, std::string_view text, const SourcePosition& where) {
  const auto expect = [&](std::size_t count, const char* meaning) {
    if (v.size() != count)
      fail(where, text, cat("'", letter, "' takes ", count, " numbers ", meaning, ", not ", v.size()));
  };
  const auto about = [](double angle, int axis) { return Quaterniond(Eigen::AngleAxisd(angle, Vector3d::Unit(axis))); };
  switch (letter) {
    case 't':
      expect(3, "(x y z)");
      return {Vector3d(v[0], v[1], v[2]), Quaterniond::Identity()};
    case 'q':
      expect(4, "(w x y z)");
      return {Vector3d::Zero(), unitQuaternion({v[0], v[1], v[2], v[3]})};
    case 'r':
      expect(4, "(radians x y z)");
      return {Vector3d::Zero(), aboutAxis(v[0], {v[1], v[2], v[3]})};
    case 'd':
      expect(4, "(degrees x y z)");
      return {Vector3d::Zero(), aboutAxis(v[0] * std::numbers::pi / 180., {v[1], v[2], v[3]})};
    case 'E':
      expect(3, "(roll pitch yaw)");
      return {Vector3d::Zero(), about(v[0], 0) * about(v[1], 1) * about(v[2], 2)};
    case 'p':
      expect(7, "(x y z qw qx qy qz)");
      return Pose::fromNumbers(Eigen::Map<const VectorXd>(v.data(), 7));
    default:
      fail(
          where, text,
          cat("'", letter,
              "' is not a motion; expected t(x y z), d(degrees x y z), r(radians x y z), q(w x y z), E(roll pitch yaw) "
              "or p(7 numbers)"));
  }
}

}  // namespace

Pose parsePose(std::string_view text, const SourcePosition& where) {
  Pose X;
  std::size_t at = 0;
  for (;;) {
    while (at < text.size() && (std::isspace(static_cast<unsigned char>(text[at])) || text[at] == '|' ||
                                text[at] == '<' || text[at] == '>'))
      ++at;
    if (at >= text.size()) return X;
    const char c = text[at];
    if (c == 'T') {  // an obsolete marker without effect
      ++at;
      continue;
    }
    if (c == '[' || std::isdigit(static_cast<unsigned char>(c)) || c == '-' || c == '+' || c == '.') {
      at += c == '[';
      const std::vector<double> numbers = readNumbers(text, at, where);
      while (at < text.size() &&
             (text[at] == ']' || text[at] == '>' || std::isspace(static_cast<unsigned char>(text[at]))))
        ++at;
      if (at < text.size()) fail(where, text, cat("unexpected '", text.substr(at), "' after the numbers"));
      try {
        return X * Pose::fromNumbers(Eigen::Map<const VectorXd>(numbers.data(), Eigen::Index(numbers.size())));
      } catch (const ValueError& error) {
        fail(where, text, error.what());
      }
    }
    ++at;
    while (at < text.size() && std::isspace(static_cast<unsigned char>(text[at]))) ++at;
    if (at >= text.size() || text[at] != '(') {
      if (std::string_view("tqrdEp").find(c) == std::string_view::npos) motion(c, {}, text, where);
      fail(where, text, cat("'", c, "' is not followed by '('"));
    }
    ++at;
    const std::vector<double> numbers = readNumbers(text, at, where);
    if (at >= text.size() || text[at] != ')') fail(where, text, cat("the '(' after '", c, "' is never closed by ')'"));
    ++at;
    try {
      X = X * motion(c, numbers, text, where);
    } catch (const ValueError& error) {
      fail(where, text, error.what());
    }
  }
}

}  // namespace kinegraph::inline scene_internal
